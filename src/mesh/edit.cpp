#include "sculpt/mesh/edit.hpp"

#include <algorithm>
#include <limits>

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

void turn(HexMesh& mesh, const std::array<Vec3, 3>& axes) {
  for (Vec3& p : mesh.position) p = p.x * axes[0] + p.y * axes[1] + p.z * axes[2];
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

void join_hexes(const Comm& comm, HexMesh& mesh, HexMesh other, GlobalId node_factor, GlobalId hex_factor) {
  for (GlobalId& id : other.node_id) id *= node_factor;
  for (GlobalId& id : other.hex_id) id *= hex_factor;
  mesh.exterior = {};
  // Where each node of the two meshes goes, in the order of the ids.
  const std::array<const HexMesh*, 2> from{&mesh, &other};
  std::array<std::vector<LocalId>, 2> node;
  HexMesh out;
  std::array<LocalId, 2> next{0, 0};
  while (next[0] < mesh.nodes() || next[1] < other.nodes()) {
    const auto id = [&](std::size_t m) {
      return next[m] < from[m]->nodes() ? from[m]->node_id[at(next[m])]
                                        : std::numeric_limits<GlobalId>::max();
    };
    const GlobalId least = std::min(id(0), id(1));
    const std::size_t first = id(0) == least ? 0 : 1;
    const std::size_t n = at(next[first]);
    out.position.push_back(from[first]->position[n]);
    out.node_id.push_back(least);
    out.node_owner.push_back(from[first]->node_owner[n]);
    out.box_sides.push_back(from[first]->box_sides[n]);
    out.colour.push_back(from[first]->colour[n]);
    out.node_unit.push_back(from[first]->node_unit[n]);
    for (std::size_t m = 0; m < 2; ++m)
      if (id(m) == least) {
        node[m].push_back(out.nodes() - 1);
        ++next[m];
      }
  }
  next = {0, 0};
  while (next[0] < mesh.size() || next[1] < other.size()) {
    const bool second = next[0] >= mesh.size() ||
                        (next[1] < other.size() && other.hex_id[at(next[1])] < mesh.hex_id[at(next[0])]);
    const std::size_t m = second ? 1 : 0, h = at(next[m]++);
    if (from[m]->layer[h] > mesh.ghost_layers) continue;
    Hex hex = from[m]->hexes[h];
    for (LocalId& n : hex) n = node[m][at(n)];
    out.hexes.push_back(hex);
    out.hex_id.push_back(from[m]->hex_id[h]);
    out.hex_owner.push_back(from[m]->hex_owner[h]);
    out.layer.push_back(from[m]->layer[h]);
    out.material.push_back(from[m]->material[h]);
  }
  out.ghost_layers = mesh.ghost_layers;
  out.colours = std::max(mesh.colours, other.colours);
  out.cell_size = mesh.cell_size;
  drop_unused_nodes(out);
  connect_ranks(comm, out);
  mesh = std::move(out);
}

}  // namespace sculpt
