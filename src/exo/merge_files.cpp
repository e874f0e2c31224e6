#include "sculpt/exo/merge_files.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <span>
#include <vector>

#include "exo/exodus_writer.hpp"
#include "sculpt/base/error.hpp"
#include "sculpt/exo/read_exodus.hpp"
#include "sculpt/exo/write_rank_file.hpp"

namespace sculpt {
namespace {

using Ids = std::vector<std::int64_t>;

// Sorted distinct ids; an id's place is its position in the joined file, from 0.
class Numbering {
 public:
  void add(std::span<const std::int64_t> ids) { ids_.insert(ids_.end(), ids.begin(), ids.end()); }
  // Returns an id that was there twice, or -1.
  std::int64_t finish() {
    if (!std::is_sorted(ids_.begin(), ids_.end())) std::sort(ids_.begin(), ids_.end());
    const auto twice = std::adjacent_find(ids_.begin(), ids_.end());
    const std::int64_t doubled = twice == ids_.end() ? -1 : *twice;
    ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
    contiguous_ = !ids_.empty() && ids_.back() - ids_.front() + 1 == static_cast<std::int64_t>(ids_.size());
    return doubled;
  }
  [[nodiscard]] std::size_t place(std::int64_t id) const {
    if (contiguous_) return static_cast<std::size_t>(id - ids_.front());
    return static_cast<std::size_t>(std::lower_bound(ids_.begin(), ids_.end(), id) - ids_.begin());
  }
  [[nodiscard]] const Ids& ids() const { return ids_; }

 private:
  Ids ids_;
  bool contiguous_ = false;
};

bool counts_from_one(const Ids& ids) {
  for (std::size_t n = 0; n < ids.size(); ++n)
    if (ids[n] != static_cast<std::int64_t>(n) + 1) return false;
  return true;
}

class Merger {
 public:
  Merger(const std::string& base, int ranks, const MergeOptions& options) : ranks_(ranks) {
    if (ranks < 1) throw Error(fmt::format("cannot join {} files: expected 1 or more", ranks));
    for (int r = 0; r < ranks; ++r) paths_.push_back(rank_file_name(base, ranks, r, options.extension));
    for (const std::string& path : paths_)
      if (!std::filesystem::exists(path))
        throw Error(fmt::format("'{}' does not exist; expected {} rank files, '{}' to '{}'", path, ranks,
                                paths_.front(), paths_.back()));
  }

  const RankMesh& join() {
    collect_ids();
    place_blocks();
    for (int r = 0; r < ranks_; ++r) add_rank(r);
    finish_sets();
    return mesh_;
  }
  [[nodiscard]] int dropped_variables() const { return dropped_variables_; }

  // The joined values of one variable at one step; after join().
  std::span<const double> values(std::size_t step, std::size_t variable) {
    if (step + 1 != steps_read_) read_step(step);
    return values_[variable];
  }

 private:
  const std::string& path(int r) const { return paths_[static_cast<std::size_t>(r)]; }

  // ---- first reading: what there is, and whether the files belong together

  void collect_ids() {
    for (int r = 0; r < ranks_; ++r) {
      ExodusReader reader(path(r));
      if (r == 0)
        take_header(reader.header());
      else
        compare_header(reader, r);
      nodes_.add(reader.node_ids());
      const Ids elements = reader.element_ids();
      std::size_t at = 0;
      for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
        const ExodusReader::Block& block = reader.header().blocks[b];
        take_type(block, b, r);
        const auto count = static_cast<std::size_t>(block.count);
        block_elements_[b].add(std::span(elements).subspan(at, count));
        at += count;
      }
      elements_.add(elements);
    }
    nodes_.finish();
    if (const std::int64_t id = elements_.finish(); id >= 0)
      throw Error(fmt::format("the files '{}' ... have element {} twice; they are not the parts of one mesh",
                              path(0), id));
    compare_totals();
  }

