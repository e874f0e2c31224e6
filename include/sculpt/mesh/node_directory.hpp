#pragma once
// Positions of nodes that other ranks hold.
#include <span>
#include <vector>

#include "sculpt/mesh/element_share.hpp"
#include "sculpt/par/comm.hpp"

namespace sculpt {

// Collective. The position of each of these nodes (numbers, in any order, also repeated), whichever rank
// holds it. Throws AgreedError when a node is held by nobody.
[[nodiscard]] std::vector<Vec3> positions_of(const Comm& comm, const ElementShare& share,
                                             std::span<const GlobalId> nodes);

}  // namespace sculpt
