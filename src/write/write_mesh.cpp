#include "sculpt/write/write_mesh.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <tuple>

#include "sculpt/exo/rank_mesh.hpp"
#include "sculpt/exo/write_rank_file.hpp"
#include "sculpt/mesh/adjacency.hpp"
#include "sculpt/par/numbering.hpp"

namespace sculpt {
namespace {

// The share of the mesh that this rank writes, in the numbering of its file.
class RankPart {
 public:
  RankPart(const Comm& comm, const HexMesh& mesh, const WriteOptions& options)
      : comm_(comm), mesh_(mesh), options_(options) {
    out_.rank = comm.rank();
    out_.ranks = comm.size();
    out_.large = options.large;
    out_.title = fmt::format("SCULPT Version {}", SCULPT_VERSION);
  }

  // Without the values of variables.
  RankMesh build(const std::vector<SideFace>& side_faces) {
    number_hexes();
    find_shared_nodes();
    number_nodes();
    add_node_sets();
    add_side_sets(side_faces);
    if (comm_.size() > 1) add_element_maps();
    name_variables();
    return std::move(out_);
  }
  // After build(): the hexes in the order of the file.
  [[nodiscard]] const std::vector<LocalId>& hexes() const { return file_hexes_; }

 private:
  void number_hexes() {
    std::vector<GlobalId> keys;
    std::vector<std::int32_t> material;
    std::vector<LocalId> owned;
    for (LocalId h = 0; h < mesh_.size(); ++h) {
      if (mesh_.layer[at(h)] != 0) continue;
      owned.push_back(h);
      keys.push_back(mesh_.hex_id[at(h)]);
      material.push_back(mesh_.material[at(h)]);
    }
    std::vector<std::int64_t> counts;
    const std::vector<GlobalId> number =
        grouped_numbers(comm_, keys, material, options_.block_id.size(), counts);
    for (const std::int64_t c : counts) out_.global_hexes += c;
    // Blocks ascend in material index, hexes of a block in id: the order of the numbers.
    std::vector<std::size_t> start(counts.size() + 1, 0);
    for (const std::int32_t m : material) ++start[static_cast<std::size_t>(m) + 1];
    for (std::size_t m = 0; m < counts.size(); ++m) start[m + 1] += start[m];
    file_hexes_.resize(owned.size());
    out_.hex_id.resize(owned.size());
    block_start_ = start;
    for (std::size_t i = 0; i < owned.size(); ++i) {
      const std::size_t slot = start[static_cast<std::size_t>(material[i])]++;
      file_hexes_[slot] = owned[i];
      out_.hex_id[slot] = number[i] + 1;
    }
    counts_ = std::move(counts);
  }

  // Images are no part of the files: the nodes on the two sides of a period are different ones there.
  [[nodiscard]] bool is_image(LocalId h) const { return mesh_.image_of(h) != Image{0, 0, 0}; }

