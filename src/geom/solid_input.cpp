#include "geom/solid_input.hpp"

#include <fmt/format.h>

#include <cmath>

#include "sculpt/base/error.hpp"

namespace sculpt {
namespace {

constexpr double kTolerance = 1e-12;  // relative

std::string text(const Vec3& v) { return fmt::format("({} {} {})", v.x, v.y, v.z); }

Vec3 axis_between(std::string_view what, const Vec3& end1, const Vec3& end2) {
  expect_finite(what, end1);
  expect_finite(what, end2);
  const Vec3 axis = end2 - end1;
  if (!(norm(axis) > kTolerance * std::fmax(largest(end1), largest(end2))))
    throw Error(fmt::format("{}: both ends of its axis are {}, expected different points", what, text(end1)));
  return direction_of(axis);
}

}  // namespace

void expect_finite(std::string_view what, const Vec3& v) {
  if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
    throw Error(fmt::format("{}: {}, expected finite numbers", what, text(v)));
}

void expect_positive(std::string_view what, double value) {
  if (!(value > 0) || !std::isfinite(value))
    throw Error(fmt::format("{} is {}, expected a number above 0", what, value));
}

Vec3 direction_of(const Vec3& v) {
  const double length = norm(v);
  return {v.x / length, v.y / length, v.z / length};
}

Frame frame_between(std::string_view what, const Vec3& end1, const Vec3& end2) {
  const Vec3 axis = axis_between(what, end1, end2);
  std::size_t across = 0;
  for (std::size_t d = 1; d < 3; ++d)
    if (std::fabs(axis[d]) < std::fabs(axis[across])) across = d;
  Vec3 u_axis;
  u_axis[across] = 1;
  return frame_between(what, end1, end2, u_axis);
}

Frame frame_between(std::string_view what, const Vec3& end1, const Vec3& end2, const Vec3& u_axis) {
  const Vec3 axis = axis_between(what, end1, end2);
  expect_finite(what, u_axis);
  const Vec3 across = u_axis - dot(u_axis, axis) * axis;
  if (!(norm(across) > kTolerance * norm(u_axis)))
    throw Error(fmt::format("{}: the direction of u is {}, expected one that is not along the axis {}", what,
                            text(u_axis), text(axis)));
  const Vec3 u = direction_of(across);
  return {end1, {u, cross(axis, u), axis}};
}

}  // namespace sculpt
