#pragma once
// Smooth random fields.
#include "random.hpp"
#include "voxels.hpp"

namespace microstructure {

// White noise, blurred three times by a box of 2 radius + 1 voxels per axis (nearly a Gaussian), periodic.
// The sums are kept whole, so their unit is arbitrary; radius at most 20 keeps them in range.
[[nodiscard]] Box<std::int64_t> smooth_noise(const Counts& n, std::int64_t radius, Random& random);

// The same, scaled to -amplitude .. amplitude.
[[nodiscard]] Box<std::int64_t> smooth_noise(const Counts& n, std::int64_t radius, std::int64_t amplitude,
                                             Random& random);

}  // namespace microstructure
