// The order of the calls is that of SEACAS's own tools. In the classic formats each definition rewrites the
// header and moves the data behind it, so all definitions come first, in calls that define many things at
// once.
#include "exo/exodus_writer.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <limits>

#include "exo/exodus_file.hpp"
#include "sculpt/base/error.hpp"
#include "sculpt/exo/write_rank_file.hpp"

namespace sculpt {
namespace {

using Ints = std::vector<std::int64_t>;

constexpr std::int64_t kLargestInt32 = std::numeric_limits<std::int32_t>::max();
constexpr std::int64_t kClassicVariableBytes = (std::int64_t{1} << 32) - 4;

template <class T>
std::int64_t count(const std::vector<T>& items) {
  return static_cast<std::int64_t>(items.size());
}
std::int64_t elements_of(const RankMesh::Block& block) {
  return count(block.nodes) / block.nodes_per_element;
}

// The library takes lists that it only reads by non-const pointers.
void* writable(const std::vector<std::int32_t>& list) { return const_cast<std::int32_t*>(list.data()); }

bool within(const std::vector<std::int32_t>& list, std::int64_t lo, std::int64_t hi) {
  return std::all_of(list.begin(), list.end(),
                     [lo, hi](std::int64_t value) { return value >= lo && value <= hi; });
}

// ---- before the file is touched: does the mesh keep its promises, and which format holds it?

void check_nemesis(const RankMesh& mesh) {
  const std::int64_t nodes = count(mesh.x), hexes = count(mesh.hex_id);
  const bool given = mesh.ranks > 1 || mesh.internal_nodes + mesh.border_nodes > 0;
  check(!given || mesh.internal_nodes + std::int64_t{mesh.border_nodes} == nodes,
        "rank file: internal and border nodes are not all nodes");
  const bool elements_given =
      mesh.ranks > 1 || !mesh.internal_elements.empty() || !mesh.border_elements.empty();
  check(!elements_given || count(mesh.internal_elements) + count(mesh.border_elements) == hexes,
        "rank file: internal and border elements are not all elements");
  check(within(mesh.internal_elements, 1, hexes) && within(mesh.border_elements, 1, hexes),
        "rank file: element of an element map out of range");
  for (const auto& map : mesh.node_maps)
    check(map.rank >= 0 && map.rank < mesh.ranks && map.rank != mesh.rank && !map.nodes.empty() &&
              within(map.nodes, 1, nodes),
          "rank file: bad node map");
  for (const auto& map : mesh.element_maps)
    check(map.rank >= 0 && map.rank < mesh.ranks && map.rank != mesh.rank && !map.element.empty() &&
              map.element.size() == map.side.size() && within(map.element, 1, hexes) &&
              within(map.side, 1, 6),
          "rank file: bad element map");
}

void check_promises(const RankMesh& mesh) {
  const std::int64_t nodes = count(mesh.x);
  check(mesh.y.size() == mesh.x.size() && mesh.z.size() == mesh.x.size() &&
            mesh.node_id.size() == mesh.x.size(),
        "rank file: coordinates and node ids differ in number");
  check(mesh.rank >= 0 && mesh.rank < mesh.ranks, "rank file: rank out of range");
  std::int64_t elements = 0;
  for (const auto& block : mesh.blocks) {
    check(block.nodes_per_element > 0 && count(block.nodes) % block.nodes_per_element == 0 &&
              within(block.nodes, 1, nodes),
          "rank file: bad connectivity");
    elements += elements_of(block);
  }
  check(elements == count(mesh.hex_id), "rank file: blocks and element ids differ in number");
  for (const auto& set : mesh.side_sets)
    check(set.element.size() == set.side.size() && within(set.element, 1, elements) && within(set.side, 1, 6),
          "rank file: bad side set");
  for (const auto& set : mesh.node_sets) check(within(set.node, 1, nodes), "rank file: bad node set");
  for (const auto& variable : mesh.element_variables)
    check(variable.in_block.size() == mesh.blocks.size(), "rank file: bad element variable");
  check_nemesis(mesh);
}

// Calls visit(kind, id, name) for every block, set and variable (numbered from 1).
template <class Visit>
void for_each_entity(const RankMesh& mesh, const Visit& visit) {
  for (const auto& b : mesh.blocks) visit("block", b.id, b.name);
  for (const auto& s : mesh.side_sets) visit("side set", s.id, s.name);
  for (const auto& s : mesh.node_sets) visit("node set", s.id, s.name);
  std::int64_t number = 0;
  for (const auto& v : mesh.element_variables) visit("element variable", ++number, v.name);
}

std::size_t longest_name(const std::string& path, const RankMesh& mesh) {
  std::size_t longest = 0;
  for_each_entity(mesh, [&](const char* kind, std::int64_t id, const std::string& name) {
    if (name.size() > kLongestExodusName)
      throw Error(fmt::format("cannot write '{}': the name of {} {} has {} characters, Exodus allows {}",
                              shown_name(path), kind, id, name.size(), kLongestExodusName));
    longest = std::max(longest, name.size());
  });
  return longest;
}

ExodusFile::Format format_of(const RankMesh& mesh) {
  std::int64_t largest = std::max(mesh.global_nodes, mesh.global_hexes);
  for_each_entity(mesh,
                  [&](const char*, std::int64_t id, const std::string&) { largest = std::max(largest, id); });
  for (const auto& b : mesh.blocks) largest = std::max(largest, b.global_count);
  for (const auto& s : mesh.side_sets) largest = std::max(largest, s.global_count);
  for (const auto& s : mesh.node_sets) largest = std::max(largest, s.global_count);
  for (const std::int64_t id : mesh.node_id) largest = std::max(largest, id);
  for (const std::int64_t id : mesh.hex_id) largest = std::max(largest, id);
  std::int64_t bytes = 8 * count(mesh.x);
  for (const auto& b : mesh.blocks) bytes = std::max(bytes, 4 * count(b.nodes));
  return {bytes > kClassicVariableBytes, mesh.large || largest > kLargestInt32};
}

// ---- definitions

template <class Entity, class Value>
Ints column(const std::vector<Entity>& entities, const Value& value) {
  Ints numbers;
  numbers.reserve(entities.size());
  for (const Entity& e : entities) numbers.push_back(value(e));
  return numbers;
}
template <class Entity>
Ints ids(const std::vector<Entity>& entities) {
  return column(entities, [](const Entity& e) { return e.id; });
}
template <class Entity>
Ints global_counts(const std::vector<Entity>& entities) {
  return column(entities, [](const Entity& e) { return e.global_count; });
}

void define_header(const ExodusFile& file, const RankMesh& mesh, std::size_t longest) {
  if (longest > 32)
    file.must(ex_set_max_name_length(file.id(), static_cast<int>(longest)), "setting the length of names");
  const std::string title = mesh.title.substr(0, kLongestExodusTitle);  // a longer one overflows a buffer
  file.must(ex_put_init(file.id(), title.c_str(), 3, count(mesh.x), count(mesh.hex_id), count(mesh.blocks),
                        count(mesh.node_sets), count(mesh.side_sets)),
            "writing the header");
  std::array<char, 33> date{}, time{};
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  std::strftime(date.data(), date.size(), "%m/%d/%y", &local);
  std::strftime(time.data(), time.size(), "%H:%M:%S", &local);
  std::string name = "sculpt", version = std::string(SCULPT_VERSION).substr(0, 32);
  char* record[1][4] = {{name.data(), version.data(), date.data(), time.data()}};
  file.must(ex_put_qa(file.id(), 1, record), "writing the QA record");
}

void define_nemesis(const ExodusFile& file, const RankMesh& mesh) {
  const int id = file.id();
  char type[] = "p";
  file.must(ex_put_init_info(id, mesh.ranks, 1, type), "writing the number of ranks");
  file.must(ex_put_init_global(id, mesh.global_nodes, mesh.global_hexes, count(mesh.blocks),
                               count(mesh.node_sets), count(mesh.side_sets)),
            "writing the global counts");
  Ints block_ids = ids(mesh.blocks), block_counts = global_counts(mesh.blocks);
  if (!block_ids.empty())
    file.must(ex_put_eb_info_global(id, block_ids.data(), block_counts.data()), "writing the global blocks");
  Ints node_sets = ids(mesh.node_sets), node_counts = global_counts(mesh.node_sets),
       no_factors(node_sets.size(), 0);
  if (!node_sets.empty())
    file.must(ex_put_ns_param_global(id, node_sets.data(), node_counts.data(), no_factors.data()),
              "writing the global node sets");
  Ints side_sets = ids(mesh.side_sets), side_counts = global_counts(mesh.side_sets);
  no_factors.assign(side_sets.size(), 0);
  if (!side_sets.empty())
    file.must(ex_put_ss_param_global(id, side_sets.data(), side_counts.data(), no_factors.data()),
              "writing the global side sets");
  file.must(ex_put_loadbal_param(id, mesh.internal_nodes, mesh.border_nodes, 0, count(mesh.internal_elements),
                                 count(mesh.border_elements), count(mesh.node_maps), count(mesh.element_maps),
                                 mesh.rank),
            "writing the load balance");
  if (mesh.node_maps.empty() && mesh.element_maps.empty()) return;
  const auto rank = [](const auto& map) { return std::int64_t{map.rank}; };
  Ints node_ranks = column(mesh.node_maps, rank), element_ranks = column(mesh.element_maps, rank);
  Ints nodes = column(mesh.node_maps, [](const auto& map) { return count(map.nodes); });
  Ints elements = column(mesh.element_maps, [](const auto& map) { return count(map.element); });
  file.must(ex_put_cmap_params(id, node_ranks.data(), nodes.data(), element_ranks.data(), elements.data(),
                               mesh.rank),
            "writing the communication maps");
}

void define_blocks(const ExodusFile& file, const RankMesh& mesh, bool define_maps) {
  if (mesh.blocks.empty()) return;
  const Ints block_ids = ids(mesh.blocks), counts = column(mesh.blocks, elements_of);
  const Ints nodes = column(mesh.blocks, [](const auto& b) { return std::int64_t{b.nodes_per_element}; });
  const Ints attributes(mesh.blocks.size(), 0);
  std::vector<char*> types;
  for (const auto& b : mesh.blocks) types.push_back(const_cast<char*>(b.type.c_str()));
  file.must(ex_put_concat_elem_block(file.id(), block_ids.data(), types.data(), counts.data(), nodes.data(),
                                     attributes.data(), define_maps ? 1 : 0),
            "writing the blocks");
}

// Defines all sets and writes their lists.
void write_sets(ExodusFile& file, const RankMesh& mesh) {
  std::vector<ex_set> sets;
  for (const auto& s : mesh.node_sets) {
    ex_set set{};
    set.id = s.id;
    set.type = EX_NODE_SET;
    set.num_entry = count(s.node);
    set.entry_list = s.node.empty() ? nullptr : writable(s.node);
    sets.push_back(set);
  }
  for (const auto& s : mesh.side_sets) {
    ex_set set{};
    set.id = s.id;
    set.type = EX_SIDE_SET;
    set.num_entry = count(s.element);
    set.entry_list = s.element.empty() ? nullptr : writable(s.element);
    set.extra_list = s.side.empty() ? nullptr : writable(s.side);
    sets.push_back(set);
  }
  if (sets.empty()) return;
  file.use_int32();
  file.must(ex_put_sets(file.id(), sets.size(), sets.data()), "writing the sets");
  file.use_int64();
}

// Defines the element variables and where they have values.
void define_variables(const ExodusFile& file, const RankMesh& mesh) {
  if (mesh.element_variables.empty()) return;
  const int count_of = static_cast<int>(mesh.element_variables.size());
  std::vector<int> table;  // block by block; blocks without elements here have their columns all the same
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b)
    for (const auto& v : mesh.element_variables) table.push_back(v.in_block[b]);
  file.must(ex_put_all_var_param(file.id(), 0, 0, count_of, table.data(), 0, nullptr, 0, nullptr),
            "defining the element variables");
}

// ---- data

template <class Entity>
void write_names(const ExodusFile& file, ex_entity_type type, const std::vector<Entity>& entities) {
  if (entities.empty()) return;
  std::vector<char*> names;
  for (const Entity& e : entities) names.push_back(const_cast<char*>(e.name.c_str()));
  file.must(ex_put_names(file.id(), type, names.data()), "writing the names");
}

void write_nodes(const ExodusFile& file, const RankMesh& mesh, bool with_ids) {
  std::string axes[] = {"X", "Y", "Z"};
  char* names[] = {axes[0].data(), axes[1].data(), axes[2].data()};
  file.must(ex_put_coord_names(file.id(), names), "writing the names of the coordinates");
  if (mesh.x.empty()) return;
  file.must(ex_put_coord(file.id(), mesh.x.data(), mesh.y.data(), mesh.z.data()), "writing the coordinates");
  if (with_ids) file.must(ex_put_id_map(file.id(), EX_NODE_MAP, mesh.node_id.data()), "writing the node ids");
}

void write_elements(ExodusFile& file, const RankMesh& mesh, bool with_ids) {
  if (with_ids && !mesh.hex_id.empty())
    file.must(ex_put_id_map(file.id(), EX_ELEM_MAP, mesh.hex_id.data()), "writing the element ids");
  file.use_int32();
  for (const auto& b : mesh.blocks)
    if (!b.nodes.empty())
      file.must(ex_put_conn(file.id(), EX_ELEM_BLOCK, b.id, b.nodes.data(), nullptr, nullptr),
                "writing the connectivity");
  file.use_int64();
}

std::vector<std::int32_t> numbers(std::int32_t first, std::int32_t how_many) {
  std::vector<std::int32_t> list(static_cast<std::size_t>(how_many));
  for (std::int32_t n = 0; n < how_many; ++n) list[static_cast<std::size_t>(n)] = first + n;
  return list;
}

void write_nemesis_maps(ExodusFile& file, const RankMesh& mesh) {
  const int id = file.id();
  file.use_int32();
  if (mesh.internal_nodes + mesh.border_nodes > 0) {
    std::vector<std::int32_t> internal = numbers(1, mesh.internal_nodes);
    std::vector<std::int32_t> border = numbers(mesh.internal_nodes + 1, mesh.border_nodes);
    file.must(ex_put_processor_node_maps(id, internal.data(), border.data(), nullptr, mesh.rank),
              "writing the internal and border nodes");
  }
  if (!mesh.internal_elements.empty() || !mesh.border_elements.empty())
    file.must(ex_put_processor_elem_maps(id, writable(mesh.internal_elements), writable(mesh.border_elements),
                                         mesh.rank),
              "writing the internal and border elements");
  for (const auto& map : mesh.node_maps) {
    std::vector<std::int32_t> ranks(map.nodes.size(), map.rank);
    file.must(ex_put_node_cmap(id, map.rank, writable(map.nodes), ranks.data(), mesh.rank),
              "writing a node map");
  }
  for (const auto& map : mesh.element_maps) {
    std::vector<std::int32_t> ranks(map.element.size(), map.rank);
    file.must(
        ex_put_elem_cmap(id, map.rank, writable(map.element), writable(map.side), ranks.data(), mesh.rank),
        "writing an element map");
  }
  file.use_int64();
}

void write_values(const ExodusFile& file, const RankMesh& mesh, const ElementValues& values) {
  const int id = file.id();
  std::vector<char*> names;
  for (const auto& v : mesh.element_variables) names.push_back(const_cast<char*>(v.name.c_str()));
  if (!names.empty())
    file.must(ex_put_variable_names(id, EX_ELEM_BLOCK, static_cast<int>(names.size()), names.data()),
              "writing the names of the element variables");
  for (std::size_t step = 0; step < mesh.times.size(); ++step) {
    const int at_step = static_cast<int>(step) + 1;
    file.must(ex_put_time(id, at_step, &mesh.times[step]), "writing a time");
    for (std::size_t v = 0; v < names.size(); ++v) {
      const std::span<const double> all = values(step, v);
      check(count(mesh.hex_id) == static_cast<std::int64_t>(all.size()), "rank file: values are missing");
      std::size_t first = 0;
      for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
        const std::int64_t elements = elements_of(mesh.blocks[b]);
        if (elements > 0 && mesh.element_variables[v].in_block[b] != 0)
          file.must(ex_put_var(id, at_step, EX_ELEM_BLOCK, static_cast<int>(v) + 1, mesh.blocks[b].id,
                               elements, all.data() + first),
                    "writing an element variable");
        first += static_cast<std::size_t>(elements);
      }
    }
  }
}

