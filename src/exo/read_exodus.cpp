#include "sculpt/exo/read_exodus.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <map>

#include "exo/exodus_file.hpp"
#include "sculpt/base/error.hpp"

namespace sculpt {
namespace {

using Ints = std::vector<std::int64_t>;

constexpr std::int64_t kLargestInt32 = std::numeric_limits<std::int32_t>::max();

// Sculpt leaves a stray newline where a block has no name.
std::string cleaned(const std::string& name) {
  const bool printable = std::any_of(name.begin(), name.end(),
                                     [](char c) { return static_cast<unsigned char>(c) > ' ' && c != 127; });
  return printable ? name : std::string();
}

std::vector<std::string> read_names(const ExodusFile& file, ex_entity_type type, std::size_t count,
                                    std::size_t longest) {
  std::vector<char> text(count * (longest + 1), '\0');
  std::vector<char*> names(count);
  for (std::size_t n = 0; n < count; ++n) names[n] = &text[n * (longest + 1)];
  file.must(ex_get_names(file.id(), type, names.data()), "reading the names");
  std::vector<std::string> result(count);
  for (std::size_t n = 0; n < count; ++n) result[n] = cleaned(names[n]);
  return result;
}

Ints read_ids(const ExodusFile& file, ex_entity_type type, std::size_t count, const char* doing) {
  Ints ids(count);
  if (count > 0) file.must(ex_get_ids(file.id(), type, ids.data()), doing);
  return ids;
}

// The largest length of a name that the reading calls are going to deliver.
std::size_t allow_long_names(const ExodusFile& file) {
  const std::int64_t used = ex_inquire_int(file.id(), EX_INQ_DB_MAX_USED_NAME_LENGTH);
  const std::int64_t longest = std::clamp<std::int64_t>(used, 32, 256);
  file.must(ex_set_max_name_length(file.id(), static_cast<int>(longest)), "setting the length of names");
  return static_cast<std::size_t>(longest);
}

void check_range(const std::string& path, const std::string& where, const std::vector<std::int32_t>& list,
                 std::int64_t largest, const char* what, std::int64_t first = 0, std::int64_t per_item = 1) {
  for (std::size_t n = 0; n < list.size(); ++n)
    if (list[n] < 1 || list[n] > largest)
      throw Error(fmt::format("'{}', {}, entry {}: {} {} does not exist, expected 1 to {}", path, where,
                              first + static_cast<std::int64_t>(n) / per_item + 1, what, list[n], largest));
}

// The range with its end known. Ranges come from this program, never from a file.
ExodusRange within(ExodusRange range, std::int64_t size) {
  if (range.count == ExodusRange::kToTheEnd) range.count = size - range.first;
  check(range.first >= 0 && range.count >= 0 && range.first + range.count <= size,
        "exodus: items beyond the end of a list");
  return range;
}

void refuse_repetitions(const std::string& path, const char* what, Ints ids) {
  std::sort(ids.begin(), ids.end());
  const auto twice = std::adjacent_find(ids.begin(), ids.end());
  if (twice != ids.end())
    throw Error(fmt::format("'{}': two {}s have the id {}, expected different ids", path, what, *twice));
}

std::vector<std::int32_t> narrowed(const Ints& wide) { return {wide.begin(), wide.end()}; }

}  // namespace

ExodusReader::ExodusReader(const std::string& path)
    : path_(path), file_(std::make_unique<ExodusFile>(ExodusFile::open(path))) {
  read_header();
  read_blocks();
  read_sets();
  read_variables();
  read_global();
}
ExodusReader::~ExodusReader() = default;

void ExodusReader::read_header() {
  ex_init_params p{};
  file_->must(ex_get_init_ext(file_->id(), &p), "reading the header");
  if (p.num_dim != 3)
    throw Error(fmt::format("'{}' is a mesh of {} dimensions, expected 3", path_, p.num_dim));
  if (p.num_nodes < 0 || p.num_elem < 0 || p.num_nodes > kLargestInt32 || p.num_elem > kLargestInt32)
    throw Error(fmt::format("'{}' says that it has {} nodes and {} elements, expected 0 to {} in one file",
                            path_, p.num_nodes, p.num_elem, kLargestInt32));
  header_.title = p.title;
  header_.nodes = p.num_nodes;
  header_.elements = p.num_elem;
  header_.blocks.resize(static_cast<std::size_t>(p.num_elem_blk));
  header_.node_sets.resize(static_cast<std::size_t>(p.num_node_sets));
  header_.side_sets.resize(static_cast<std::size_t>(p.num_side_sets));
  header_.large = (ex_int64_status(file_->id()) & EX_ALL_INT64_DB) != 0;
}

void ExodusReader::read_blocks() {
  auto& blocks = header_.blocks;
  if (blocks.empty()) {
    if (header_.elements > 0)
      throw Error(fmt::format("'{}' says that it has {} elements but no block", path_, header_.elements));
    return;
  }
  const std::size_t longest = allow_long_names(*file_);
  const Ints ids = read_ids(*file_, EX_ELEM_BLOCK, blocks.size(), "reading the block ids");
  refuse_repetitions(path_, "block", ids);
  const auto names = read_names(*file_, EX_ELEM_BLOCK, blocks.size(), longest);
  std::int64_t sum = 0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    ex_block info{};
    info.id = ids[b];
    info.type = EX_ELEM_BLOCK;
    file_->must(ex_get_block_param(file_->id(), &info), "reading a block's header");
    if (info.num_entry < 0 || info.num_entry > header_.elements || info.num_nodes_per_entry < 0 ||
        info.num_nodes_per_entry > 1000 || (info.num_entry > 0 && info.num_nodes_per_entry == 0))
      throw Error(fmt::format("'{}', block {}: {} elements of {} nodes, but the file has {} elements", path_,
                              ids[b], info.num_entry, info.num_nodes_per_entry, header_.elements));
    sum += info.num_entry;
    blocks[b] = {ids[b],         names[b],      info.topology, static_cast<int>(info.num_nodes_per_entry),
                 info.num_entry, info.num_entry};
  }
  if (sum != header_.elements)
    throw Error(fmt::format("'{}': its blocks have {} elements in all, its header says {}", path_, sum,
                            header_.elements));
}

