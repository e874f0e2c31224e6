#include "sculpt/mesh/edit.hpp"

namespace sculpt {

std::vector<LocalId> indices_without(std::span<const std::uint8_t> drop) {
  std::vector<LocalId> index(drop.size(), kNone);
  LocalId next = 0;
  for (std::size_t i = 0; i < drop.size(); ++i)
    if (!drop[i]) index[i] = next++;
  return index;
}

std::vector<LocalId> drop_unused_nodes(HexMesh& mesh) {
  std::vector<std::uint8_t> unused(mesh.position.size(), 1);
  for (const Hex& h : mesh.hexes)
    for (const LocalId n : h) unused[at(n)] = 0;
  std::vector<LocalId> node = indices_without(unused);
  compact(mesh.position, node);
  compact(mesh.node_id, node);
  compact(mesh.node_owner, node);
  compact(mesh.box_sides, node);
  compact(mesh.colour, node);
  if (!mesh.exterior.empty()) compact(mesh.exterior.hold_of, node);
  if (!mesh.node_unit.empty()) compact(mesh.node_unit, node);
  if (!mesh.node_home.empty()) {
    compact(mesh.node_home, node);
    compact(mesh.node_image, node);
  }
  for (Hex& h : mesh.hexes)
    for (LocalId& n : h) n = node[at(n)];
  return node;
}

void transform(HexMesh& mesh, const Vec3& scale, const Vec3& translate) {
  for (Vec3& p : mesh.position)
    for (std::size_t d = 0; d < 3; ++d) p[d] = scale[d] * p[d] + translate[d];
  const auto moved = [&](Vec3& p) { p = scaled(p, scale) + translate; };
  for (Facet& f : mesh.exterior.facets)
    for (Vec3& p : f.corner) moved(p);
  for (Hold& h : mesh.exterior.holds)
    for (Vec3& p : h.line) moved(p);
  mesh.cell_size = scaled(mesh.cell_size, scale);
  mesh.period = scaled(mesh.period, scale);
  mesh.quantum = {0, 0, 0};
  share_positions(mesh);
}

std::vector<LocalId> remove_hexes(const Comm& comm, HexMesh& mesh, std::vector<std::uint8_t> remove) {
  mesh.hex_exchange.copy_to_ghosts(remove);
  std::vector<LocalId> hex = indices_without(remove);
  compact(mesh.hexes, hex);
  compact(mesh.hex_id, hex);
  compact(mesh.hex_owner, hex);
  compact(mesh.layer, hex);
  compact(mesh.material, hex);
  if (!mesh.hex_home.empty()) {
    compact(mesh.hex_home, hex);
    compact(mesh.hex_image, hex);
  }
  mesh.lattice = {0, 0, 0};
  std::erase_if(mesh.exterior.faces, [&](const ExteriorFace& f) { return hex[at(f.hex)] == kNone; });
  for (ExteriorFace& f : mesh.exterior.faces) f.hex = hex[at(f.hex)];
  // An owner sees all hexes around its nodes, so that it keeps every node that another rank keeps.
  drop_unused_nodes(mesh);
  connect_ranks(comm, mesh);
  return hex;
}

}  // namespace sculpt
