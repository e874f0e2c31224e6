#include "sculpt/input/input_mesh.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "input/mesh_files.hpp"
#include "input/mesh_parts.hpp"
#include "sculpt/base/even_parts.hpp"
#include "sculpt/exo/read_exodus.hpp"
#include "sculpt/par/finding.hpp"

namespace sculpt {
namespace {

// The items of `list` in the order of their numbers.
template <class T>
void reorder(std::vector<T>& list, const std::vector<std::size_t>& order, std::size_t per_item = 1) {
  std::vector<T> sorted;
  sorted.reserve(list.size());
  for (const std::size_t from : order)
    for (std::size_t i = 0; i < per_item; ++i) sorted.push_back(list[per_item * from + i]);
  list = std::move(sorted);
}

std::vector<std::size_t> ascending_order(const std::vector<GlobalId>& numbers) {
  std::vector<std::size_t> order(numbers.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&numbers](std::size_t a, std::size_t b) { return numbers[a] < numbers[b]; });
  return order;
}

// The first corner that has the node of an earlier one; 8 = none.
std::size_t repeated_corner(const std::array<GlobalId, 8>& corner) {
  std::size_t c = 1;
  const auto earlier = [&] { return std::find(corner.begin(), corner.begin() + c, corner[c]); };
  while (c < 8 && earlier() == corner.begin() + c) ++c;
  return c;
}

// Reads a range of the elements, nodes and sets of a file. Mistakes are agreed on one kind after the other,
// and of each kind the first in the whole mesh is told: the message does not depend on the number of ranks.
class MeshReader {
 public:
  MeshReader(const Comm& comm, const MeshFiles& files, const std::string& path)
      : comm_(comm), files_(files), path_(path) {}

  InputMesh read() {
    collectively(comm_, "reading " + files_.mine, [&] {
      file_.emplace(files_.mine);
      if (!files_.parts) check_whole();
    });
    if (files_.parts) numbers_ = numbers_of_parts(comm_, path_, *file_);
    take_header();
    check_types();
    read_elements();
    check_corners();
    read_nodes();
    read_sets();
    if (files_.parts) sort();
    return std::move(mesh_);
  }

 private:
  [[nodiscard]] const ExodusReader::Header& header() const { return file_->header(); }
  // Of elements and nodes of the file, from 0.
  [[nodiscard]] GlobalId element_number(std::int64_t e) const {
    return files_.parts ? numbers_.element[static_cast<std::size_t>(e)] : e;
  }
  [[nodiscard]] GlobalId node_number(std::int64_t n) const {
    return files_.parts ? numbers_.node[static_cast<std::size_t>(n)] : n;
  }
  // What this rank reads of a list of the file.
  [[nodiscard]] ExodusRange range_of(std::int64_t items) const {
    if (files_.parts) return {0, items};
    const EvenParts parts{items, comm_.size()};
    return {parts.begin(comm_.rank()), parts.end(comm_.rank()) - parts.begin(comm_.rank())};
  }

  void check_whole() const {
    if (header().nemesis && header().ranks > 1)
      throw Error(
          fmt::format("'{}' is one of {} parts of a mesh; expected the whole mesh, or on {} ranks the name "
                      "without the numbers of part and parts",
                      files_.mine, header().ranks, header().ranks));
    if (header().elements == 0) throw Error(fmt::format("'{}' has no elements", files_.mine));
  }

  void take_header() {
    mesh_.decomposed = files_.parts;
    mesh_.share.elements = files_.parts ? header().global_elements : header().elements;
    mesh_.share.nodes = files_.parts ? header().global_nodes : header().nodes;
    for (const auto& block : header().blocks) mesh_.blocks.push_back({block.id, block.name});
    for (const auto& set : header().side_sets) mesh_.side_sets.push_back({set.id, set.name, {}, {}});
    for (const auto& set : header().node_sets) mesh_.node_sets.push_back({set.id, set.name, {}});
    if (!header().times.empty())
      for (const auto& variable : header().element_variables) mesh_.variables.push_back(variable.name);
    mesh_.share.values_per_element = static_cast<int>(mesh_.variables.size());
    // Parts have the same names, but some programs leave them to the first.
    for (auto& block : mesh_.blocks) block.name = comm_.broadcast(std::move(block.name), 0);
    for (auto& set : mesh_.side_sets) set.name = comm_.broadcast(std::move(set.name), 0);
    for (auto& set : mesh_.node_sets) set.name = comm_.broadcast(std::move(set.name), 0);
  }

  void check_types() const {
    Finding bad;
    std::int64_t first = 0;
    for (const auto& block : header().blocks) {
      if (block.count > 0 && !is_hex(block) && element_number(first) < bad.at)
        bad = {element_number(first),
               fmt::format("'{}', block {}, element {}: found {} with {} nodes, expected HEX8 with 8 nodes",
                           path_, block.id, element_number(first) + 1, block.type, block.nodes_per_element)};
      first += block.count;
    }
    refuse_first(comm_, bad);
  }

  void read_elements() {
    collectively(comm_, "reading " + files_.mine, [&] {
      const ExodusRange mine = range_of(header().elements);
      const auto count = static_cast<std::size_t>(mine.count);
      mesh_.share.element.reserve(count);
      mesh_.share.corner.reserve(count);
      mesh_.share.block.reserve(count);
      mesh_.share.value.resize(count * mesh_.variables.size());
      std::int64_t begin = 0;  // of the block
      for (std::size_t b = 0; b < header().blocks.size(); ++b) {
        const std::int64_t end = begin + header().blocks[b].count;
        const std::int64_t from = std::max(begin, mine.first), to = std::min(end, mine.first + mine.count);
        if (from < to) read_elements(b, begin, {from - begin, to - from});
        begin = end;
      }
    });
  }

