#include "sculpt/geom/sphere.hpp"

#include <gtest/gtest.h>

#include <array>

namespace sculpt {
namespace {

const Sphere kBall({1, 2, 3}, 5);

TEST(Sphere, Bounds) {
  EXPECT_EQ(kBall.bounds().lo, (Vec3{-4, -3, -2}));
  EXPECT_EQ(kBall.bounds().hi, (Vec3{6, 7, 8}));
}

TEST(Sphere, ContainsBoxesWhoseFarthestCornerIsInside) {
  EXPECT_TRUE(kBall.contains({{1, 2, 3}, {3.8, 4.8, 5.8}}));     // farthest corner at 2.8 sqrt(3) = 4.85
  EXPECT_FALSE(kBall.contains({{1, 2, 3}, {3.95, 4.95, 5.9}}));  // at 5.08
  EXPECT_FALSE(kBall.contains({{-9, -9, -9}, {9, 9, 9}}));
}

TEST(Sphere, MissesBoxesWhoseNearestPointIsOutside) {
  EXPECT_TRUE(kBall.misses({{7, 2, 3}, {9, 3, 4}}));
  EXPECT_TRUE(kBall.misses({{4, 5, 6}, {9, 9, 9}}));  // nearest corner at 3 sqrt(3) = 5.2
  EXPECT_FALSE(kBall.misses({{3.8, 4.8, 5.8}, {9, 9, 9}}));
  EXPECT_FALSE(kBall.misses({{0, 0, 0}, {1, 1, 1}}));
}

TEST(Sphere, ChordsAlongEveryAxis) {
  // A line at distance 3 from the centre has a chord of half length 4, one at 6 has none.
  const Vec3 centre{1, 2, 3};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const std::array<double, 3> across{centre[v] + 3, centre[v] + 6, centre[v]};
    ChordRow row;
    row.begin(3);
    kBall.chords(axis, centre[u], across, row);
    const auto [lo, hi] = row.layer(0);
    EXPECT_NEAR(lo[0], centre[axis] - 4, 1e-14);
    EXPECT_NEAR(hi[0], centre[axis] + 4, 1e-14);
    EXPECT_GE(lo[1], hi[1]);
    EXPECT_NEAR(hi[2] - lo[2], 10, 1e-14);
    row.begin(3);
    kBall.chords(axis, centre[u] + 4, across, row);
    EXPECT_NEAR(hi[0] - lo[0], 0, 1e-7);
    EXPECT_NEAR(hi[2] - lo[2], 6, 1e-14);
  }
}

TEST(Sphere, SteepestAxisIsThatOfTheNormal) {
  EXPECT_EQ(kBall.steepest_axis({6, 2, 3}), 0U);
  EXPECT_EQ(kBall.steepest_axis({1, -3, 3}), 1U);
  EXPECT_EQ(kBall.steepest_axis({2, 3, 8}), 2U);
  EXPECT_EQ(kBall.steepest_axis({4, 5, 6}), 0U) << "the lowest of equals";
}

TEST(Sphere, NearestPointOfTheSurface) {
  const Sphere ball({1, 2, 3}, 2);
  EXPECT_EQ(ball.nearest_on_surface({1, 2, 3.5}), (Vec3{1, 2, 5}));
  EXPECT_EQ(ball.nearest_on_surface({11, 2, 3}), (Vec3{3, 2, 3}));
  EXPECT_FALSE(ball.nearest_on_surface({1, 2, 3}).has_value());
}

}  // namespace
}  // namespace sculpt