void write_all(const std::string& path, const RankMesh& mesh, ExodusTables tables,
               const ElementValues& values) {
  const std::size_t longest = longest_name(path, mesh);
  ExodusFile file = ExodusFile::create(path, format_of(mesh));
  define_header(file, mesh, longest);
  if (tables.nemesis) define_nemesis(file, mesh);
  define_blocks(file, mesh, tables.node_ids && tables.element_ids && !mesh.x.empty() && !mesh.hex_id.empty());
  define_variables(file, mesh);
  write_sets(file, mesh);
  write_names(file, EX_ELEM_BLOCK, mesh.blocks);
  write_names(file, EX_NODE_SET, mesh.node_sets);
  write_names(file, EX_SIDE_SET, mesh.side_sets);
  write_nodes(file, mesh, tables.node_ids);
  write_elements(file, mesh, tables.element_ids);
  if (tables.nemesis) write_nemesis_maps(file, mesh);
  write_values(file, mesh, values);
  file.close_written();
}

}  // namespace

void write_exodus(const std::string& path, const RankMesh& mesh, ExodusTables tables,
                  const ElementValues& values) {
  check_promises(mesh);
  try {
    write_all(path, mesh, tables, values);
  } catch (...) {
    discard(path);
    throw;
  }
}

}  // namespace sculpt
