#pragma once
// The directions in which a geometry extends, for the option align.
#include <array>
#include <functional>

#include "sculpt/geom/shape.hpp"

namespace sculpt {

// Local. Unit vectors at right angles, right-handed: the principal axes of inertia of what is inside, in the
// order and with the signs that turn the coordinate axes least. Where two moments agree within 1 % only the
// third axis counts, where all three do the coordinate axes come back, as they do when nothing is inside. The
// inside is asked for at 96^3 points of the bounds.
[[nodiscard]] std::array<Vec3, 3> principal_axes(const Box& bounds,
                                                 const std::function<bool(const Vec3&)>& inside);

}  // namespace sculpt
