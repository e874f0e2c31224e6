#include "input/principal_axes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sculpt {
namespace {

using Axes = std::array<Vec3, 3>;

Axes turned(double about_z, double about_x) {
  const double ca = std::cos(about_z), sa = std::sin(about_z), cb = std::cos(about_x), sb = std::sin(about_x);
  return {{{ca, cb * sa, sb * sa}, {-sa, cb * ca, sb * ca}, {0, -sb, cb}}};
}
Axes axes_of_box(const Axes& axes, const Vec3& half) {
  const Box bounds{{-4, -4, -4}, {4, 4, 4}};
  return principal_axes(bounds, [&](const Vec3& p) {
    for (std::size_t d = 0; d < 3; ++d)
      if (std::fabs(dot(p, axes[d])) > half[d]) return false;
    return true;
  });
}

void expect_near(const Axes& a, const Axes& b) {
  for (std::size_t d = 0; d < 3; ++d) EXPECT_LT(norm(a[d] - b[d]), 0.02) << "axis " << d;
}

TEST(PrincipalAxes, AreThoseOfATurnedBox) {
  for (const auto& [z, x] : {std::pair{0.3, 0.2}, std::pair{-0.5, 0.4}, std::pair{0.0, -0.6}})
    expect_near(axes_of_box(turned(z, x), {3, 2, 1}), turned(z, x));
}

TEST(PrincipalAxes, AreTakenInTheOrderThatTurnsLeast) {
  const Axes a = turned(0.3, 0.2);
  expect_near(axes_of_box({a[1], a[2], a[0]}, {3, 2, 1}), a);
}

TEST(PrincipalAxes, FollowTheOneAxisOfARod) {
  const Axes a = turned(0.4, -0.3);
  const Axes found = axes_of_box(a, {1, 1, 3});
  EXPECT_LT(norm(found[2] - a[2]), 0.02);
  for (std::size_t d = 0; d < 3; ++d) {
    EXPECT_NEAR(norm(found[d]), 1, 1e-12);
    EXPECT_NEAR(dot(found[d], found[(d + 1) % 3]), 0, 1e-12);
  }
  EXPECT_NEAR(dot(cross(found[0], found[1]), found[2]), 1, 1e-12);
}

TEST(PrincipalAxes, StayWhereNoDirectionStandsOut) {
  const Axes coordinates{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const Box bounds{{-1, -1, -1}, {1, 1, 1}};
  EXPECT_EQ(principal_axes(bounds, [](const Vec3& p) { return norm(p) < 0.9; }), coordinates);
  EXPECT_EQ(principal_axes(bounds, [](const Vec3&) { return false; }), coordinates);
}

}  // namespace
}  // namespace sculpt
