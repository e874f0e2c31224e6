#pragma once
// Thermal spray deposits: flat splats of two materials, rained on a growing surface. Where a splat bridges a
// valley, and along the seams of splats, pores stay open.
#include "voxels.hpp"

namespace microstructure {

// Ids: 1 pores (5 to 8 % of the volume), 2 and 3 the splats (2 : 1 by number). z is the direction of growth;
// x and y are periodic.
[[nodiscard]] Voxels make_spray(const Counts& n, std::uint64_t seed);

}  // namespace microstructure
