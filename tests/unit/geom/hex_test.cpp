#include "sculpt/geom/hex.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace sculpt {
namespace {

HexCorners unit_cube() {
  HexCorners p;
  for (std::size_t c = 0; c < 8; ++c)
    p[c] = {static_cast<double>(kCornerOffset[c][0]), static_cast<double>(kCornerOffset[c][1]),
            static_cast<double>(kCornerOffset[c][2])};
  return p;
}

// Rows of the matrix are the images of the unit vectors.
HexCorners mapped(const std::array<Vec3, 3>& axes, const Vec3& shift = {}) {
  HexCorners p = unit_cube();
  for (Vec3& x : p) x = shift + x.x * axes[0] + x.y * axes[1] + x.z * axes[2];
  return p;
}

Vec3 random_point(std::mt19937& random) {
  std::uniform_real_distribution<double> u(-1, 1);
  const double x = u(random), y = u(random);
  return {x, y, u(random)};
}

// Jacobian at a point of the reference cube, straight from the shape functions.
double jacobian(const HexCorners& p, const Vec3& at) {
  std::array<Vec3, 3> d{};
  for (std::size_t c = 0; c < 8; ++c) {
    std::array<double, 3> n, dn;
    for (std::size_t a = 0; a < 3; ++a) {
      n[a] = kCornerOffset[c][a] ? at[a] : 1 - at[a];
      dn[a] = kCornerOffset[c][a] ? 1 : -1;
    }
    d[0] += (dn[0] * n[1] * n[2]) * p[c];
    d[1] += (n[0] * dn[1] * n[2]) * p[c];
    d[2] += (n[0] * n[1] * dn[2]) * p[c];
  }
  return dot(d[0], cross(d[1], d[2]));
}

double least_sampled_jacobian(const HexCorners& p, int n) {
  double least = 1e300;
  for (int s = 0; s < (n + 1) * (n + 1) * (n + 1); ++s)
    least = std::min(least, jacobian(p, (1.0 / n) * Vec3{double(s % (n + 1)), double(s / (n + 1) % (n + 1)),
                                                         double(s / (n + 1) / (n + 1))}));
  return least;
}

TEST(HexTables, CornerNeighboursAreRightHandedEdges) {
  for (std::size_t c = 0; c < 8; ++c) {
    for (const int n : kCornerNeighbours[c]) {
      int differences = 0;
      for (std::size_t a = 0; a < 3; ++a)
        differences += kCornerOffset[c][a] != kCornerOffset[static_cast<std::size_t>(n)][a];
      EXPECT_EQ(differences, 1) << "corners " << c << " and " << n;
    }
    EXPECT_EQ(corner_determinant(unit_cube(), static_cast<int>(c)), 1);
  }
}

TEST(HexTables, FacesLookOutwardsAlongTheirAxis) {
  const HexCorners p = unit_cube();
  std::set<std::set<int>> all;
  for (std::size_t f = 0; f < 6; ++f) {
    const auto& v = kFaces[f];
    all.insert(std::set<int>(v.begin(), v.end()));
    Vec3 outward;
    outward[static_cast<std::size_t>(kFaceAxis[f])] = kFaceSign[f];
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3 &a = p[static_cast<std::size_t>(v[i])], &b = p[static_cast<std::size_t>(v[(i + 1) % 4])],
                 &c = p[static_cast<std::size_t>(v[(i + 2) % 4])];
      EXPECT_EQ(cross(b - a, c - b), outward) << "face " << f;
      EXPECT_EQ(a[static_cast<std::size_t>(kFaceAxis[f])], kFaceSign[f] > 0 ? 1 : 0);
    }
  }
  EXPECT_EQ(all.size(), 6U);
}

