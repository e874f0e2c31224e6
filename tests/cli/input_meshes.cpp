#include "input_meshes.hpp"

#include <algorithm>
#include <array>

#include "kinds.hpp"
#include "sculpt/exo/write_rank_file.hpp"

namespace sculpt::cli {
namespace {

template <class Blocks>
HexPlaces places(const Blocks& blocks, std::int64_t id, const std::vector<double>& x,
                 const std::vector<double>& y, const std::vector<double>& z) {
  HexPlaces hexes;
  for (const auto& block : blocks)
    if (block.id == id)
      for (std::size_t first = 0; first < block.nodes.size(); first += 8) {
        auto& hex = hexes.emplace_back();
        for (std::size_t c = 0; c < 8; ++c) {
          const auto n = static_cast<std::size_t>(block.nodes[first + c] - 1);
          hex[c] = {x[n], y[n], z[n]};
        }
      }
  std::sort(hexes.begin(), hexes.end());
  return hexes;
}

}  // namespace

hexmesh::Mesh generated(const std::string& kind, const Words& options) {
  hexmesh::Options all(options);
  return hexmesh::make_mesh(hexmesh::kind_named(kind), all);
}

test::ExodusMesh exodus_mesh(const hexmesh::Mesh& mesh) {
  test::ExodusMesh out;
  for (const Vec3& p : mesh.node) {
    out.x.push_back(p.x);
    out.y.push_back(p.y);
    out.z.push_back(p.z);
  }
  for (const auto& b : mesh.blocks) out.blocks.push_back({b.id, b.name, {}});
  for (std::size_t h = 0; h < mesh.hex.size(); ++h)
    for (const std::int32_t n : mesh.hex[h])
      out.blocks[static_cast<std::size_t>(mesh.block[h])].nodes.push_back(n + 1);
  for (const auto& s : mesh.side_sets) {
    auto& set = out.side_sets.emplace_back();
    set.id = s.id;
    set.name = s.name;
    for (const std::int32_t e : s.element) set.element.push_back(e + 1);
    for (const std::int32_t f : s.side) set.side.push_back(f + 1);
  }
  for (const auto& s : mesh.node_sets) {
    auto& set = out.node_sets.emplace_back();
    set.id = s.id;
    set.name = s.name;
    for (const std::int32_t n : s.node) set.node.push_back(n + 1);
  }
  for (const auto& v : mesh.variables)
    out.variables.push_back({v.name, std::vector<int>(mesh.blocks.size(), 1), {v.value}});
  out.steps = mesh.variables.empty() ? 0 : 1;
  return out;
}

test::ExodusMesh exodus_mesh(const std::string& kind, const Words& options) {
  return exodus_mesh(generated(kind, options));
}

void write_parts(const std::string& path, const test::ExodusMesh& mesh, int ranks,
                 const std::function<int(int)>& rank_of) {
  std::vector<int> rank_of_element;
  for (int e = 0; e < static_cast<int>(mesh.elements()); ++e) rank_of_element.push_back(rank_of(e));
  for (int r = 0; r < ranks; ++r)
    test::write_exodus_mesh(part_file_name(path, ranks, r), test::part_of(mesh, rank_of_element, ranks, r));
}

HexPlaces hexes_of_block(const RankMesh& mesh, std::int64_t id) {
  return places(mesh.blocks, id, mesh.x, mesh.y, mesh.z);
}
HexPlaces hexes_of_block(const test::ExodusMesh& mesh, std::int64_t id) {
  return places(mesh.blocks, id, mesh.x, mesh.y, mesh.z);
}

}  // namespace sculpt::cli