void ExodusReader::read_sets() {
  const auto read = [this](std::vector<Set>& sets, ex_entity_type type, std::int64_t most, const char* what) {
    if (sets.empty()) return;
    const std::size_t longest = allow_long_names(*file_);
    const Ints ids = read_ids(*file_, type, sets.size(), "reading the set ids");
    refuse_repetitions(path_, what, ids);
    const auto names = read_names(*file_, type, sets.size(), longest);
    for (std::size_t s = 0; s < sets.size(); ++s) {
      std::int64_t count = 0, factors = 0;
      file_->must(ex_get_set_param(file_->id(), type, ids[s], &count, &factors), "reading a set's header");
      if (count < 0 || count > most)
        throw Error(
            fmt::format("'{}', {} {}: {} entries, expected at most {}", path_, what, ids[s], count, most));
      sets[s] = {ids[s], names[s], count, count};
    }
  };
  read(header_.side_sets, EX_SIDE_SET, 6 * header_.elements, "side set");
  read(header_.node_sets, EX_NODE_SET, header_.nodes, "node set");
}

void ExodusReader::read_variables() {
  const int id = file_->id();
  const std::int64_t steps = ex_inquire_int(id, EX_INQ_TIME);
  if (steps > 0) {
    header_.times.resize(static_cast<std::size_t>(steps));
    file_->must(ex_get_all_times(id, header_.times.data()), "reading the times");
  }
  const auto variables = [&](ex_entity_type type) {
    int count = 0;
    file_->must(ex_get_variable_param(id, type, &count), "reading the number of variables");
    return count;
  };
  for (const ex_entity_type type : {EX_GLOBAL, EX_NODAL, EX_NODE_SET, EX_SIDE_SET})
    header_.other_variables += variables(type);
  const int count = variables(EX_ELEM_BLOCK);
  if (count == 0) return;
  const std::size_t longest = allow_long_names(*file_), blocks = header_.blocks.size();
  std::vector<char> text(static_cast<std::size_t>(count) * (longest + 1), '\0');
  std::vector<char*> names;
  for (std::size_t v = 0; v < static_cast<std::size_t>(count); ++v) names.push_back(&text[v * (longest + 1)]);
  file_->must(ex_get_variable_names(id, EX_ELEM_BLOCK, count, names.data()),
              "reading the names of the variables");
  std::vector<int> table(blocks * names.size(), 0);
  if (blocks > 0)
    file_->must(ex_get_truth_table(id, EX_ELEM_BLOCK, static_cast<int>(blocks), count, table.data()),
                "reading where variables have values");
  for (std::size_t v = 0; v < names.size(); ++v) {
    auto& variable = header_.element_variables.emplace_back();
    variable.name = names[v];
    for (std::size_t b = 0; b < blocks; ++b) variable.in_block.push_back(table[b * names.size() + v] != 0);
  }
}

