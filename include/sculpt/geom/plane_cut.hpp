#pragma once
// A plane through a cube. Pure.
#include "sculpt/base/vec3.hpp"

namespace sculpt {

// Signed distance, from the centre of a unit cube along a unit normal, of the plane that has the part `share`
// of the cube's volume behind it.
[[nodiscard]] double plane_offset(double share, const Vec3& normal);

}  // namespace sculpt
