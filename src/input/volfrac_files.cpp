#include "sculpt/input/volfrac_files.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <string_view>

#include "input/mesh_files.hpp"
#include "sculpt/base/even_parts.hpp"
#include "sculpt/exo/read_exodus.hpp"
#include "sculpt/input/element_fractions.hpp"
#include "sculpt/par/finding.hpp"

namespace sculpt {
namespace {

constexpr std::string_view kPrefix = "vfrac_", kVoidPrefix = "vfrac_void_";

// The id behind the prefix of a name; nothing when there is no number that an id can be.
std::optional<std::int64_t> id_behind(std::string_view name, std::string_view prefix) {
  if (!name.starts_with(prefix)) return std::nullopt;
  name.remove_prefix(prefix.size());
  std::int64_t id = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), id);
  if (error != std::errc{} || end != name.data() + name.size() || id < 0) return std::nullopt;
  return id;
}

std::string id_list(const std::vector<std::string>& names) {
  constexpr std::size_t kMostShown = 5;
  const auto end = names.begin() + static_cast<std::ptrdiff_t>(std::min(names.size(), kMostShown));
  return fmt::format("{}{}", fmt::join(names.begin(), end, ", "), names.size() > kMostShown ? ", ..." : "");
}

std::vector<std::string> variables_of(const ExodusReader::Header& header) {
  std::vector<std::string> names;
  for (const auto& variable : header.element_variables) names.push_back(variable.name);
  return names;
}

// Refuses a file that cannot be one of `parts`.
void check_header(const ExodusReader& file, std::size_t parts) {
  const ExodusReader::Header& header = file.header();
  const std::size_t ranks = header.nemesis ? static_cast<std::size_t>(header.ranks) : 1;
  if (ranks != parts || header.kind != 'p')
    throw Error(
        fmt::format("'{}' says that it is one of {} parts, expected one of {}", file.path(), ranks, parts));
  if (header.blocks.size() != 1)
    throw Error(fmt::format("'{}' has {} blocks, expected one with the cells of a grid", file.path(),
                            header.blocks.size()));
  const auto& block = header.blocks[0];
  if (block.count > 0 && !is_hex(block))
    throw Error(fmt::format("'{}', block {}: found {} with {} nodes, expected HEX8 with 8 nodes", file.path(),
                            block.id, block.type, block.nodes_per_element));
  if (header.element_variables.empty() || header.times.empty())
    throw Error(
        fmt::format("'{}' has no element variables with values, expected the fraction vfrac_<id> of "
                    "every material",
                    file.path()));
  if (!volfrac_materials(variables_of(header)))
    throw Error(
        fmt::format("'{}' has the element variables {}; expected vfrac_<id> of every material, each "
                    "id once, the void as vfrac_void_<id>",
                    file.path(), id_list(variables_of(header))));
}

// What all parts say alike, in words.
std::string claims_of(const ExodusReader::Header& header) {
  return fmt::format("{} nodes and {} elements in all, {} time steps, element variables {}",
                     header.nemesis ? header.global_nodes : header.nodes,
                     header.nemesis ? header.global_elements : header.elements, header.times.size(),
                     fmt::join(variables_of(header), ", "));
}

class VolfracReader {
 public:
  VolfracReader(const Comm& comm, const std::string& base, const VolfracFiles& files)
      : comm_(comm), base_(base), files_(files) {}

  VolfracCells read() {
    check_parts();
    collectively(comm_, "reading volume fractions", [&] {
      read_elements();
      sort_elements();
      sort_nodes();
    });
    Fractions found;
    collectively(comm_, "reading volume fractions", [&] { found = read_fractions(); });
    cells_.fractions = checked_fractions(comm_, base_, names_, cells_.share.element, std::move(found));
    return std::move(cells_);
  }

 private:
  // A range of the elements of a file that this rank reads.
  struct Piece {
    std::size_t file;
    ExodusRange range;
    std::unique_ptr<ExodusReader> reader;
  };

