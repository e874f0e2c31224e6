#pragma once
// Which rank should have which object, so that all have about as many and neighbours stay together: methods
// of Zoltan (Devine et al. 2002).
#include <cstdint>
#include <span>
#include <vector>

#include "sculpt/base/types.hpp"
#include "sculpt/base/vec3.hpp"
#include "sculpt/par/comm.hpp"

namespace sculpt {

enum class PartitionMethod {
  kRcb,    // recursive coordinate bisection
  kRib,    // recursive inertial bisection
  kHsfc,   // Hilbert space-filling curve
  kGraph,  // few neighbours apart
};

// The objects that a rank has now, maybe none. Every id is on one rank.
struct PartitionObjects {
  std::span<const GlobalId> id;
  std::span<const Vec3> point;
  // kGraph only: neighbours of object i are first[i] .. first[i+1]-1, with the ranks that have them now.
  // Symmetric.
  std::span<const std::int64_t> first;
  std::span<const GlobalId> neighbour;
  std::span<const std::int32_t> neighbour_rank;
};

// Collective. The new rank of each object of this rank. Which one that is depends on the number of ranks and
// on who has what.
[[nodiscard]] std::vector<std::int32_t> partition(const Comm& comm, PartitionMethod method,
                                                  const PartitionObjects& objects);

}  // namespace sculpt