  void take_header(const ExodusReader::Header& header) {
    if (header.nemesis && header.ranks != ranks_)
      throw Error(
          fmt::format("'{}' was written by a run of {} ranks, expected {}", path(0), header.ranks, ranks_));
    parallel_ = header.nemesis;
    mesh_.title = header.title;
    mesh_.global_nodes = header.global_nodes;
    mesh_.global_hexes = header.global_elements;
    mesh_.large = header.large;
    mesh_.times = header.times;
    mesh_.element_variables = header.element_variables;
    dropped_variables_ = header.other_variables;
    for (const auto& b : header.blocks) {
      auto& block = mesh_.blocks.emplace_back();
      block.id = b.id;
      block.name = b.name;
      block.nodes_per_element = 0;  // until a rank has an element
    }
    block_elements_.resize(header.blocks.size());
    for (const auto& s : header.side_sets) mesh_.side_sets.push_back({s.id, s.name, 0, {}, {}});
    for (const auto& s : header.node_sets) mesh_.node_sets.push_back({s.id, s.name, 0, {}});
    sides_.resize(mesh_.side_sets.size());
  }

  void compare_header(const ExodusReader& reader, int r) {
    const ExodusReader::Header& header = reader.header();
    if (header.nemesis != parallel_ || (parallel_ && header.ranks != ranks_))
      throw Error(
          fmt::format("'{}' was written by a run of {} ranks, expected {}", path(r), header.ranks, ranks_));
    if (parallel_ &&
        (header.global_nodes != mesh_.global_nodes || header.global_elements != mesh_.global_hexes))
      throw Error(
          fmt::format("'{}' belongs to a mesh of {} nodes and {} elements, '{}' to one of {} and {}: "
                      "the files come from different runs",
                      path(r), header.global_nodes, header.global_elements, path(0), mesh_.global_nodes,
                      mesh_.global_hexes));
    compare_ids(header.blocks, mesh_.blocks, r, "blocks");
    compare_ids(header.side_sets, mesh_.side_sets, r, "side sets");
    compare_ids(header.node_sets, mesh_.node_sets, r, "node sets");
    compare_variables(header, r);
  }

  // A block has values when it has them on any rank.
  void compare_variables(const ExodusReader::Header& header, int r) {
    if (header.times != mesh_.times)
      throw Error(fmt::format("'{}' has {} time steps, '{}' has {}, or their times differ", path(r),
                              header.times.size(), path(0), mesh_.times.size()));
    const auto& found = header.element_variables;
    auto& expected = mesh_.element_variables;
    if (!std::equal(found.begin(), found.end(), expected.begin(), expected.end(),
                    [](const auto& a, const auto& b) { return a.name == b.name; }))
      throw Error(fmt::format("'{}' has other element variables than '{}'", path(r), path(0)));
    for (std::size_t v = 0; v < found.size(); ++v)
      for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) expected[v].in_block[b] |= found[v].in_block[b];
  }

  template <class Found, class Expected>
  void compare_ids(const Found& found, Expected& expected, int r, const char* what) {
    if (found.size() != expected.size())
      throw Error(fmt::format("'{}' has {} {}, expected {} as in '{}'", path(r), found.size(), what,
                              expected.size(), path(0)));
    for (std::size_t n = 0; n < found.size(); ++n) {
      if (found[n].id != expected[n].id)
        throw Error(fmt::format("'{}': the {} are in another order than in '{}': id {} where {} was expected",
                                path(r), what, path(0), found[n].id, expected[n].id));
      if (expected[n].name.empty()) expected[n].name = found[n].name;
    }
  }

  // A rank without an element of a block may write any type for it.
  void take_type(const ExodusReader::Block& found, std::size_t b, int r) {
    if (found.count == 0) return;
    auto& block = mesh_.blocks[b];
    if (block.nodes_per_element == 0) {
      block.nodes_per_element = found.nodes_per_element;
      block.type = found.type;
    } else if (block.nodes_per_element != found.nodes_per_element) {
      throw Error(fmt::format("'{}', block {}: elements of {} nodes, other ranks have {}", path(r), block.id,
                              found.nodes_per_element, block.nodes_per_element));
    }
  }

