#include "phases.hpp"

#include <algorithm>

#include "noise.hpp"

namespace microstructure {

Voxels make_two_phases(const Counts& n, std::int64_t radius, std::uint64_t seed) {
  Random random(seed);
  const Box<std::int64_t> field = smooth_noise(n, radius, random);
  std::vector<std::int64_t> sorted = field.values;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  Voxels voxels(n);
  for (std::size_t v = 0; v < voxels.values.size(); ++v) voxels.values[v] = field.values[v] < *middle ? 1 : 2;
  return voxels;
}

}  // namespace microstructure