// Sides 1..6 of a HEX8 in the Exodus II manual.
TEST(HexTables, FacesAreTheSidesOfExodus) {
  const std::array<std::set<int>, 6> manual{
      {{1, 2, 6, 5}, {2, 3, 7, 6}, {3, 4, 8, 7}, {1, 5, 8, 4}, {1, 4, 3, 2}, {5, 6, 7, 8}}};
  for (std::size_t f = 0; f < 6; ++f)
    for (const int c : kFaces[f]) EXPECT_TRUE(manual[f].contains(c + 1)) << "side " << f + 1;
}

TEST(ScaledJacobian, OfBoxesIsOne) {
  EXPECT_EQ(scaled_jacobian(unit_cube()), 1);
  EXPECT_DOUBLE_EQ(scaled_jacobian(mapped({{{3, 0, 0}, {0, 0.01, 0}, {0, 0, 20}}}, {5, -7, 1e3})), 1);
}

TEST(ScaledJacobian, OfAParallelepipedIsTheSineOfItsAngle) {
  const double degrees = std::acos(-1.0) / 180;
  for (const double angle : {10.0, 30.0, 45.0, 89.0})
    EXPECT_NEAR(
        scaled_jacobian(mapped(
            {{{1, 0, 0}, {2 * std::cos(angle * degrees), 2 * std::sin(angle * degrees), 0}, {0, 0, 1}}})),
        std::sin(angle * degrees), 1e-14);
}

TEST(ScaledJacobian, IsTheWorstCorner) {
  HexCorners p = unit_cube();
  p[6] = {0.75, 0.75, 1};  // pulls corner 6 towards 4: the angle there grows beyond a right one
  const Vec3 a = p[5] - p[6], b = p[7] - p[6], c = p[2] - p[6];
  const double expected = dot(c, cross(b, a)) / (norm(a) * norm(b) * norm(c));
  EXPECT_NEAR(corner_scaled_jacobian(p, 6), std::fabs(expected), 1e-15);
  EXPECT_EQ(corner_scaled_jacobian(p, 0), 1);
  double worst = 2;
  for (int i = 0; i < 8; ++i) worst = std::min(worst, corner_scaled_jacobian(p, i));
  EXPECT_EQ(scaled_jacobian(p), worst);
  EXPECT_LT(worst, 0.9);
}

TEST(ScaledJacobian, OfAnInvertedHexIsNegative) {
  HexCorners mirrored = unit_cube();
  for (Vec3& x : mirrored) x.x = -x.x;
  EXPECT_EQ(scaled_jacobian(mirrored), -1);
  EXPECT_EQ(corner_determinant(mirrored, 3), -1);
  EXPECT_NEAR(hex_volume(mirrored), -1, 1e-15);
  EXPECT_FALSE(is_positive_inside(mirrored));
}

TEST(ScaledJacobian, OfAnEdgeWithoutLengthIsZero) {
  HexCorners p = unit_cube();
  p[1] = p[0];
  EXPECT_EQ(corner_scaled_jacobian(p, 0), 0);
  EXPECT_EQ(corner_scaled_jacobian(p, 1), 0);
  EXPECT_EQ(scaled_jacobian(p), 0);
  EXPECT_EQ(shortest_edge(p), 0);
  EXPECT_FALSE(is_positive_inside(p));
}

TEST(ScaledJacobian, DoesNotDependOnSize) {
  std::mt19937 random(1);
  HexCorners p = unit_cube();
  for (Vec3& x : p) x += 0.3 * random_point(random);
  HexCorners small = p, large = p;
  for (Vec3& x : small) x = 1e-9 * x;
  for (Vec3& x : large) x = 1e6 * x;
  EXPECT_NEAR(scaled_jacobian(small), scaled_jacobian(p), 1e-12);
  EXPECT_NEAR(scaled_jacobian(large), scaled_jacobian(p), 1e-12);
}

TEST(HexVolume, OfAnAffineImageIsItsDeterminant) {
  std::mt19937 random(7);
  for (int i = 0; i < 20; ++i) {
    const Vec3 a = random_point(random), b = random_point(random), c = random_point(random);
    EXPECT_NEAR(hex_volume(mapped({{a, b, c}}, {1, 2, 3})), dot(a, cross(b, c)), 1e-13);
  }
}