  // Elements of a block that begins with the element `begin` of the file.
  void read_elements(std::size_t b, std::int64_t begin, ExodusRange range) {
    ElementShare& share = mesh_.share;
    const std::vector<std::int32_t> nodes = file_->connectivity(b, range);
    const std::size_t known = share.element.size(), variables = mesh_.variables.size();
    for (std::size_t e = 0; e < static_cast<std::size_t>(range.count); ++e) {
      share.element.push_back(element_number(begin + range.first + static_cast<std::int64_t>(e)));
      share.block.push_back(static_cast<std::int32_t>(b));
      auto& corner = share.corner.emplace_back();
      for (std::size_t c = 0; c < 8; ++c) corner[c] = node_number(nodes[8 * e + c] - 1);
    }
    for (std::size_t v = 0; v < variables; ++v) {
      const std::vector<double> values = file_->block_values(header().times.size() - 1, v, b, range);
      for (std::size_t e = 0; e < values.size(); ++e) share.value[(known + e) * variables + v] = values[e];
    }
  }

  void check_corners() const {
    const ElementShare& share = mesh_.share;
    Finding bad;
    for (std::size_t e = 0; e < share.element.size(); ++e) {
      const std::size_t c = repeated_corner(share.corner[e]);
      if (c < 8 && share.element[e] < bad.at)
        bad = {
            share.element[e],
            fmt::format("'{}': element {} of block {} has node {} at two corners, expected eight different "
                        "nodes",
                        path_, share.element[e] + 1,
                        mesh_.blocks[static_cast<std::size_t>(share.block[e])].id, share.corner[e][c] + 1)};
    }
    refuse_first(comm_, bad);
  }

  void read_nodes() {
    ElementShare& share = mesh_.share;
    Finding bad;
    collectively(comm_, "reading " + files_.mine, [&] {
      const ExodusRange mine = range_of(header().nodes);
      std::vector<double> x, y, z;
      file_->coordinates(x, y, z, mine);
      share.node.reserve(x.size());
      share.position.reserve(x.size());
      for (std::size_t n = 0; n < x.size(); ++n) {
        share.node.push_back(node_number(mine.first + static_cast<std::int64_t>(n)));
        share.position.push_back({x[n], y[n], z[n]});
        const bool finite = std::isfinite(x[n]) && std::isfinite(y[n]) && std::isfinite(z[n]);
        if (!finite && share.node[n] < bad.at)
          bad = {share.node[n], fmt::format("'{}': node {} is at ({}, {}, {}), expected finite coordinates",
                                            path_, share.node[n] + 1, x[n], y[n], z[n])};
      }
    });
    refuse_first(comm_, bad);
  }

  void read_sets() {
    Finding bad;  // place: the number of the set, side sets first
    std::int64_t number = 0;
    try {
      for (std::size_t s = 0; s < mesh_.side_sets.size(); ++s, ++number) read_side_set(s);
      for (std::size_t s = 0; s < mesh_.node_sets.size(); ++s, ++number) read_node_set(s);
    } catch (...) {
      bad = {number, current_exception_text()};
    }
    refuse_first(comm_, bad);
  }

  void read_side_set(std::size_t s) {
    InputMesh::SideSet& set = mesh_.side_sets[s];
    std::vector<std::int32_t> element;
    file_->side_set(s, element, set.face, range_of(header().side_sets[s].count));
    for (const std::int32_t e : element) set.element.push_back(element_number(e - 1));
    for (std::int32_t& face : set.face) --face;
  }

  void read_node_set(std::size_t s) {
    for (const std::int32_t n : file_->node_set(s, range_of(header().node_sets[s].count)))
      mesh_.node_sets[s].node.push_back(node_number(n - 1));
  }

  void sort() {
    ElementShare& share = mesh_.share;
    const auto elements = ascending_order(share.element);
    reorder(share.element, elements);
    reorder(share.corner, elements);
    reorder(share.block, elements);
    reorder(share.value, elements, mesh_.variables.size());
    const auto nodes = ascending_order(share.node);
    reorder(share.node, nodes);
    reorder(share.position, nodes);
  }

  const Comm& comm_;
  const MeshFiles& files_;
  const std::string& path_;
  std::optional<ExodusReader> file_;
  PartNumbers numbers_;  // of parts
  InputMesh mesh_;
};

void print_summary(const Log& log, const MeshFiles& files, const InputMesh& mesh) {
  log.line("Summary of imported exodus hex mesh parameters");
  log.line("  File Name            {}", files.shown);
  log.line("  Number of Elements   {}", mesh.share.elements);
  log.line("  Number of Nodes      {}", mesh.share.nodes);
  log.line("  Number of Blocks     {}", mesh.blocks.size());
  log.line("  Element Variables    {}", mesh.variables.size());
  log.line("  Number of Side Sets  {}", mesh.side_sets.size());
  log.line("  Number of Node Sets  {}", mesh.node_sets.size());
}

}  // namespace

InputMesh read_input_mesh(const Comm& comm, const std::string& path, const Log& log) {
  const MeshFiles files = find_mesh_files(comm, path, log);
  InputMesh mesh = MeshReader(comm, files, path).read();
  check_hexes(comm, mesh, path);
  print_summary(log, files, mesh);
  return mesh;
}

}  // namespace sculpt
