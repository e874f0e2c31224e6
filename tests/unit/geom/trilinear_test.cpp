#include "sculpt/geom/trilinear.hpp"

#include <gtest/gtest.h>

#include "sculpt/geom/sphere.hpp"

namespace sculpt {
namespace {

const HexCorners kWarped{{{0, 0, 0},
                          {1.1, 0.1, 0},
                          {1, 1.2, 0.1},
                          {-0.1, 1, 0},
                          {0.1, 0, 1},
                          {1, -0.1, 1.1},
                          {1.2, 1, 0.9},
                          {0, 1.1, 1.2}}};

TEST(HexLines, GoFromSideToSideThroughTheHex) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const HexLines lines(kWarped, axis);
    for (std::size_t c = 0; c < 8; ++c) {
      const auto& bit = kCornerOffset[c];
      const auto line = lines.at(bit[(axis + 1) % 3], bit[(axis + 2) % 3]);
      const Vec3 end = line.from + static_cast<double>(bit[axis]) * line.step;
      EXPECT_LT(norm(end - kWarped[c]), 1e-15);
      const double jacobian = bit[axis] != 0 ? line.a + line.b + line.c : line.a;
      EXPECT_NEAR(jacobian, corner_determinant(kWarped, static_cast<int>(c)), 1e-14);
    }
  }
}

// Simpson's rule is exact for the cubic volumes along lines.
TEST(HexLines, HoldTheVolumeOfTheHex) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const HexLines lines(kWarped, axis);
    double volume = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        volume += (i == 1 ? 4 : 1) * (j == 1 ? 4 : 1) * lines.at(0.5 * i, 0.5 * j).volume(1) / 36;
    EXPECT_NEAR(volume, hex_volume(kWarped), 1e-14);
    EXPECT_EQ(lines.at(0.3, 0.4).volume(0), 0);
  }
}

HexCorners box(const Vec3& lo, const Vec3& hi) {
  HexCorners p;
  for (std::size_t c = 0; c < 8; ++c)
    for (std::size_t d = 0; d < 3; ++d) p[c][d] = kCornerOffset[c][d] != 0 ? hi[d] : lo[d];
  return p;
}

TEST(IsBox, WhicheverCornerComesFirst) {
  const HexCorners p = box({0, 1, 2}, {0.1, 3, 5});
  const auto is = [](const HexCorners& q, double tolerance) {
    return is_box(q, bounds_of(q), {tolerance, tolerance, tolerance});
  };
  EXPECT_TRUE(is(p, 0));
  EXPECT_TRUE(is({p[1], p[2], p[3], p[0], p[5], p[6], p[7], p[4]}, 0));
  EXPECT_TRUE(is({p[0], p[3], p[7], p[4], p[1], p[2], p[6], p[5]}, 0));
  EXPECT_FALSE(is({p[2], p[1], p[0], p[3], p[5], p[6], p[7], p[4]}, 0));  // corners in a wrong order
  EXPECT_FALSE(is({p[0], p[1], p[2], p[3], p[0], p[1], p[2], p[3]}, 0));  // flat
  HexCorners q = p;
  q[6].x += 1e-9;
  EXPECT_FALSE(is(q, 0));
  EXPECT_TRUE(is(q, 1e-8));
  EXPECT_FALSE(is(kWarped, 1e-2));
}

TEST(Sphere, CutsAnyLine) {
  const Sphere ball({1, 2, 3}, 2);
  const std::vector<Vec3> from{{1, 2, 3}, {-3, 2, 3}, {1, 5, 3}, {1, 2, 3}, {2, 3, 3}},
      step{{0, 0, 4}, {2, 0, 0}, {1, 0, 0}, {0, 0, 0}, {-1, -1, 0}};
  ChordRow row;
  row.begin(5);
  ball.line_chords(from, step, row);
  ASSERT_EQ(row.layers(), 1U);
  const double *const lo = row.lo(0), *const hi = row.hi(0);
  EXPECT_DOUBLE_EQ(lo[0], -0.5);
  EXPECT_DOUBLE_EQ(hi[0], 0.5);
  EXPECT_DOUBLE_EQ(lo[1], 1);
  EXPECT_DOUBLE_EQ(hi[1], 3);
  EXPECT_GE(lo[2], hi[2]);
  EXPECT_GE(lo[3], hi[3]);
  EXPECT_DOUBLE_EQ(lo[4], 1 - std::sqrt(2));
  EXPECT_DOUBLE_EQ(hi[4], 1 + std::sqrt(2));
}

}  // namespace
}  // namespace sculpt
