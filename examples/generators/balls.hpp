#pragma once
// Balls of voxels in a matrix.
#include "voxels.hpp"

namespace microstructure {

struct BallOptions {
  Counts n{0, 0, 0};
  std::int64_t count = 0;
  std::uint64_t seed = 1;
};

// Ids 1 (matrix) and 2 (balls). The balls do not touch each other and reach out of the box in places;
// together they fill a fifth to a third of it. Throws where there is no room for so many in so small a box.
[[nodiscard]] Voxels make_balls(const BallOptions& options);

}  // namespace microstructure
