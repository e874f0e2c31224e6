#include "mesh.hpp"
#include "sculpt/exo/write_rank_file.hpp"

namespace hexmesh {
namespace {

sculpt::RankMesh rank_mesh(const Mesh& mesh, const std::string& title) {
  sculpt::RankMesh out;
  out.title = title;
  out.global_nodes = static_cast<std::int64_t>(mesh.node.size());
  out.global_hexes = static_cast<std::int64_t>(mesh.hex.size());
  for (const Vec3& p : mesh.node) {
    out.x.push_back(p.x);
    out.y.push_back(p.y);
    out.z.push_back(p.z);
    out.node_id.push_back(static_cast<std::int64_t>(out.x.size()));
  }
  for (const Mesh::Block& b : mesh.blocks) {
    out.blocks.emplace_back();
    out.blocks.back().id = b.id;
    out.blocks.back().name = b.name;
  }
  for (std::size_t h = 0; h < mesh.hex.size(); ++h) {
    auto& block = out.blocks[static_cast<std::size_t>(mesh.block[h])];
    ++block.global_count;
    for (const std::int32_t n : mesh.hex[h]) block.nodes.push_back(n + 1);
    out.hex_id.push_back(static_cast<std::int64_t>(h) + 1);
  }
  for (const Mesh::SideSet& s : mesh.side_sets) {
    out.side_sets.push_back({s.id, s.name, static_cast<std::int64_t>(s.element.size()), s.element, s.side});
    for (std::int32_t& e : out.side_sets.back().element) ++e;
    for (std::int32_t& f : out.side_sets.back().side) ++f;
  }
  for (const Mesh::NodeSet& s : mesh.node_sets) {
    out.node_sets.push_back({s.id, s.name, static_cast<std::int64_t>(s.node.size()), s.node});
    for (std::int32_t& n : out.node_sets.back().node) ++n;
  }
  if (mesh.variables.empty()) return out;
  out.times = {0};
  for (const Mesh::Variable& v : mesh.variables) {
    out.element_variables.push_back({v.name, std::vector<std::uint8_t>(mesh.blocks.size(), 1)});
    out.element_values.push_back(v.value);
  }
  return out;
}

}  // namespace

void write_mesh(const std::string& path, const Mesh& mesh, const std::string& title) {
  const std::string hidden = sculpt::temporary_name(path);
  sculpt::write_rank_file(hidden, rank_mesh(mesh, title));
  sculpt::publish(hidden, path);
}

}  // namespace hexmesh