// A frustum: trilinear, not affine. Volume h/3 (A + B + sqrt(A B)).
TEST(HexVolume, OfAFrustum) {
  HexCorners p = unit_cube();
  for (std::size_t c = 4; c < 8; ++c) p[c] = {0.25 + 0.5 * p[c].x, 0.25 + 0.5 * p[c].y, 3};
  EXPECT_NEAR(hex_volume(p), 3.0 / 3 * (1 + 0.25 + 0.5), 1e-14);
}

TEST(HexVolume, AddsUpWhenAHexIsCut) {
  std::mt19937 random(3);
  HexCorners p = unit_cube(), low, high;
  for (Vec3& x : p) x += 0.3 * random_point(random);
  for (std::size_t c = 0; c < 4; ++c) {
    const Vec3 middle = 0.5 * (p[c] + p[c + 4]);
    low[c] = p[c];
    low[c + 4] = high[c] = middle;
    high[c + 4] = p[c + 4];
  }
  EXPECT_NEAR(hex_volume(low) + hex_volume(high), hex_volume(p), 1e-14);
}

TEST(PositiveInside, HoldsForGoodHexes) {
  EXPECT_TRUE(is_positive_inside(unit_cube(), 0));
  EXPECT_TRUE(is_positive_inside(mapped({{{1, 0, 0}, {0.9, 0.4, 0}, {0.2, 0.3, 0.5}}}), 0));
}

// Corners alone do not tell: all eight are positive, the hex folds on an edge or inside.
TEST(PositiveInside, FindsFoldsThatNoCornerShows) {
  std::mt19937 random(11);
  int folded = 0, subdivided = 0;
  for (int i = 0; i < 20000 && (folded < 10 || subdivided < 10); ++i) {
    HexCorners p = unit_cube();
    for (Vec3& x : p) x += 0.6 * random_point(random);
    double corner = 1;
    for (int c = 0; c < 8; ++c) corner = std::min(corner, corner_determinant(p, c));
    if (corner <= 0) continue;
    const double sampled = least_sampled_jacobian(p, 8);
    if (sampled < 0) {
      ++folded;
      EXPECT_FALSE(is_positive_inside(p)) << "a Jacobian of " << sampled << " at a sample";
    } else if (sampled > 0.05) {
      subdivided += !is_positive_inside(p, 0);  // the coefficients of the whole hex do not decide
      EXPECT_TRUE(is_positive_inside(p)) << "no sample below " << sampled;
    }
  }
  EXPECT_GE(folded, 10);
  EXPECT_GE(subdivided, 10);
}

TEST(PositiveInside, IsFalseForAFlatHex) {
  HexCorners p = unit_cube();
  for (Vec3& x : p) x.z = 0;
  EXPECT_FALSE(is_positive_inside(p));
}

TEST(ShortestEdge, LooksAtAllTwelve) {
  std::set<std::pair<int, int>> edges;
  for (int c = 0; c < 8; ++c)
    for (const int n : kCornerNeighbours[static_cast<std::size_t>(c)])
      edges.insert({std::min(c, n), std::max(c, n)});
  ASSERT_EQ(edges.size(), 12U);
  EXPECT_EQ(shortest_edge(mapped({{{3, 0, 0}, {0, 2, 0}, {0, 0, 0.5}}})), 0.5);
  for (const auto& [a, b] : edges) {
    HexCorners p = unit_cube();
    Vec3 &from = p[static_cast<std::size_t>(a)], to = p[static_cast<std::size_t>(b)];
    from += 0.75 * (to - from);
    EXPECT_EQ(shortest_edge(p), 0.25) << "edge " << a << " " << b;
  }
}

}  // namespace
}  // namespace sculpt