  // Rank r looks at the headers of the files r, r + P, ...
  void check_parts() {
    std::vector<std::int64_t> count(files_.names.size(), 0);
    std::vector<std::string> claims(files_.names.size());
    collectively(comm_, "reading volume fractions", [&] {
      for (std::size_t f = at(comm_.rank()); f < count.size(); f += at(comm_.size())) {
        const ExodusReader file(files_.names[f]);
        check_header(file, count.size());
        count[f] = file.header().elements;
        claims[f] = claims_of(file.header());
        if (f > 0) continue;
        names_ = variables_of(file.header());
        totals_ = {file.header().nemesis ? file.header().global_elements : file.header().elements,
                   file.header().nemesis ? file.header().global_nodes : file.header().nodes};
      }
    });
    const std::string first = comm_.broadcast(claims[0], 0);
    collectively(comm_, "comparing the parts", [&] {
      constexpr std::size_t kLongest = 200;
      for (std::size_t f = 0; f < claims.size(); ++f)
        if (!claims[f].empty() && claims[f] != first)
          throw Error(fmt::format("'{}' has {}, but '{}' has {}; expected parts of one run", files_.names[f],
                                  claims[f].substr(0, kLongest), files_.names[0], first.substr(0, kLongest)));
    });
    comm_.broadcast(totals_, 0);
    share_names();
    comm_.sum(count);
    const std::int64_t elements = std::accumulate(count.begin(), count.end(), std::int64_t{0});
    if (elements != totals_[0] || elements == 0)
      throw AgreedError(fmt::format("'{}': its files have {} elements, expected {}", base_, elements,
                                    std::max(totals_[0], std::int64_t{1})));
    cells_.share.elements = totals_[0];
    cells_.share.nodes = totals_[1];
    choose_pieces(count);
  }

  void share_names() {
    std::string text;
    for (const std::string& name : names_) text += name + '\n';
    text = comm_.broadcast(std::move(text), 0);
    names_.clear();
    for (std::size_t from = 0; from < text.size();) {
      const std::size_t end = text.find('\n', from);
      names_.push_back(text.substr(from, end - from));
      from = end + 1;
    }
    cells_.table = *volfrac_materials(names_);
  }

  // This rank's even part of all elements, in the order of the files.
  void choose_pieces(const std::vector<std::int64_t>& count) {
    const EvenParts parts{totals_[0], comm_.size()};
    std::int64_t begin = 0;
    for (std::size_t f = 0; f < count.size(); begin += count[f++]) {
      const std::int64_t from = std::max(begin, parts.begin(comm_.rank()));
      const std::int64_t to = std::min(begin + count[f], parts.end(comm_.rank()));
      if (from < to) pieces_.push_back({f, {from - begin, to - from}, nullptr});
    }
  }

  void read_elements() {
    for (Piece& piece : pieces_) {
      piece.reader = std::make_unique<ExodusReader>(files_.names[piece.file]);
      ExodusReader& file = *piece.reader;
      for (const GlobalId id : file.element_ids(piece.range)) {
        if (id < 1 || id > totals_[0])
          throw Error(
              fmt::format("'{}' has an element number {}, expected 1 to {}", file.path(), id, totals_[0]));
        cells_.share.element.push_back(id - 1);
      }
      read_corners(file, file.connectivity(0, piece.range));
    }
  }

