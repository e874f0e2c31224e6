#pragma once
// The local shape of a surface mesh around one of its nodes: a quadric over the tangent plane (the report,
// equations 2.21 to 2.24, with the matrix of the weighted normal equations). Pure.
#include <array>
#include <span>

#include "sculpt/base/vec3.hpp"

namespace sculpt {

// w = a[0] u + a[1] v + a[2] u^2 + a[3] uv + a[4] v^2 in the frame (t1, t2, normal) at the origin.
struct Quadric {
  Vec3 origin, t1, t2, normal;
  std::array<double, 5> a{0, 0, 0, 0, 0};
  double reach = 0;  // mean distance of the nodes around: no point farther away is asked for
};

// Through p, fitted to the points around it, which weigh by their inverse distance. normal: unit vector. Too
// few points or points in a degenerate position give less curvature, at worst the plane.
[[nodiscard]] Quadric fit_quadric(const Vec3& p, const Vec3& normal, std::span<const Vec3> around);

// The point of the quadric above or below p. Farther than `reach` along the tangent plane, or half of it
// across, p counts as being at that distance.
[[nodiscard]] Vec3 onto_quadric(const Quadric& quadric, const Vec3& p);

}  // namespace sculpt
