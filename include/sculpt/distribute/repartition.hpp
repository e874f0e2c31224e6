#pragma once
// Elements of an unstructured mesh move to the ranks that a partition gives them.
#include "sculpt/mesh/element_share.hpp"
#include "sculpt/par/partition.hpp"

namespace sculpt {

// Collective. Partitions the elements by their centres, or for kGraph by the faces that they share, and moves
// them with their blocks and values; nodes stay where they are. Throws AgreedError when a node has no
// coordinates or the partitioner fails.
void repartition(const Comm& comm, ElementShare& share, PartitionMethod method);

// Collective. Moves each element of this rank to the rank that `to` names.
void move_elements(const Comm& comm, ElementShare& share, std::span<const std::int32_t> to);

}  // namespace sculpt