  void compare_totals() const {
    const auto nodes = static_cast<std::int64_t>(nodes_.ids().size());
    const auto elements = static_cast<std::int64_t>(elements_.ids().size());
    if (parallel_ && (nodes != mesh_.global_nodes || elements != mesh_.global_hexes))
      throw Error(fmt::format(
          "the {} files '{}' ... have {} nodes and {} elements together, but their headers say {} "
          "and {}: they come from different runs",
          ranks_, path(0), nodes, elements, mesh_.global_nodes, mesh_.global_hexes));
    constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
    if (nodes > kMost || elements > kMost)
      throw Error(
          fmt::format("the joined mesh has {} nodes and {} elements, a file joined by this program holds at "
                      "most {} of each; use epu of SEACAS",
                      nodes, elements, kMost));
  }

  // ---- second reading: every piece to its place

  void place_blocks() {
    mesh_.node_id = nodes_.ids();
    mesh_.global_nodes = static_cast<std::int64_t>(mesh_.node_id.size());
    for (auto* axis : {&mesh_.x, &mesh_.y, &mesh_.z}) axis->resize(mesh_.node_id.size());
    seen_.resize(mesh_.node_id.size());
    for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
      auto& block = mesh_.blocks[b];
      block_elements_[b].finish();
      const Ids& ids = block_elements_[b].ids();
      if (block.nodes_per_element == 0) block.nodes_per_element = 8;  // empty on every rank
      block.global_count = static_cast<std::int64_t>(ids.size());
      block.nodes.resize(ids.size() * static_cast<std::size_t>(block.nodes_per_element));
      first_of_block_.push_back(mesh_.hex_id.size());
      mesh_.hex_id.insert(mesh_.hex_id.end(), ids.begin(), ids.end());
    }
    mesh_.global_hexes = static_cast<std::int64_t>(mesh_.hex_id.size());
  }

  void add_rank(int r) {
    ExodusReader reader(path(r));
    const std::vector<std::int32_t> node = add_nodes(reader, r);
    const std::vector<std::int32_t> element = add_elements(reader, node);
    std::vector<std::int32_t> local, side;
    for (std::size_t s = 0; s < mesh_.side_sets.size(); ++s) {
      reader.side_set(s, local, side);
      for (std::size_t n = 0; n < local.size(); ++n)
        sides_[s].push_back({element[static_cast<std::size_t>(local[n] - 1)], side[n]});
    }
    for (std::size_t s = 0; s < mesh_.node_sets.size(); ++s)
      for (const std::int32_t n : reader.node_set(s))
        mesh_.node_sets[s].node.push_back(node[static_cast<std::size_t>(n - 1)]);
  }

  // Returns the joined node, from 1, of each local one.
  std::vector<std::int32_t> add_nodes(ExodusReader& reader, int r) {
    const Ids ids = reader.node_ids();
    std::vector<double> x, y, z;
    reader.coordinates(x, y, z);
    std::vector<std::int32_t> joined(ids.size());
    for (std::size_t n = 0; n < ids.size(); ++n) {
      const std::size_t place = nodes_.place(ids[n]);
      joined[n] = static_cast<std::int32_t>(place + 1);
      if (seen_[place] == r + 1)
        throw Error(
            fmt::format("'{}' has node {} twice; is its table of node ids missing?", path(r), ids[n]));
      if (seen_[place] != 0 && (mesh_.x[place] != x[n] || mesh_.y[place] != y[n] || mesh_.z[place] != z[n]))
        throw Error(
            fmt::format("'{}': node {} lies at ({}, {}, {}), but at ({}, {}, {}) in the file of a lower rank",
                        path(r), ids[n], x[n], y[n], z[n], mesh_.x[place], mesh_.y[place], mesh_.z[place]));
      seen_[place] = r + 1;
      mesh_.x[place] = x[n];
      mesh_.y[place] = y[n];
      mesh_.z[place] = z[n];
    }
    return joined;
  }

  // The joined element, from 1, of each element of a rank file.
  [[nodiscard]] std::vector<std::int32_t> joined_elements(ExodusReader& reader) const {
    const Ids ids = reader.element_ids();
    std::vector<std::int32_t> joined;
    joined.reserve(ids.size());
    for (std::size_t b = 0; b < mesh_.blocks.size(); ++b)
      for (std::int64_t e = 0; e < reader.header().blocks[b].count; ++e)
        joined.push_back(
            static_cast<std::int32_t>(first_of_block_[b] + block_elements_[b].place(ids[joined.size()]) + 1));
    return joined;
  }

  std::vector<std::int32_t> add_elements(ExodusReader& reader, const std::vector<std::int32_t>& node) {
    std::vector<std::int32_t> joined = joined_elements(reader);
    std::size_t local = 0;
    for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
      const std::vector<std::int32_t> nodes = reader.connectivity(b);
      auto& block = mesh_.blocks[b];
      const auto width = static_cast<std::size_t>(block.nodes_per_element);
      for (std::size_t e = 0; e < nodes.size() / width; ++e, ++local) {
        const std::size_t place = static_cast<std::size_t>(joined[local]) - 1 - first_of_block_[b];
        for (std::size_t c = 0; c < width; ++c)
          block.nodes[place * width + c] = node[static_cast<std::size_t>(nodes[e * width + c] - 1)];
      }
    }
    return joined;
  }

  void read_step(std::size_t step) {
    values_.assign(mesh_.element_variables.size(), std::vector<double>(mesh_.hex_id.size(), 0));
    for (int r = 0; r < ranks_; ++r) {
      ExodusReader reader(path(r));
      const std::vector<std::int32_t> element = joined_elements(reader);
      for (std::size_t v = 0; v < values_.size(); ++v) {
        const std::vector<double> local = reader.element_values(step, v);
        for (std::size_t e = 0; e < local.size(); ++e)
          values_[v][static_cast<std::size_t>(element[e]) - 1] = local[e];
      }
    }
    steps_read_ = step + 1;
  }

  void finish_sets() {
    for (std::size_t s = 0; s < sides_.size(); ++s) {
      std::sort(sides_[s].begin(), sides_[s].end());
      auto& set = mesh_.side_sets[s];
      for (const auto& [element, side] : sides_[s]) {
        set.element.push_back(element);
        set.side.push_back(side);
      }
      set.global_count = static_cast<std::int64_t>(set.element.size());
    }
    for (auto& set : mesh_.node_sets) {
      std::sort(set.node.begin(), set.node.end());
      set.node.erase(std::unique(set.node.begin(), set.node.end()), set.node.end());
      set.global_count = static_cast<std::int64_t>(set.node.size());
    }
  }

  int ranks_;
  std::vector<std::string> paths_;
  bool parallel_ = false;
  int dropped_variables_ = 0;
  Numbering nodes_, elements_;
  std::vector<Numbering> block_elements_;
  std::vector<std::size_t> first_of_block_;
  std::vector<int> seen_;  // 1 + the last rank that had the node; 0 = none yet
  std::vector<std::vector<std::pair<std::int32_t, std::int32_t>>> sides_;  // (element, side) of each side set
  RankMesh mesh_;
  std::vector<std::vector<double>> values_;  // of the step that was read last, per variable
  std::size_t steps_read_ = 0;
};

}  // namespace

MergeResult merge_files(const std::string& base, int ranks, const MergeOptions& options) {
  Merger merger(base, ranks, options);
  const RankMesh& mesh = merger.join();
  MergeResult result;
  result.path = options.output;
  if (result.path.empty())
    result.path =
        base + "." + (options.output_extension.empty() ? options.extension : options.output_extension);
  result.nodes = mesh.global_nodes;
  result.elements = mesh.global_hexes;
  result.blocks = mesh.blocks.size();
  result.side_sets = mesh.side_sets.size();
  result.node_sets = mesh.node_sets.size();
  result.element_variables = mesh.element_variables.size();
  result.time_steps = mesh.times.size();
  result.dropped_variables = merger.dropped_variables();
  const std::string temporary = temporary_name(result.path);
  write_exodus(temporary, mesh, {false, !counts_from_one(mesh.node_id), !counts_from_one(mesh.hex_id)},
               [&](std::size_t step, std::size_t variable) { return merger.values(step, variable); });
  try {
    publish(temporary, result.path);
  } catch (...) {
    discard(temporary);
    throw;
  }
  return result;
}

}  // namespace sculpt
