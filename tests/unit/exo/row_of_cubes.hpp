#pragma once
// A row of unit cubes along x, cell c between x = c and x = c + 1, cut into ranks: small enough to check by
// hand. Node (i,j,k) of the grid has the id 1 + i + (cells + 1) (j + 2 k). Side set 10 is the face x = 0,
// side set 20 ("far") the face at the other end; node set 5 ("floor") holds all nodes with z = 0.
#include <unistd.h>
#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "sculpt/exo/rank_mesh.hpp"
#include "sculpt/exo/write_rank_file.hpp"

namespace sculpt::test {

// A folder that vanishes with the test.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "sculpt-exo-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }
  [[nodiscard]] std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path_))
      names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
  }

 private:
  std::filesystem::path path_;
};

struct Cell {
  std::int64_t block;
  int rank;
};

namespace detail {

inline std::array<std::int64_t, 8> node_ids_of(std::int64_t cell, std::int64_t cells) {
  const auto id = [cells](std::int64_t i, std::int64_t j, std::int64_t k) {
    return 1 + i + (cells + 1) * (j + 2 * k);
  };
  const std::int64_t i = cell;
  return {id(i, 0, 0), id(i + 1, 0, 0), id(i + 1, 1, 0), id(i, 1, 0),
          id(i, 0, 1), id(i + 1, 0, 1), id(i + 1, 1, 1), id(i, 1, 1)};
}

}  // namespace detail

// What one rank of `ranks` holds of the row.
inline RankMesh row_of_cubes(const std::vector<Cell>& cells, int rank, int ranks) {
  const auto n = static_cast<std::int64_t>(cells.size());
  RankMesh mesh;
  mesh.title = "row of cubes";
  mesh.rank = rank;
  mesh.ranks = ranks;
  mesh.global_hexes = n;
  mesh.global_nodes = 4 * (n + 1);

  std::map<std::int64_t, std::vector<std::int64_t>> cells_of_block;
  for (std::int64_t c = 0; c < n; ++c) cells_of_block[cells[static_cast<std::size_t>(c)].block].push_back(c);
  std::set<std::int64_t> mine, shared;
  for (std::int64_t c = 0; c < n; ++c)
    if (cells[static_cast<std::size_t>(c)].rank == rank)
      for (const std::int64_t id : detail::node_ids_of(c, n)) mine.insert(id);
  std::map<int, std::set<std::int64_t>> shared_with;
  for (std::int64_t c = 0; c < n; ++c) {
    const int other = cells[static_cast<std::size_t>(c)].rank;
    if (other == rank) continue;
    for (const std::int64_t id : detail::node_ids_of(c, n))
      if (mine.contains(id)) {
        shared.insert(id);
        shared_with[other].insert(id);
      }
  }
  for (const std::int64_t id : mine)
    if (!shared.contains(id)) mesh.node_id.push_back(id);
  mesh.internal_nodes = ranks == 1 ? 0 : static_cast<std::int32_t>(mesh.node_id.size());
  mesh.node_id.insert(mesh.node_id.end(), shared.begin(), shared.end());
  mesh.border_nodes = static_cast<std::int32_t>(shared.size());
  std::map<std::int64_t, std::int32_t> local;
  for (std::size_t p = 0; p < mesh.node_id.size(); ++p) {
    const std::int64_t id = mesh.node_id[p] - 1;
    local[id + 1] = static_cast<std::int32_t>(p + 1);
    mesh.x.push_back(static_cast<double>(id % (n + 1)));
    mesh.y.push_back(static_cast<double>(id / (n + 1) % 2));
    mesh.z.push_back(static_cast<double>(id / (n + 1) / 2));
  }
  for (const auto& [other, nodes] : shared_with) {
    auto& map = mesh.node_maps.emplace_back();
    map.rank = other;
    for (const std::int64_t id : nodes) map.nodes.push_back(local.at(id));
  }

  mesh.side_sets = {{10, "", 1, {}, {}}, {20, "far", 1, {}, {}}};
  std::int64_t next_id = 1;
  for (const auto& [block_id, members] : cells_of_block) {
    auto& block = mesh.blocks.emplace_back();
    block.id = block_id;
    block.name = "material " + std::to_string(block_id);
    block.global_count = static_cast<std::int64_t>(members.size());
    for (const std::int64_t c : members) {
      const std::int64_t hex = next_id++;
      if (cells[static_cast<std::size_t>(c)].rank != rank) continue;
      mesh.hex_id.push_back(hex);
      const auto element = static_cast<std::int32_t>(mesh.hex_id.size());
      for (const std::int64_t id : detail::node_ids_of(c, n)) block.nodes.push_back(local.at(id));
      const auto add_side = [element](RankMesh::SideSet& set, std::int32_t side) {
        set.element.push_back(element);
        set.side.push_back(side);
      };
      if (c == 0) add_side(mesh.side_sets[0], 4);
      if (c == n - 1) add_side(mesh.side_sets[1], 2);
      bool on_border = false;
      for (const std::int64_t step : {-1, 1}) {
        const std::int64_t neighbour = c + step;
        if (neighbour < 0 || neighbour >= n) continue;
        const int other = cells[static_cast<std::size_t>(neighbour)].rank;
        if (other == rank) continue;
        on_border = true;
        auto map = std::find_if(mesh.element_maps.begin(), mesh.element_maps.end(),
                                [other](const auto& m) { return m.rank == other; });
        if (map == mesh.element_maps.end()) map = mesh.element_maps.insert(map, {other, {}, {}});
        map->element.push_back(element);
        map->side.push_back(step < 0 ? 4 : 2);
      }
      if (ranks > 1) (on_border ? mesh.border_elements : mesh.internal_elements).push_back(element);
    }
  }
  std::sort(mesh.element_maps.begin(), mesh.element_maps.end(),
            [](const auto& a, const auto& b) { return a.rank < b.rank; });
  mesh.node_sets = {{5, "floor", 2 * (n + 1), {}}};
  for (std::size_t p = 0; p < mesh.z.size(); ++p)
    if (mesh.z[p] == 0) mesh.node_sets[0].node.push_back(static_cast<std::int32_t>(p + 1));
  return mesh;
}

// Writes all rank files of the row under their final names.
inline void write_row(const std::string& base, const std::vector<Cell>& cells, int ranks) {
  for (int r = 0; r < ranks; ++r)
    write_rank_file(rank_file_name(base, ranks, r), row_of_cubes(cells, r, ranks));
}

}  // namespace sculpt::test
