#pragma once
// Writes Exodus files as other programs do, mistakes included, through the library alone: whole meshes, and
// the parts that decomp cuts them into. Lists are as in the file: 1-based.
#include <exodusII.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace sculpt::test {

struct ExodusMesh {
  using Ints = std::vector<std::int64_t>;
  struct Block {
    std::int64_t id = 1;
    std::string name;
    Ints nodes;
    std::string type = "HEX8";
    std::int64_t nodes_per_element = 8;
    [[nodiscard]] std::int64_t count() const {
      return nodes_per_element == 0 ? 0 : static_cast<std::int64_t>(nodes.size()) / nodes_per_element;
    }
  };
  struct SideSet {
    std::int64_t id = 1;
    std::string name;
    Ints element, side;
  };
  struct NodeSet {
    std::int64_t id = 1;
    std::string name;
    Ints node;
  };
  struct Variable {
    std::string name;
    std::vector<int> in_block;
    std::vector<std::vector<double>> steps;  // a value per element of the file
  };
  std::vector<double> x, y, z;
  std::vector<Block> blocks;
  std::vector<SideSet> side_sets;
  std::vector<NodeSet> node_sets;
  std::vector<Variable> variables;
  int steps = 0;
  Ints node_map, element_map;  // empty = none

  bool tables = false;  // those of a part
  int ranks = 1, rank = 0;
  char kind = 'p';
  std::int64_t global_nodes = 0, global_elements = 0;

  int mode = EX_LARGE_MODEL;  // EX_NETCDF4, EX_ALL_INT64_DB
  int word = 8;               // bytes of a floating-point number in the file

  [[nodiscard]] std::int64_t elements() const {
    std::int64_t sum = 0;
    for (const Block& b : blocks) sum += b.count();
    return sum;
  }
};

namespace detail {

template <class Entities>
void put_names(int id, ex_entity_type type, Entities& entities) {
  std::vector<char*> names;
  for (auto& e : entities) names.push_back(e.name.data());
  if (!names.empty()) EXPECT_GE(ex_put_names(id, type, names.data()), 0);
}

inline void put_tables(int id, const ExodusMesh& m) {
  using Ints = ExodusMesh::Ints;
  char kind[] = {m.kind, '\0'};
  EXPECT_GE(ex_put_init_info(id, m.ranks, 1, kind), 0);
  EXPECT_GE(ex_put_init_global(
                id, m.global_nodes, m.global_elements, static_cast<std::int64_t>(m.blocks.size()),
                static_cast<std::int64_t>(m.node_sets.size()), static_cast<std::int64_t>(m.side_sets.size())),
            0);
  const auto ids = [](const auto& entities) {
    Ints list;
    for (const auto& e : entities) list.push_back(e.id);
    return list;
  };
  Ints blocks = ids(m.blocks), nodes = ids(m.node_sets), sides = ids(m.side_sets), zeros(100, 0);
  EXPECT_GE(ex_put_eb_info_global(id, blocks.data(), zeros.data()), 0);
  if (!nodes.empty()) EXPECT_GE(ex_put_ns_param_global(id, nodes.data(), zeros.data(), zeros.data()), 0);
  if (!sides.empty()) EXPECT_GE(ex_put_ss_param_global(id, sides.data(), zeros.data(), zeros.data()), 0);
}

inline void put_variables(int id, const ExodusMesh& m) {
  std::vector<int> table;
  std::vector<char*> names;
  for (const auto& v : m.variables) names.push_back(const_cast<char*>(v.name.c_str()));
  for (std::size_t b = 0; b < m.blocks.size(); ++b)
    for (const auto& v : m.variables) table.push_back(v.in_block[b]);
  const int count = static_cast<int>(names.size());
  EXPECT_GE(ex_put_variable_param(id, EX_ELEM_BLOCK, count), 0);
  EXPECT_GE(ex_put_variable_names(id, EX_ELEM_BLOCK, count, names.data()), 0);
  EXPECT_GE(ex_put_truth_table(id, EX_ELEM_BLOCK, static_cast<int>(m.blocks.size()), count, table.data()), 0);
  for (int step = 0; step < m.steps; ++step) {
    const double time = step;
    EXPECT_GE(ex_put_time(id, step + 1, &time), 0);
    std::int64_t first = 0;
    for (std::size_t b = 0; b < m.blocks.size(); ++b) {
      const std::int64_t n = m.blocks[b].count();
      for (int v = 0; v < count; ++v) {
        const auto& variable = m.variables[static_cast<std::size_t>(v)];
        if (n > 0 && variable.in_block[b] != 0)
          EXPECT_GE(ex_put_var(id, step + 1, EX_ELEM_BLOCK, v + 1, m.blocks[b].id, n,
                               variable.steps[static_cast<std::size_t>(step)].data() + first),
                    0);
      }
      first += n;
    }
  }
}

}  // namespace detail

