#pragma once
// What the makers of solids check, and the frames that they place solids in. All throw Error, whose text
// names `what` they looked at.
#include <string_view>

#include "sculpt/geom/solids.hpp"

namespace sculpt {

void expect_finite(std::string_view what, const Vec3& v);
// Finite and more than 0.
void expect_positive(std::string_view what, double value);

// Unlike unit(), exact along the axes.
[[nodiscard]] Vec3 direction_of(const Vec3& v);
// With the origin at end1 and axis[2] towards end2; the ends must differ.
[[nodiscard]] Frame frame_between(std::string_view what, const Vec3& end1, const Vec3& end2);
// The same, with axis[0] along u_axis as far as that is across.
[[nodiscard]] Frame frame_between(std::string_view what, const Vec3& end1, const Vec3& end2,
                                  const Vec3& u_axis);

}  // namespace sculpt
