#pragma once
// The part of a mesh that one rank writes: everything its Exodus file `base.e.N.r` holds, Nemesis tables
// included. Flat arrays, no MPI, no Exodus types.
//
// Promises between the files of one run, which the readers of the files rely on:
//   - every rank lists the same blocks, side sets and node sets, in the same order, with the same ids, names
//   and
//     global counts; what a rank does not have has empty lists there;
//   - node_id is the same on all ranks that share a node, and so are its coordinates, to the last bit;
//   - hex_id runs 1..N over all ranks without gaps, block by block.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sculpt {

inline constexpr std::size_t kLongestExodusName = 255;  // characters in the name of a block or set
inline constexpr std::size_t kLongestExodusTitle = 80;

struct RankMesh {
  // The hexes of one block; their ids are in hex_id.
  struct Block {
    std::int64_t id = 0;              // 0 is allowed and written as 0
    std::string name;                 // empty = no name
    std::int64_t global_count = 0;    // hexes on all ranks
    std::vector<std::int32_t> nodes;  // 8 local nodes per hex, from 1, Exodus order
    std::string type = "HEX8";        // the mesher writes hexes; files of others may hold anything
    int nodes_per_element = 8;
    bool operator==(const Block&) const = default;
  };
  // Faces of hexes; each is listed by the rank that has the hex.
  struct SideSet {
    std::int64_t id = 0;  // 1 or more: joining programs drop a set with id 0
    std::string name;
    std::int64_t global_count = 0;      // faces on all ranks
    std::vector<std::int32_t> element;  // local hex, from 1, counted over all blocks
    std::vector<std::int32_t> side;     // 1..6, Exodus numbering
    bool operator==(const SideSet&) const = default;
  };
  // Nodes; every rank lists all those that it has.
  struct NodeSet {
    std::int64_t id = 0;  // 1 or more
    std::string name;
    std::int64_t global_count = 0;   // distinct nodes on all ranks
    std::vector<std::int32_t> node;  // local, from 1
    bool operator==(const NodeSet&) const = default;
  };
  // The nodes shared with one other rank.
  struct NodeMap {
    int rank = 0;
    std::vector<std::int32_t> nodes;  // local, from 1, ascending in global id
    bool operator==(const NodeMap&) const = default;
  };
  // The faces of local hexes across which one other rank has the neighbour.
  struct ElementMap {
    int rank = 0;
    std::vector<std::int32_t> element, side;  // local hex from 1; side 1..6
    bool operator==(const ElementMap&) const = default;
  };

  // A number per element and time step.
  struct ElementVariable {
    std::string name;
    std::vector<std::uint8_t> in_block;  // per block: 1 = its elements have values
    bool operator==(const ElementVariable&) const = default;
  };

  std::string title;  // the writer cuts it to 80 characters
  int rank = 0, ranks = 1;
  std::int64_t global_nodes = 0, global_hexes = 0;

  std::vector<double> x, y, z;        // one per local node
  std::vector<std::int64_t> node_id;  // global, from 1
  std::vector<std::int64_t> hex_id;   // global, from 1; block by block in the order of `blocks`

  std::vector<Block> blocks;
  std::vector<SideSet> side_sets;
  std::vector<NodeSet> node_sets;

  std::vector<double> times;  // of the steps; every rank has the same
  std::vector<ElementVariable> element_variables;
  // Step by step, in each variable by variable: a value per element in the order of hex_id, 0 where a block
  // has none.
  std::vector<std::vector<double>> element_values;

  // Nemesis data. With one rank all of it stays empty. With more, internal nodes are the local nodes
  // 1..internal_nodes, the border nodes (those of node_maps) follow; the two element lists share out all
  // hexes.
  std::int32_t internal_nodes = 0, border_nodes = 0;
  std::vector<std::int32_t> internal_elements, border_elements;  // local, from 1
  std::vector<NodeMap> node_maps;                                // ascending rank
  std::vector<ElementMap> element_maps;                          // ascending rank

  bool large = false;  // 64-bit integers on disk (large_exodus)

  bool operator==(const RankMesh&) const = default;
};

}  // namespace sculpt