inline void write_exodus_mesh(const std::string& path, ExodusMesh m) {
  ex_opts(0);
  int memory = 8, disk = m.word;
  const int id = ex_create(path.c_str(), EX_CLOBBER | EX_ALL_INT64_API | m.mode, &memory, &disk);
  ASSERT_GE(id, 0) << path;
  ex_set_max_name_length(id, 255);
  EXPECT_GE(
      ex_put_init(id, "test", 3, static_cast<std::int64_t>(m.x.size()), m.elements(),
                  static_cast<std::int64_t>(m.blocks.size()), static_cast<std::int64_t>(m.node_sets.size()),
                  static_cast<std::int64_t>(m.side_sets.size())),
      0);
  if (m.tables) detail::put_tables(id, m);
  for (const auto& b : m.blocks)
    EXPECT_GE(ex_put_block(id, EX_ELEM_BLOCK, b.id, b.type.c_str(), b.count(), b.nodes_per_element, 0, 0, 0),
              0);
  for (const auto& s : m.side_sets)
    EXPECT_GE(ex_put_set_param(id, EX_SIDE_SET, s.id, static_cast<std::int64_t>(s.element.size()), 0), 0);
  for (const auto& s : m.node_sets)
    EXPECT_GE(ex_put_set_param(id, EX_NODE_SET, s.id, static_cast<std::int64_t>(s.node.size()), 0), 0);
  detail::put_names(id, EX_ELEM_BLOCK, m.blocks);
  detail::put_names(id, EX_SIDE_SET, m.side_sets);
  detail::put_names(id, EX_NODE_SET, m.node_sets);
  if (!m.x.empty()) EXPECT_GE(ex_put_coord(id, m.x.data(), m.y.data(), m.z.data()), 0);
  if (!m.node_map.empty()) EXPECT_GE(ex_put_id_map(id, EX_NODE_MAP, m.node_map.data()), 0);
  if (!m.element_map.empty()) EXPECT_GE(ex_put_id_map(id, EX_ELEM_MAP, m.element_map.data()), 0);
  for (const auto& b : m.blocks)
    if (b.count() > 0) EXPECT_GE(ex_put_conn(id, EX_ELEM_BLOCK, b.id, b.nodes.data(), nullptr, nullptr), 0);
  for (const auto& s : m.side_sets)
    if (!s.element.empty()) EXPECT_GE(ex_put_set(id, EX_SIDE_SET, s.id, s.element.data(), s.side.data()), 0);
  for (const auto& s : m.node_sets)
    if (!s.node.empty()) EXPECT_GE(ex_put_set(id, EX_NODE_SET, s.id, s.node.data(), nullptr), 0);
  if (!m.variables.empty()) detail::put_variables(id, m);
  EXPECT_GE(ex_close(id), 0);
}

// The part of one of `ranks` ranks, as decomp writes it: maps are positions in the whole file, absent blocks
// have no type. Elements of a block are in descending order here, which no program promises not to do, and
// nodes in the order of their first use.
inline ExodusMesh part_of(const ExodusMesh& whole, const std::vector<int>& rank_of_element, int ranks,
                          int rank) {
  ExodusMesh part;
  part.tables = true;
  part.ranks = ranks;
  part.rank = rank;
  part.global_nodes = static_cast<std::int64_t>(whole.x.size());
  part.global_elements = whole.elements();
  part.steps = whole.steps;
  part.mode = whole.mode;
  part.word = whole.word;
  std::map<std::int64_t, std::int64_t> node, element;  // local number of one of the whole
  std::int64_t begin = 0;
  for (const auto& v : whole.variables)
    part.variables.push_back({v.name, v.in_block, std::vector<std::vector<double>>(v.steps.size())});
  for (const auto& b : whole.blocks) {
    auto& block = part.blocks.emplace_back();
    block.id = b.id;
    block.name = b.name;
    for (std::int64_t e = b.count() - 1; e >= 0; --e) {
      const std::int64_t number = begin + e + 1;
      if (rank_of_element[static_cast<std::size_t>(number - 1)] != rank) continue;
      part.element_map.push_back(number);
      element[number] = static_cast<std::int64_t>(part.element_map.size());
      for (std::size_t c = 0; c < 8; ++c) {
        const std::int64_t n = b.nodes[static_cast<std::size_t>(8 * e) + c];
        if (!node.contains(n)) {
          part.node_map.push_back(n);
          node[n] = static_cast<std::int64_t>(part.node_map.size());
          part.x.push_back(whole.x[static_cast<std::size_t>(n - 1)]);
          part.y.push_back(whole.y[static_cast<std::size_t>(n - 1)]);
          part.z.push_back(whole.z[static_cast<std::size_t>(n - 1)]);
        }
        block.nodes.push_back(node[n]);
      }
      for (std::size_t v = 0; v < whole.variables.size(); ++v)
        for (std::size_t s = 0; s < whole.variables[v].steps.size(); ++s)
          part.variables[v].steps[s].push_back(
              whole.variables[v].steps[s][static_cast<std::size_t>(number - 1)]);
    }
    if (block.nodes.empty()) {
      block.type = "NULL";
      block.nodes_per_element = 0;
    }
    begin += b.count();
  }
  for (const auto& s : whole.side_sets) {
    auto& set = part.side_sets.emplace_back();
    set.id = s.id;
    set.name = s.name;
    for (std::size_t n = 0; n < s.element.size(); ++n) {
      if (!element.contains(s.element[n])) continue;
      set.element.push_back(element[s.element[n]]);
      set.side.push_back(s.side[n]);
    }
  }
  for (const auto& s : whole.node_sets) {
    auto& set = part.node_sets.emplace_back();
    set.id = s.id;
    set.name = s.name;
    for (const std::int64_t n : s.node)
      if (node.contains(n)) set.node.push_back(node[n]);
  }
  return part;
}

}  // namespace sculpt::test