void ExodusReader::read_global() {
  header_.global_nodes = header_.nodes;
  header_.global_elements = header_.elements;
  int ranks = 0, ranks_in_file = 0;
  std::array<char, 8> type{};
  if (ex_get_init_info(file_->id(), &ranks, &ranks_in_file, type.data()) < 0 || ranks < 1) return;
  std::int64_t nodes = 0, elements = 0, blocks = 0, node_sets = 0, side_sets = 0;
  if (ex_get_init_global(file_->id(), &nodes, &elements, &blocks, &node_sets, &side_sets) < 0) return;
  if (ranks_in_file != 1)
    throw Error(fmt::format("'{}' holds the meshes of {} ranks, expected 1", path_, ranks_in_file));
  const auto same = [](std::int64_t found, const auto& list) {
    return found == static_cast<std::int64_t>(list.size());
  };
  if (!same(blocks, header_.blocks) || !same(node_sets, header_.node_sets) ||
      !same(side_sets, header_.side_sets))
    return;  // tables of some other program; the local counts stand
  header_.nemesis = true;
  header_.ranks = ranks;
  header_.kind = type[0];
  header_.global_nodes = nodes;
  header_.global_elements = elements;
  const auto assign = [this](auto& entities, const auto& get, const char* doing) {
    if (entities.empty()) return;
    Ints ids(entities.size()), counts(entities.size()), factors(entities.size());
    file_->must(get(ids.data(), counts.data(), factors.data()), doing);
    for (std::size_t e = 0; e < entities.size(); ++e) entities[e].global_count = counts[e];
  };
  const int id = file_->id();
  assign(
      header_.blocks, [id](auto* i, auto* c, auto*) { return ex_get_eb_info_global(id, i, c); },
      "reading the global blocks");
  assign(
      header_.node_sets, [id](auto* i, auto* c, auto* f) { return ex_get_ns_param_global(id, i, c, f); },
      "reading the global node sets");
  assign(
      header_.side_sets, [id](auto* i, auto* c, auto* f) { return ex_get_ss_param_global(id, i, c, f); },
      "reading the global side sets");
}

void ExodusReader::coordinates(std::vector<double>& x, std::vector<double>& y, std::vector<double>& z,
                               ExodusRange nodes) {
  nodes = within(nodes, header_.nodes);
  for (std::vector<double>* axis : {&x, &y, &z}) axis->resize(static_cast<std::size_t>(nodes.count));
  if (nodes.count > 0)
    file_->must(ex_get_partial_coord(file_->id(), nodes.first + 1, nodes.count, x.data(), y.data(), z.data()),
                "reading the coordinates");
}

std::vector<std::int64_t> ExodusReader::node_ids(ExodusRange nodes) {
  nodes = within(nodes, header_.nodes);
  Ints ids(static_cast<std::size_t>(nodes.count));
  if (!ids.empty())
    file_->must(ex_get_partial_id_map(file_->id(), EX_NODE_MAP, nodes.first + 1, nodes.count, ids.data()),
                "reading the node ids");
  return ids;
}

std::vector<std::int64_t> ExodusReader::element_ids(ExodusRange elements) {
  elements = within(elements, header_.elements);
  Ints ids(static_cast<std::size_t>(elements.count));
  if (!ids.empty())
    file_->must(
        ex_get_partial_id_map(file_->id(), EX_ELEM_MAP, elements.first + 1, elements.count, ids.data()),
        "reading the element ids");
  return ids;
}

std::vector<std::int32_t> ExodusReader::connectivity(std::size_t b, ExodusRange elements) {
  const Block& block = header_.blocks.at(b);
  elements = within(elements, block.count);
  std::vector<std::int32_t> nodes(static_cast<std::size_t>(elements.count) *
                                  static_cast<std::size_t>(block.nodes_per_element));
  if (nodes.empty()) return nodes;
  file_->use_int32();
  file_->must(ex_get_partial_conn(file_->id(), EX_ELEM_BLOCK, block.id, elements.first + 1, elements.count,
                                  nodes.data(), nullptr, nullptr),
              "reading the connectivity");
  file_->use_int64();
  check_range(path_, fmt::format("block {}", block.id), nodes, header_.nodes, "node", elements.first,
              block.nodes_per_element);
  return nodes;
}