  // Owners of the hexes around each node that this rank's hexes use, other than this rank.
  void find_shared_nodes() {
    file_node_.assign(mesh_.position.size(), kNone);
    for (const LocalId h : file_hexes_)
      for (const LocalId n : mesh_.hexes[at(h)]) file_node_[at(n)] = 0;
    if (comm_.size() == 1) return;
    std::vector<std::pair<LocalId, std::int32_t>> pairs;
    for (LocalId h = 0; h < mesh_.size(); ++h) {
      if (mesh_.layer[at(h)] == 0 || is_image(h)) continue;
      for (const LocalId n : mesh_.hexes[at(h)])
        if (file_node_[at(n)] != kNone) pairs.emplace_back(n, mesh_.hex_owner[at(h)]);
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    shared_ = std::move(pairs);
  }

  void number_nodes() {
    std::vector<GlobalId> keys;
    std::vector<LocalId> used;
    for (LocalId n = 0; n < mesh_.nodes(); ++n)
      if (file_node_[at(n)] != kNone) {
        keys.push_back(mesh_.node_id[at(n)]);
        used.push_back(n);
      }
    const std::vector<GlobalId> number = dense_numbers(comm_, keys, out_.global_nodes);
    std::vector<std::uint8_t> border(mesh_.position.size(), 0);
    for (const auto& [n, rank] : shared_) border[at(n)] = 1;
    out_.x.reserve(used.size());
    out_.y.reserve(used.size());
    out_.z.reserve(used.size());
    out_.node_id.reserve(used.size());
    for (const bool on_border : {false, true}) {
      for (std::size_t i = 0; i < used.size(); ++i)
        if ((border[at(used[i])] != 0) == on_border) add_node(used[i], number[i] + 1);
      (on_border ? out_.border_nodes : out_.internal_nodes) =
          static_cast<std::int32_t>(out_.node_id.size()) - (on_border ? out_.internal_nodes : 0);
    }
    for (const auto& [n, rank] : shared_) {
      auto map = std::find_if(out_.node_maps.begin(), out_.node_maps.end(),
                              [r = rank](const auto& m) { return m.rank == r; });
      if (map == out_.node_maps.end()) map = out_.node_maps.insert(map, {rank, {}});
      map->nodes.push_back(file_node_[at(n)]);
    }
    std::sort(out_.node_maps.begin(), out_.node_maps.end(),
              [](const auto& a, const auto& b) { return a.rank < b.rank; });
    add_blocks();
  }
  void add_node(LocalId n, GlobalId number) {
    const Vec3& p = mesh_.position[at(n)];
    out_.x.push_back(p.x);
    out_.y.push_back(p.y);
    out_.z.push_back(p.z);
    out_.node_id.push_back(number);
    file_node_[at(n)] = static_cast<LocalId>(out_.node_id.size());
  }

  void add_blocks() {
    for (std::size_t m = 0; m < counts_.size(); ++m) {
      if (counts_[m] == 0) continue;
      RankMesh::Block block;
      block.id = options_.block_id[m];
      block.global_count = counts_[m];
      if (const auto name = options_.block_names.find(block.id); name != options_.block_names.end())
        block.name = name->second;
      block.nodes.reserve(8 * (block_start_[m + 1] - block_start_[m]));
      for (std::size_t i = block_start_[m]; i < block_start_[m + 1]; ++i)
        for (const LocalId n : mesh_.hexes[at(file_hexes_[i])]) block.nodes.push_back(file_node_[at(n)]);
      out_.blocks.push_back(std::move(block));
    }
  }

  void add_node_sets() {
    for (const NodeSet& nodes : options_.node_sets) {
      RankMesh::NodeSet set;
      set.id = nodes.id;
      if (const auto name = options_.node_set_names.find(set.id); name != options_.node_set_names.end())
        set.name = name->second;
      std::vector<GlobalId> keys;
      for (const LocalId n : nodes.node) {
        if (file_node_[at(n)] == kNone) continue;
        keys.push_back(mesh_.node_id[at(n)]);
        set.node.push_back(file_node_[at(n)]);
      }
      (void)dense_numbers(comm_, keys, set.global_count);
      out_.node_sets.push_back(std::move(set));
    }
  }

  // Position of each local hex in the file, from 1.
  [[nodiscard]] std::vector<std::int32_t> places() const {
    std::vector<std::int32_t> place(mesh_.hexes.size(), 0);
    for (std::size_t i = 0; i < file_hexes_.size(); ++i)
      place[at(file_hexes_[i])] = static_cast<std::int32_t>(i) + 1;
    return place;
  }

  void add_side_sets(std::vector<SideFace> faces) {
    std::vector<std::int64_t> ids;
    for (const SideFace& f : faces) ids.push_back(f.set);
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    ids = comm_.concatenate(ids);
    ids.insert(ids.end(), options_.side_sets.begin(), options_.side_sets.end());
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    if (ids.empty()) return;
    const std::vector<std::int32_t> place = places();
    std::sort(faces.begin(), faces.end(), [&](const SideFace& a, const SideFace& b) {
      return std::tuple(a.set, place[at(a.hex)], a.face) < std::tuple(b.set, place[at(b.hex)], b.face);
    });
    std::vector<std::int64_t> counts(ids.size(), 0);
    out_.side_sets.resize(ids.size());
    for (const SideFace& f : faces) {
      const auto s = static_cast<std::size_t>(std::lower_bound(ids.begin(), ids.end(), f.set) - ids.begin());
      out_.side_sets[s].element.push_back(place[at(f.hex)]);
      out_.side_sets[s].side.push_back(f.face + 1);
      ++counts[s];
    }
    comm_.sum(counts);
    for (std::size_t s = 0; s < ids.size(); ++s) {
      out_.side_sets[s].id = ids[s];
      out_.side_sets[s].global_count = counts[s];
      if (const auto name = options_.side_set_names.find(ids[s]); name != options_.side_set_names.end())
        out_.side_sets[s].name = name->second;
    }
  }

  // Faces of owned hexes whose neighbour belongs to another rank.
  void add_element_maps() {
    std::vector<std::uint8_t> shared(mesh_.position.size(), 0);
    for (const auto& [n, rank] : shared_) shared[at(n)] = 1;
    struct Face {
      std::array<LocalId, 4> nodes;
      std::int32_t place, side, rank;  // place 0: a ghost
    };
    std::vector<Face> faces;
    const std::vector<std::int32_t> place = places();
    for (LocalId h = 0; h < mesh_.size(); ++h)
      for (std::size_t f = 0; f < 6 && !is_image(h); ++f) {
        Face face{{}, place[at(h)], static_cast<std::int32_t>(f) + 1, mesh_.hex_owner[at(h)]};
        bool all_shared = true;
        for (std::size_t c = 0; c < 4; ++c) {
          face.nodes[c] = mesh_.hexes[at(h)][static_cast<std::size_t>(kFaces[f][c])];
          all_shared = all_shared && shared[at(face.nodes[c])] != 0;
        }
        if (!all_shared) continue;
        std::sort(face.nodes.begin(), face.nodes.end());
        faces.push_back(face);
      }
    std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) {
      return std::tie(a.nodes, a.place) < std::tie(b.nodes, b.place);
    });
    std::map<std::int32_t, std::vector<std::pair<std::int32_t, std::int32_t>>> by_rank;
    std::vector<std::uint8_t> on_border(file_hexes_.size(), 0);
    for (std::size_t i = 0; i + 1 < faces.size(); ++i) {
      const Face &ghost = faces[i], &own = faces[i + 1];
      if (ghost.nodes != own.nodes || ghost.place != 0 || own.place == 0) continue;
      by_rank[ghost.rank].emplace_back(own.place, own.side);
      on_border[static_cast<std::size_t>(own.place) - 1] = 1;
    }
    for (auto& [rank, sides] : by_rank) {
      std::sort(sides.begin(), sides.end());
      RankMesh::ElementMap map{rank, {}, {}};
      for (const auto& [element, side] : sides) {
        map.element.push_back(element);
        map.side.push_back(side);
      }
      out_.element_maps.push_back(std::move(map));
    }
    for (std::size_t i = 0; i < file_hexes_.size(); ++i)
      (on_border[i] ? out_.border_elements : out_.internal_elements)
          .push_back(static_cast<std::int32_t>(i) + 1);
  }

