#pragma once
// Where nodes are that other ranks may hold.
#include <span>
#include <vector>

#include "sculpt/mesh/element_share.hpp"
#include "sculpt/par/comm.hpp"

namespace sculpt {

// Collective. The positions of these nodes (numbers in any order, repetitions allowed; each rank asks for its
// own). Throws AgreedError that names the first node, from 1, which ranks hold in two places, or which was
// asked for and nobody holds.
[[nodiscard]] std::vector<Vec3> positions_of(const Comm& comm, const ElementShare& share,
                                             std::span<const GlobalId> nodes);

}  // namespace sculpt