void ExodusReader::side_set(std::size_t s, std::vector<std::int32_t>& element,
                            std::vector<std::int32_t>& side, ExodusRange entries) {
  const Set& set = header_.side_sets.at(s);
  entries = within(entries, set.count);
  element.resize(static_cast<std::size_t>(entries.count));
  side.resize(static_cast<std::size_t>(entries.count));
  if (entries.count == 0) return;
  file_->use_int32();
  file_->must(ex_get_partial_side_set(file_->id(), set.id, entries.first + 1, entries.count, element.data(),
                                      side.data()),
              "reading a side set");
  file_->use_int64();
  const std::string where = fmt::format("side set {}", set.id);
  check_range(path_, where, element, header_.elements, "element", entries.first);
  check_range(path_, where, side, 6, "side", entries.first);
}

std::vector<std::int32_t> ExodusReader::node_set(std::size_t s, ExodusRange entries) {
  const Set& set = header_.node_sets.at(s);
  entries = within(entries, set.count);
  std::vector<std::int32_t> nodes(static_cast<std::size_t>(entries.count));
  if (nodes.empty()) return nodes;
  file_->use_int32();
  file_->must(ex_get_partial_node_set(file_->id(), set.id, entries.first + 1, entries.count, nodes.data()),
              "reading a node set");
  file_->use_int64();
  check_range(path_, fmt::format("node set {}", set.id), nodes, header_.nodes, "node", entries.first);
  return nodes;
}

std::vector<double> ExodusReader::block_values(std::size_t step, std::size_t variable, std::size_t b,
                                               ExodusRange elements) {
  const Block& block = header_.blocks.at(b);
  elements = within(elements, block.count);
  std::vector<double> values(static_cast<std::size_t>(elements.count), 0);
  if (!values.empty() && header_.element_variables.at(variable).in_block[b] != 0)
    file_->must(ex_get_partial_var(file_->id(), static_cast<int>(step) + 1, EX_ELEM_BLOCK,
                                   static_cast<int>(variable) + 1, block.id, elements.first + 1,
                                   elements.count, values.data()),
                "reading an element variable");
  return values;
}

std::vector<double> ExodusReader::element_values(std::size_t step, std::size_t variable) {
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(header_.elements));
  for (std::size_t b = 0; b < header_.blocks.size(); ++b) {
    const std::vector<double> of_block = block_values(step, variable, b);
    values.insert(values.end(), of_block.begin(), of_block.end());
  }
  return values;
}