  // The corners of elements, and the nodes that they use.
  void read_corners(ExodusReader& file, const std::vector<std::int32_t>& nodes) {
    ElementShare& share = cells_.share;
    const auto [least, most] = std::minmax_element(nodes.begin(), nodes.end());
    const std::int64_t first = *least;
    const ExodusRange range{first - 1, *most - first + 1};
    const std::vector<std::int64_t> ids = file.node_ids(range);
    std::vector<double> x, y, z;
    file.coordinates(x, y, z, range);
    std::vector<std::uint8_t> used(ids.size(), 0);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      if (n % 8 == 0) share.corner.emplace_back();
      const auto local = static_cast<std::size_t>(nodes[n] - first);
      share.corner.back()[n % 8] = ids[local] - 1;
      used[local] = 1;
    }
    for (std::size_t n = 0; n < ids.size(); ++n) {
      if (used[n] == 0) continue;
      if (ids[n] < 1 || ids[n] > totals_[1] || !std::isfinite(x[n]) || !std::isfinite(y[n]) ||
          !std::isfinite(z[n]))
        throw Error(
            fmt::format("'{}' has a node number {} at ({}, {}, {}), expected 1 to {} and finite "
                        "coordinates",
                        file.path(), ids[n], x[n], y[n], z[n], totals_[1]));
      share.node.push_back(ids[n] - 1);
      share.position.push_back({x[n], y[n], z[n]});
    }
  }

  void sort_elements() {
    ElementShare& share = cells_.share;
    std::vector<std::size_t> order(share.element.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return share.element[a] < share.element[b]; });
    const std::vector<GlobalId> element = std::move(share.element);
    const std::vector<std::array<GlobalId, 8>> corner = std::move(share.corner);
    share.element.clear();
    share.corner.clear();
    place_.resize(order.size());
    for (std::size_t e = 0; e < order.size(); ++e) {
      place_[order[e]] = e;
      share.element.push_back(element[order[e]]);
      share.corner.push_back(corner[order[e]]);
    }
  }

  // Several pieces may have the same node.
  void sort_nodes() {
    ElementShare& share = cells_.share;
    std::vector<std::size_t> order(share.node.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return share.node[a] < share.node[b]; });
    const std::vector<GlobalId> node = std::move(share.node);
    const std::vector<Vec3> position = std::move(share.position);
    share.node.clear();
    share.position.clear();
    for (const std::size_t n : order) {
      if (!share.node.empty() && share.node.back() == node[n] && share.position.back() == position[n])
        continue;
      share.node.push_back(node[n]);
      share.position.push_back(position[n]);
    }
  }

  // What is not 0, with materials ascending in each cell, by the order of the share.
  Fractions read_fractions() {
    struct Entry {
      std::size_t cell;
      std::int32_t material;
      double value;
    };
    std::vector<Entry> entries;
    Fractions found;
    found.offset.assign(place_.size() + 1, 0);
    for (std::size_t v = 0; v < names_.size(); ++v) {
      std::size_t element = 0;
      for (Piece& piece : pieces_) {
        const std::size_t last = piece.reader->header().times.size() - 1;
        for (const double value : piece.reader->block_values(last, v, 0, piece.range)) {
          const std::size_t cell = place_[element++];
          if (value == 0) continue;
          entries.push_back({cell, static_cast<std::int32_t>(v), value});
          ++found.offset[cell + 1];
        }
      }
    }
    std::partial_sum(found.offset.begin(), found.offset.end(), found.offset.begin());
    std::vector<std::int64_t> next(found.offset.begin(), found.offset.end() - 1);
    found.material.resize(entries.size());
    found.value.resize(entries.size());
    for (const Entry& entry : entries) {
      const auto to = static_cast<std::size_t>(next[entry.cell]++);
      found.material[to] = entry.material;
      found.value[to] = entry.value;
    }
    return found;
  }

  static std::size_t at(int rank) { return static_cast<std::size_t>(rank); }

  const Comm& comm_;
  const std::string& base_;
  const VolfracFiles& files_;
  std::vector<std::string> names_;          // of the variables
  std::vector<std::int64_t> totals_{0, 0};  // elements and nodes of all files
  std::vector<Piece> pieces_;
  std::vector<std::size_t> place_;  // in the share, of the elements in the order of reading
  VolfracCells cells_;
};

}  // namespace

std::vector<std::string> volfrac_names(const MaterialTable& materials) {
  std::vector<std::string> names;
  for (const std::int64_t id : materials.block_id) {
    const bool is_void = materials.void_material == static_cast<std::int32_t>(names.size());
    names.push_back(fmt::format("{}{}", is_void ? kVoidPrefix : kPrefix, id));
  }
  return names;
}

std::optional<MaterialTable> volfrac_materials(const std::vector<std::string>& names) {
  MaterialTable table;
  for (const std::string& name : names) {
    std::optional<std::int64_t> id = id_behind(name, kVoidPrefix);
    if (id && table.void_material) return std::nullopt;
    if (id) table.void_material = static_cast<std::int32_t>(table.block_id.size());
    if (!id) id = id_behind(name, kPrefix);
    if (!id || std::find(table.block_id.begin(), table.block_id.end(), *id) != table.block_id.end())
      return std::nullopt;
    table.block_id.push_back(*id);
  }
  return table;
}

VolfracFiles find_volfrac_files(const Comm& comm, const std::string& base, const Log& log) {
  VolfracFiles files;
  files.names = find_parts_of_any_number(comm, base + ".e", log);
  collectively(comm, "reading " + files.names[0], [&] {
    if (comm.rank() != 0) return;
    const ExodusReader first(files.names[0]);
    check_header(first, files.names.size());
    files.block = first.header().blocks[0].name;
  });
  files.block = comm.broadcast(std::move(files.block), 0);
  return files;
}

VolfracCells read_volfrac(const Comm& comm, const std::string& base, const VolfracFiles& files) {
  return VolfracReader(comm, base, files).read();
}

}  // namespace sculpt
