#pragma once
// Connected components of entities that are spread over ranks (cells joined by faces, quads joined by edges).
// The label of a component is the smallest global id in it, so it does not depend on the number of ranks.
// An entity of a periodic mesh and its images count as one.
#include <cstdint>
#include <span>
#include <vector>

#include "sculpt/base/types.hpp"
#include "sculpt/par/comm.hpp"
#include "sculpt/par/ghost_exchange.hpp"

namespace sculpt {

// Sets of local entities, 4 bytes each. The root of a set is its smallest member. Local.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count);
  // Puts an entity that is still alone into the set of a smaller one: cheaper than join.
  void attach(LocalId entity, LocalId smaller) { parent_[index(entity)] = parent_[index(smaller)]; }
  void join(LocalId a, LocalId b) {
    a = root(a);
    b = root(b);
    if (a < b)
      parent_[index(b)] = a;
    else
      parent_[index(a)] = b;
  }
  [[nodiscard]] LocalId root(LocalId entity) {
    while (parent_[index(entity)] != entity) {  // halves the path on its way
      parent_[index(entity)] = parent_[index(parent_[index(entity)])];
      entity = parent_[index(entity)];
    }
    return entity;
  }
  // Per entity the number of its set, from 0, in the order of the roots. Uses up the sets.
  [[nodiscard]] std::vector<std::int32_t> numbered(std::vector<LocalId>& roots) &&;

 private:
  static std::size_t index(LocalId id) { return static_cast<std::size_t>(id); }
  std::vector<LocalId> parent_;
};

struct Components {
  std::vector<std::int32_t> of;  // per local entity: its component, an index into the next two
  std::vector<GlobalId> label;   // smallest id in the component, over all ranks
  std::vector<LocalId> first;    // smallest local member
};

// Collective. sets: what this rank joined; ids: global ids of the local entities, for images those of their
// homes; exchange: theirs. Two entities are in one component when any chain of joins, on whichever ranks,
// leads from one to the other; it is enough that every join is made on one rank. Local components that hang
// together elsewhere only, or through images, stay apart here and have the same label. Takes as many rounds
// of messages as the smallest id needs to travel through the ranks, plus one.
[[nodiscard]] Components connected_components(const Comm& comm, DisjointSets sets,
                                              std::span<const GlobalId> ids, const GhostExchange& exchange);

// Collective. Numbers the components of all ranks from 0 in the order of (group, label), and puts these
// numbers into components.of. group: per local component, the same on all ranks (empty = all equal). Answers
// how many there are.
std::int64_t number_components(const Comm& comm, Components& components, std::span<const GlobalId> ids,
                               std::span<const std::int32_t> group = {});

}  // namespace sculpt