void ExodusReader::nemesis(RankMesh& mesh) {
  if (!header_.nemesis) return;
  const int id = file_->id();
  std::int64_t internal = 0, border = 0, external = 0, internal_elements = 0, border_elements = 0;
  std::int64_t node_maps = 0, element_maps = 0;
  if (ex_get_loadbal_param(id, &internal, &border, &external, &internal_elements, &border_elements,
                           &node_maps, &element_maps, 0) < 0)
    return;
  const auto in_range = [](std::int64_t value, std::int64_t most) { return value >= 0 && value <= most; };
  if (!in_range(internal, header_.nodes) || !in_range(border, header_.nodes) ||
      !in_range(internal_elements, header_.elements) || !in_range(border_elements, header_.elements) ||
      !in_range(node_maps, kLargestInt32) || !in_range(element_maps, kLargestInt32))
    throw Error(fmt::format("'{}': its load balance names more nodes or elements than it has", path_));
  mesh.internal_nodes = static_cast<std::int32_t>(internal);
  mesh.border_nodes = static_cast<std::int32_t>(border);
  if (internal_elements + border_elements > 0) {
    Ints inside(static_cast<std::size_t>(internal_elements)), rim(static_cast<std::size_t>(border_elements));
    file_->must(ex_get_processor_elem_maps(id, inside.data(), rim.data(), 0), "reading the border elements");
    mesh.internal_elements = narrowed(inside);
    mesh.border_elements = narrowed(rim);
  }
  if (node_maps + element_maps == 0) return;
  Ints node_id(static_cast<std::size_t>(node_maps)), nodes(node_id.size());
  Ints element_id(static_cast<std::size_t>(element_maps)), elements(element_id.size());
  file_->must(ex_get_cmap_params(id, node_id.data(), nodes.data(), element_id.data(), elements.data(), 0),
              "reading the communication maps");
  const auto fits = [&in_range](const Ints& counts, std::int64_t most) {
    return std::all_of(counts.begin(), counts.end(), [&](std::int64_t c) { return in_range(c, most); });
  };
  if (!fits(nodes, header_.nodes * header_.ranks) || !fits(elements, 6 * header_.elements))
    throw Error(fmt::format("'{}': a communication map has more entries than the mesh", path_));
  // Some programs put all neighbours into one map, so the rank is taken from the entries, never from the
  // map's id.
  std::map<std::int64_t, RankMesh::NodeMap> by_rank;
  for (std::size_t m = 0; m < node_id.size(); ++m) {
    Ints local(static_cast<std::size_t>(nodes[m])), rank(local.size());
    file_->must(ex_get_node_cmap(id, node_id[m], local.data(), rank.data(), 0), "reading a node map");
    for (std::size_t n = 0; n < local.size(); ++n)
      by_rank[rank[n]].nodes.push_back(static_cast<std::int32_t>(local[n]));
  }
  std::map<std::int64_t, RankMesh::ElementMap> faces_by_rank;
  for (std::size_t m = 0; m < element_id.size(); ++m) {
    Ints local(static_cast<std::size_t>(elements[m])), side(local.size()), rank(local.size());
    file_->must(ex_get_elem_cmap(id, element_id[m], local.data(), side.data(), rank.data(), 0),
                "reading an element map");
    for (std::size_t n = 0; n < local.size(); ++n) {
      faces_by_rank[rank[n]].element.push_back(static_cast<std::int32_t>(local[n]));
      faces_by_rank[rank[n]].side.push_back(static_cast<std::int32_t>(side[n]));
    }
  }
  for (auto& [rank, map] : by_rank) {
    check_range(path_, fmt::format("node map of rank {}", rank), map.nodes, header_.nodes, "node");
    map.rank = static_cast<int>(rank);
    mesh.node_maps.push_back(std::move(map));
  }
  for (auto& [rank, map] : faces_by_rank) {
    check_range(path_, fmt::format("element map of rank {}", rank), map.element, header_.elements, "element");
    map.rank = static_cast<int>(rank);
    mesh.element_maps.push_back(std::move(map));
  }
}

bool is_hex(const ExodusReader::Block& block) {
  std::string type = block.type;
  std::transform(type.begin(), type.end(), type.begin(), [](unsigned char c) { return std::tolower(c); });
  return block.nodes_per_element == 8 && (type == "hex" || type == "hex8");
}

RankMesh read_exodus(const std::string& path) {
  ExodusReader reader(path);
  const ExodusReader::Header& header = reader.header();
  RankMesh mesh;
  mesh.title = header.title;
  mesh.ranks = header.ranks;
  mesh.global_nodes = header.global_nodes;
  mesh.global_hexes = header.global_elements;
  mesh.large = header.large;
  reader.coordinates(mesh.x, mesh.y, mesh.z);
  mesh.node_id = reader.node_ids();
  mesh.hex_id = reader.element_ids();
  for (std::size_t b = 0; b < header.blocks.size(); ++b) {
    const auto& found = header.blocks[b];
    auto& block = mesh.blocks.emplace_back();
    block.id = found.id;
    block.name = found.name;
    block.global_count = found.global_count;
    if (found.count == 0) continue;  // whatever type the file gives
    block.nodes = reader.connectivity(b);
    block.type = found.type;
    block.nodes_per_element = found.nodes_per_element;
  }
  for (std::size_t s = 0; s < header.side_sets.size(); ++s) {
    auto& set = mesh.side_sets.emplace_back();
    set.id = header.side_sets[s].id;
    set.name = header.side_sets[s].name;
    set.global_count = header.side_sets[s].global_count;
    reader.side_set(s, set.element, set.side);
  }
  for (std::size_t s = 0; s < header.node_sets.size(); ++s) {
    const auto& set = header.node_sets[s];
    mesh.node_sets.push_back({set.id, set.name, set.global_count, reader.node_set(s)});
  }
  mesh.times = header.times;
  mesh.element_variables = header.element_variables;
  for (std::size_t step = 0; step < mesh.times.size(); ++step)
    for (std::size_t v = 0; v < mesh.element_variables.size(); ++v)
      mesh.element_values.push_back(reader.element_values(step, v));
  reader.nemesis(mesh);
  return mesh;
}

}  // namespace sculpt
