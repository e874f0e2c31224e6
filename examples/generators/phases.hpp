#pragma once
// Two interwoven phases, as of a decomposing mixture.
#include "voxels.hpp"

namespace microstructure {

// A smoothed random field, periodic, cut at its median: ids 1 and 2, half of the voxels each.
[[nodiscard]] Voxels make_two_phases(const Counts& n, std::int64_t radius, std::uint64_t seed);

}  // namespace microstructure
