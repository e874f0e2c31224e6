#pragma once
// Directory of the nodes of a distributed mesh: which ranks have elements at a node, and whose node it is.
#include <cstdint>
#include <span>
#include <vector>

#include "distribute/id_index.hpp"
#include "sculpt/base/even_parts.hpp"
#include "sculpt/mesh/element_share.hpp"
#include "sculpt/par/comm.hpp"

namespace sculpt {

// A rank that has elements at a node; item is the position of the node in a list.
struct NodeHolder {
  LocalId item;
  std::int32_t rank;
};

class NodeRanks {
 public:
  // Collective. nodes: those of the corners of the share's elements. Throws AgreedError on numbers that are
  // no nodes.
  NodeRanks(const Comm& comm, const ElementShare& share, const IdIndex& nodes);

  // Both collective; nodes: ascending, each at an element of some rank.
  // The other ranks that have elements there, ascending in the nodes.
  [[nodiscard]] std::vector<NodeHolder> others(std::span<const GlobalId> nodes) const;
  // The ranks of the elements with the smallest numbers there.
  [[nodiscard]] std::vector<std::int32_t> owners(std::span<const GlobalId> nodes) const;

 private:
  [[nodiscard]] std::vector<std::vector<GlobalId>> asked(std::span<const GlobalId> nodes) const;
  [[nodiscard]] std::size_t slot(GlobalId node) const {
    return static_cast<std::size_t>(node - ranges_.begin(comm_.rank()));
  }

  Comm comm_;
  EvenParts ranges_;
  // Of the nodes that this rank keeps.
  std::vector<std::int32_t> owner_;
  std::vector<std::int64_t> first_;  // of each node in ranks_
  std::vector<std::int32_t> ranks_;
};

}  // namespace sculpt
