#include "sculpt/facets/faceted_solid.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sculpt/base/lot.hpp"
#include "support/surfaces.hpp"

namespace sculpt::test {
namespace {

double chance(std::int64_t item) { return static_cast<double>(lot_of(item) >> 11) / 9007199254740992.0; }
Vec3 random_point(std::int64_t item, double size) {
  return {size * (2 * chance(3 * item) - 1), size * (2 * chance(3 * item + 1) - 1),
          size * (2 * chance(3 * item + 2) - 1)};
}

// Not convex, without symmetry.
Facets potato(int slices) {
  return ball_facets(slices, [](const Vec3& w) {
    return 1 + 0.3 * std::sin(3 * w.x + 1) * std::cos(4 * w.y) + 0.2 * std::sin(5 * w.z + w.x);
  });
}

double length_of(const ChordRow& row, std::size_t line) {
  double sum = 0;
  for (std::size_t l = 0; l < row.layers(); ++l) sum += std::max(0.0, row.hi(l)[line] - row.lo(l)[line]);
  return sum;
}

// Lengths along lines through a box against those of many points on the lines.
void expect_chords(const Facets& facets, const Box& box, std::size_t axis) {
  const FacetedSolid solid(mesh_of(facets));
  std::unique_ptr<Shape> storage;
  const Shape& patch = solid.within(box, storage);
  const std::size_t axis_u = (axis + 1) % 3, axis_v = (axis + 2) % 3;
  const double u = box.lo[axis_u] + 0.3 * (box.hi[axis_u] - box.lo[axis_u]);
  std::vector<double> v;
  for (const double s : {0.1, 0.45, 0.9}) v.push_back(box.lo[axis_v] + s * (box.hi[axis_v] - box.lo[axis_v]));
  ChordRow row;
  row.begin(v.size());
  patch.chords(axis, u, v, row);
  std::vector<Vec3> from, step;
  for (const double at_v : v) {
    Vec3 p;
    p[axis] = box.lo[axis];
    p[axis_u] = u;
    p[axis_v] = at_v;
    from.push_back(p);
    step.emplace_back();
    step.back()[axis] = box.hi[axis] - box.lo[axis];
  }
  ChordRow lines;
  lines.begin(v.size());
  patch.line_chords(from, step, lines);
  constexpr int kPoints = 400;
  for (std::size_t l = 0; l < v.size(); ++l) {
    int inside = 0;
    for (int i = 0; i < kPoints; ++i)
      inside += winding_by_angles(facets, from[l] + ((i + 0.5) / kPoints) * step[l]) > 0.5;
    EXPECT_NEAR(length_of(row, l) / step[l][axis], inside / double{kPoints}, 3.0 / kPoints);
    EXPECT_NEAR(length_of(lines, l), length_of(row, l) / step[l][axis], 1e-9);
  }
}

TEST(FacetedSolid, CutsLinesOfAnyBox) {
  const Facets facets = potato(24);
  for (std::int64_t i = 0; i < 12; ++i) {
    const Vec3 centre = random_point(i, 0.9);
    const double half = 0.05 + 0.4 * chance(100 + i);
    expect_chords(facets, {centre - Vec3{half, half, half}, centre + Vec3{half, half, half}},
                  static_cast<std::size_t>(i % 3));
  }
}

TEST(FacetedSolid, OverlapsCountOnce) {
  const Facets two = potato(12) + moved(potato(14), {0.6, 0.1, 0});
  for (std::size_t axis = 0; axis < 3; ++axis) expect_chords(two, {{-0.4, -0.5, -0.6}, {1, 0.7, 0.8}}, axis);
}

TEST(FacetedSolid, KnowsItsInsideFromItsOutside) {
  const Facets facets =
      potato(24) + turned(moved(ball_facets(16, [](const Vec3&) { return 0.3; }), {0.1, 0, 0}));
  const FacetedSolid solid(mesh_of(facets));
  int inside = 0, outside = 0;
  for (std::int64_t i = 0; i < 400; ++i) {
    const Vec3 p = random_point(i, 1.5), half{0.03, 0.05, 0.04};
    const Box box{p - half, p + half};
    const bool is_inside = winding_by_angles(facets, p) > 0.5;
    if (solid.contains(box)) {
      EXPECT_TRUE(is_inside);
      ++inside;
    } else if (solid.misses(box)) {
      EXPECT_FALSE(is_inside);
      ++outside;
    } else {
      EXPECT_LT(norm(*solid.nearest_on_surface(p) - p), 1.01 * norm(half)) << "the surface is near";
    }
  }
  EXPECT_GT(inside, 30);
  EXPECT_GT(outside, 100);
}

TEST(FacetedSolid, FindsTheNearestPoint) {
  const Facets facets = potato(40);
  const FacetedSolid solid(mesh_of(facets));
  for (std::int64_t i = 0; i < 50; ++i) {
    const Vec3 p = random_point(i, 1.5);
    const Vec3 q = *solid.nearest_on_surface(p);
    double least = 1e9;  // of points spread over the facets
    for (const auto& f : facets)
      for (int a = 0; a <= 6; ++a)
        for (int b = 0; a + b <= 6; ++b)
          least = std::min(least, norm(f[0] + (a / 6.0) * (f[1] - f[0]) + (b / 6.0) * (f[2] - f[0]) - p));
    EXPECT_LE(norm(q - p), least + 1e-12);
    EXPECT_GE(norm(q - p), least - 0.02);
  }
}

// Faces of the solid in the faces of boxes: no corner, edge or diagonal may confuse it.
TEST(FacetedSolid, MeetsBoxesExactly) {
  const FacetedSolid cube(mesh_of(box_facets({0, 0, 0}, {1, 1, 1})));
  std::unique_ptr<Shape> storage;
  for (int i = -1; i < 3; ++i)
    for (int j = -1; j < 3; ++j)
      for (int k = -1; k < 3; ++k) {
        const Box box{{0.5 * i, 0.5 * j, 0.5 * k}, {0.5 * i + 0.5, 0.5 * j + 0.5, 0.5 * k + 0.5}};
        const bool inside = i >= 0 && i < 2 && j >= 0 && j < 2 && k >= 0 && k < 2;
        EXPECT_EQ(cube.contains(box), inside);
        EXPECT_EQ(cube.misses(box), !inside);
      }
  const Shape& patch = cube.within({{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}, storage);
  ChordRow row;
  row.begin(3);
  patch.chords(2, 0.25, std::vector<double>{-0.25, 0.25, 0.5}, row);
  EXPECT_EQ(length_of(row, 0), 0);
  EXPECT_EQ(length_of(row, 1), 0.5);
  EXPECT_EQ(length_of(row, 2), 0.5);
}

TEST(FacetedSolid, AHoleSpoilsOnlyItsSurroundings) {
  Facets facets = potato(48);
  const Vec3 hole = facets[500][0];
  facets.erase(facets.begin() + 500);
  const FacetedSolid leaky(mesh_of(facets)), tight(mesh_of(potato(48)));
  for (std::int64_t i = 0; i < 2000; ++i) {
    const Vec3 p = random_point(i, 1.4), half{0.02, 0.02, 0.02};
    const Box box{p - half, p + half};
    if (norm(p - hole) < 0.3) continue;
    EXPECT_EQ(leaky.contains(box), tight.contains(box));
    EXPECT_EQ(leaky.misses(box), tight.misses(box));
  }
}

TEST(FacetedSolid, IsGentleWhereItTurnsLittle) {
  const FacetedSolid ball(mesh_of(ball_facets(64, [](const Vec3&) { return 1.0; })));
  const FacetedSolid cube(mesh_of(box_facets({-1, -1, -1}, {1, 1, 1})));
  EXPECT_TRUE(ball.is_gentle({{0.9, -0.1, 0.1}, {1.1, 0.1, 0.2}}));
  EXPECT_FALSE(ball.is_gentle({{0.5, -0.5, -0.5}, {1.5, 0.5, 0.5}}));
  EXPECT_TRUE(cube.is_gentle({{0.9, 0, 0}, {1.1, 0.1, 0.1}}));
  EXPECT_TRUE(cube.has_edges({{0.9, 0.9, 0}, {1.1, 1.1, 0.1}}));
  EXPECT_EQ(cube.steepest_axis({0.1, 0.9, 0.2}), 1U);
}

TEST(FacetedSolid, KnowsSharesExactlyButOfOverlaps) {
  const Box box{{-0.4, -0.3, -0.2}, {0.4, 0.5, 0.4}};
  const Facets hollow =
      box_facets({-1, -1, -1}, {0.1, 0.2, 0.3}) + turned(box_facets({-0.3, -0.1, -0.1}, {-0.2, 0.1, 0.2}));
  std::unique_ptr<Shape> storage;
  EXPECT_NEAR(FacetedSolid(mesh_of(hollow)).within(box, storage).share_of(box).value(),
              (0.5 * 0.5 * 0.5 - 0.1 * 0.2 * 0.3) / (0.8 * 0.8 * 0.6), 1e-13);
  const Facets overlapping = hollow + box_facets({0, 0, 0}, {1, 1, 1});
  EXPECT_FALSE(FacetedSolid(mesh_of(overlapping)).within(box, storage).share_of(box).has_value());
  // An octahedron about a corner of the box: an eighth of it lies in the box.
  const Facets octahedron = ball_facets(4, [](const Vec3&) { return 0.7; });
  const Box octant{{0, 0, 0}, {1, 2, 3}};
  EXPECT_NEAR(FacetedSolid(mesh_of(octahedron)).within(octant, storage).share_of(octant).value(),
              0.7 * 0.7 * 0.7 / 6 / 6, 1e-13);
}

// A part answers like the whole within its region, even where the surface leaks.
TEST(FacetedSolid, PartsAnswerLikeTheWhole) {
  Facets facets = potato(40);
  facets.erase(facets.begin() + 300, facets.begin() + 310);
  const FacetedSolid whole(mesh_of(facets));
  const Box region{{-0.2, 0.1, -0.5}, {0.9, 1.3, 0.4}};
  FacetedSolid part(whole.bounds());
  const std::vector<char> bytes = whole.part(region);
  part.become(bytes);
  EXPECT_LT(bytes.size(), whole.part(whole.bounds()).size());
  for (std::int64_t i = 0; i < 3000; ++i) {
    const Vec3 half{0.02, 0.02, 0.02};
    const Vec3 p =
        region.lo + half +
        scaled({chance(5 * i), chance(5 * i + 1), chance(5 * i + 2)}, region.hi - region.lo - 2.0 * half);
    const Box box{p - half, p + half};
    ASSERT_EQ(part.contains(box), whole.contains(box));
    ASSERT_EQ(part.misses(box), whole.misses(box));
  }
}

}  // namespace
}  // namespace sculpt::test