  void name_variables() {
    if (options_.variables.empty()) return;
    out_.times = {0};
    for (const HexVariable& variable : options_.variables)
      out_.element_variables.push_back({variable.name, std::vector<std::uint8_t>(out_.blocks.size(), 1)});
  }

  const Comm& comm_;
  const HexMesh& mesh_;
  const WriteOptions& options_;
  RankMesh out_;
  std::vector<LocalId> file_hexes_;       // owned hexes in file order
  std::vector<std::size_t> block_start_;  // per material, into file_hexes_
  std::vector<std::int64_t> counts_;      // hexes of each material on all ranks
  std::vector<LocalId> file_node_;        // per local node: its number in the file, kNone = not in it
  std::vector<std::pair<LocalId, std::int32_t>> shared_;  // (node, other rank), ascending
};

}  // namespace

WriteSummary write_mesh(const Comm& comm, const HexMesh& mesh, const std::vector<SideFace>& side_faces,
                        const WriteOptions& options) {
  RankPart share(comm, mesh, options);
  const RankMesh part = share.build(side_faces);
  std::vector<double> values;
  const auto values_of = [&](std::size_t, std::size_t variable) {
    values.clear();
    for (const LocalId h : share.hexes()) values.push_back(options.variables[variable].value(h));
    return std::span<const double>(values);
  };
  const std::string final_name = rank_file_name(options.base, comm.size(), comm.rank());
  const std::string temporary = temporary_name(final_name);
  try {
    collectively(comm, "writing " + final_name, [&] { write_rank_file(temporary, part, values_of); });
    collectively(comm, "publishing " + final_name, [&] { publish(temporary, final_name); });
  } catch (...) {
    discard(temporary);
    throw;
  }
  return {part.global_nodes, part.global_hexes, part.blocks.size(), part.node_sets.size(),
          part.side_sets.size()};
}

namespace {

// Local. Tries to write beside a file that is going to be written; `setting` begins the messages.
void check_writable(const std::string& setting, const std::string& final_name) {
  const auto folder = std::filesystem::path(final_name).parent_path();
  if (std::filesystem::exists(folder) && !std::filesystem::is_directory(folder))
    throw Error(fmt::format("{}: {} is a file, expected a folder", setting, folder.string()));
  if (!folder.empty() && !std::filesystem::is_directory(folder))
    throw Error(fmt::format("{}: the folder {} does not exist", setting, folder.string()));
  if (std::filesystem::is_directory(final_name))
    throw Error(fmt::format("{}: {} is a folder, expected to write a file there", setting, final_name));
  const std::string probe = temporary_name(final_name);
  std::FILE* file = std::fopen(probe.c_str(), "w");
  if (file == nullptr)
    throw Error(fmt::format("{}: cannot write {}: {}", setting, final_name, std::strerror(errno)));
  std::fclose(file);
  discard(probe);
}

}  // namespace

void check_output_folder(const Comm& comm, const std::string& option, const std::string& base) {
  collectively(comm, "checking the output folder", [&] {
    check_writable(option + " = " + base, rank_file_name(base, comm.size(), comm.rank()));
  });
}

void check_output_file(const Comm& comm, const std::string& option, const std::string& file_name) {
  collectively(comm, "checking " + file_name, [&] {
    if (comm.rank() == 0) check_writable(option + " = " + file_name, file_name);
  });
}

}  // namespace sculpt
