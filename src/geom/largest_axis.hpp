#pragma once
// Along which axis a direction leads most.
#include <cmath>
#include <cstddef>

#include "sculpt/base/vec3.hpp"

namespace sculpt {

// The axis of the component of largest size; the lowest one of equals.
inline std::size_t largest_axis(const Vec3& v) {
  std::size_t axis = 0;
  for (std::size_t d = 1; d < 3; ++d)
    if (std::fabs(v[d]) > std::fabs(v[axis])) axis = d;
  return axis;
}

}  // namespace sculpt
