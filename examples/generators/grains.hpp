#pragma once
// Polycrystals: a Laguerre tessellation of random seeds in a gently warped space, roughened by a few Potts
// sweeps.
#include "voxels.hpp"

namespace microstructure {

struct GrainOptions {
  Counts n{0, 0, 0};
  std::int64_t grains = 0;
  std::uint64_t seed = 1;
  std::int64_t warp = 24;  // largest shift of a point, in sixteenths of a voxel
  int sweeps = 4;          // of the Potts model at kT = 0.7, 26 neighbours: roughness of the grain boundaries
};

// Ids 1 .. grains.
[[nodiscard]] Voxels make_grains(const GrainOptions& options);

}  // namespace microstructure
