#include "sculpt/contour/contour.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "contour/gradient.hpp"
#include "sculpt/geom/plane_cut.hpp"
#include "support/mesh_checks.hpp"
#include "support/stages.hpp"

namespace sculpt {
namespace {

struct Placed {
  HexMesh cells;
  Interfaces faces;
  std::vector<Crossing> crossings;
  std::vector<Vec3> before;
};

Placed placed(const test::Case& input) {
  test::Overlay o = test::filtered(input);
  Placed p{std::move(o.cells), {}, {}, {}};
  p.faces = trace_interfaces(p.cells, face_neighbours(p.cells));
  p.crossings = edge_crossings(p.cells, p.faces, o.fractions, NodeHexes(p.cells));
  p.before = p.cells.position;
  place_nodes(p.cells, p.faces, p.crossings);
  return p;
}

TEST(HermiteRoot, OfAStraightLineIsTheLinearOne) {
  EXPECT_NEAR(hermite_root(1, -1, -2, -2), 0.5, 1e-12);
  EXPECT_NEAR(hermite_root(0.9, -0.1, -1, -1), 0.9, 1e-11);
  EXPECT_NEAR(hermite_root(0.2, -0.6, -0.8, -0.8), 0.25, 1e-11);
}

TEST(HermiteRoot, EndsAndEqualValues) {
  EXPECT_EQ(hermite_root(0, 0, -1, -1), 0.5);
  EXPECT_NEAR(hermite_root(0, -1, -1, -1), 0, 1e-9);
  EXPECT_NEAR(hermite_root(1, 0, -1, -1), 1, 1e-9);
}

TEST(HermiteRoot, IsAZeroOfTheCubicInsideTheCell) {
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const double g0 = 0.05 + test::scatter_unit(1, i), g1 = -0.05 - test::scatter_unit(2, i);
    const double drop = g1 - g0, m0 = 3 * drop * test::scatter_unit(3, i),
                 m1 = 3 * drop * test::scatter_unit(4, i);
    const double t = hermite_root(g0, g1, m0, m1), t2 = t * t, t3 = t2 * t;
    EXPECT_GT(t, 0);
    EXPECT_LT(t, 1);
    const double g =
        (2 * t3 - 3 * t2 + 1) * g0 + (t3 - 2 * t2 + t) * m0 + (3 * t2 - 2 * t3) * g1 + (t3 - t2) * m1;
    EXPECT_NEAR(g, 0, 1e-6);
    EXPECT_NEAR(hermite_root(-g1, -g0, m1, m0), 1 - t, 1e-6) << "seen from the other end";
  }
}

TEST(HermiteRoot, LimitsSlopesThatWouldSwing) {
  const double t = hermite_root(1, -1, 50, 50);  // uphill: taken as flat
  EXPECT_NEAR(t, hermite_root(1, -1, 0, 0), 1e-12);
  EXPECT_NEAR(hermite_root(1, -1, -500, -6), hermite_root(1, -1, -6, -6), 1e-12);
}

TEST(PlaneOffset, IsTheInverseOfTheCutVolume) {
  for (const Vec3 direction : {Vec3{1, 2, 3}, Vec3{-3, 1, 0.5}, Vec3{2, -2.5, -1.7}, Vec3{0.1, 0.2, 1}}) {
    const Vec3 normal = unit(direction);
    for (const double offset : {-0.6, -0.3, -0.01, 0.0, 0.2, 0.45, 0.7}) {
      Fractions f;
      test::half_space({1, 1, 1}, normal, offset + dot(normal, {0.5, 0.5, 0.5})).fill({0, 0, 0}, f);
      if (f.material.size() < 2) continue;  // beyond the cube
      EXPECT_NEAR(plane_offset(f.value[0], normal), offset, 1e-6)
          << direction.x << " " << direction.y << " " << direction.z;
    }
  }
  EXPECT_NEAR(plane_offset(0.25, {0, 0, 1}), -0.25, 1e-3);
  EXPECT_NEAR(plane_offset(0.75, {-1, 0, 0}), 0.25, 1e-3);
}

// Fractions of material 1 that rise linearly from 0.5 in the middle of the grid.
test::Case ramp(const Index3& cells, const Vec3& slope) {
  test::Case input = test::voxels("ramp", cells, 2, [](const Index3&) { return 0; });
  input.fill = [=](const Index3& c, Fractions& f) {
    double one = 0.5;
    for (std::size_t d = 0; d < 3; ++d)
      one += slope[d] * (static_cast<double>(c[d]) + 0.5 - 0.5 * static_cast<double>(cells[d]));
    f.add(0, 1 - one);
    f.add(1, one);
  };
  return input;
}

TEST(Gradient, OfALinearFieldIsExactInside) {
  const Vec3 slope{0.03, -0.02, 0.05}, size{1, 0.5, 2};
  test::Case input = ramp({5, 5, 5}, scaled(slope, size));
  input.grid = uniform_grid({5, 5, 5}, {1, 2, 3}, size);
  const test::Overlay o = test::overlay(input);
  const NodeHexes around(o.cells);
  GradientStencil stencil(o.cells, o.fractions, around);
  for (const Index3 c : {Index3{2, 2, 2}, Index3{1, 3, 2}}) {
    const auto& entries = stencil.at(static_cast<LocalId>(whole({5, 5, 5}).position(c)));
    ASSERT_EQ(entries.size(), 2U);
    for (std::size_t d = 0; d < 3; ++d) {
      EXPECT_NEAR(entries[0].gradient[d], -slope[d], 1e-13);
      EXPECT_NEAR(entries[1].gradient[d], slope[d], 1e-13);
    }
  }
}

// Beside the box the cells across it are images of the outermost ones: half of the slope through the box is
// left.
TEST(Gradient, IsMirroredAtTheBox) {
  const Vec3 slope{0.08, -0.06, 0.04};
  const test::Case input = ramp({5, 5, 5}, slope);
  const test::Overlay o = test::overlay(input);
  const NodeHexes around(o.cells);
  GradientStencil stencil(o.cells, o.fractions, around);
  const auto& entries = stencil.at(static_cast<LocalId>(whole({5, 5, 5}).position({0, 2, 4})));
  ASSERT_EQ(entries.size(), 2U);
  EXPECT_NEAR(entries[1].gradient.x, slope.x / 2, 1e-13);
  EXPECT_NEAR(entries[1].gradient.y, slope.y, 1e-13);
  EXPECT_NEAR(entries[1].gradient.z, slope.z / 2, 1e-13);
}

TEST(Gradient, OfAThinGridStaysInThePlane) {
  const test::Case input = test::voxels({3, 3, 1}, {0, 0, 1, 0, 0, 1, 0, 0, 1});
  const test::Overlay o = test::overlay(input);
  const NodeHexes around(o.cells);
  GradientStencil stencil(o.cells, o.fractions, around);
  const auto& entries = stencil.at(4);
  ASSERT_EQ(entries.size(), 2U);
  EXPECT_GT(entries[1].gradient.x, 0.3);
  EXPECT_NEAR(entries[1].gradient.y, 0, 1e-13);
  EXPECT_EQ(entries[1].gradient.z, 0);
}

struct Distances {
  double mean = 0, worst = 0;
  int count = 0;
};

// From the plane through the nodes at least two cells away from the box.
Distances from_plane(const Placed& p, std::int64_t cells, const Vec3& normal, double distance) {
  Distances d;
  for (const LocalId n : p.faces.nodes) {
    const Vec3 grid = p.before[static_cast<std::size_t>(n)];
    bool inside = true;
    for (std::size_t a = 0; a < 3; ++a)
      inside = inside && grid[a] >= 2 && grid[a] <= static_cast<double>(cells - 2);
    if (!inside) continue;
    const double off = std::fabs(dot(normal, p.cells.position[static_cast<std::size_t>(n)]) - distance);
    d.worst = std::max(d.worst, off);
    d.mean += off;
    ++d.count;
  }
  d.mean /= d.count;
  return d;
}

// Where fractions change linearly the gradients are exact. (The fractions leave [0,1] far from the plane, or
// no field of such a slope would be linear; no cell centre comes close to the plane, where crossings are held
// off it.)
TEST(PlaceNodes, FindsThePlaneOfALinearField) {
  for (const Vec3 direction : {Vec3{1, 2, 3}, Vec3{-3, 1, 2}, Vec3{2, -2, 1}, Vec3{1, 1, -3}}) {
    const Vec3 normal = unit(direction);
    test::Case input = ramp({9, 9, 9}, 0.3 * normal);
    const double shift = 0.5 / norm(direction), distance = dot(normal, {4.5, 4.5, 4.5}) + shift;
    input.fill = [fill = input.fill, shift](const Index3& c, Fractions& f) {
      fill(c, f);
      const std::size_t last = f.value.size() - 1;
      f.value[last] -= 0.3 * shift;
      f.value[last - 1] += 0.3 * shift;
    };
    const Distances d = from_plane(placed(input), 9, normal, distance);
    ASSERT_GT(d.count, 20);
    EXPECT_LT(d.worst, 0.01) << "direction " << direction.x << " " << direction.y << " " << direction.z;
  }
}

// A sharp plane is known through the cells it cuts only; gradients there lean a little.
TEST(PlaceNodes, ComesCloseToASharpPlane) {
  for (const Vec3 direction : {Vec3{1, 2, 3}, Vec3{-3, 1, 0.5}, Vec3{2, -2.5, 1.7}, Vec3{0.2, 0.3, 1}}) {
    const Vec3 normal = unit(direction);
    const double distance = dot(normal, {5.1, 5.2, 4.9});
    const Distances d =
        from_plane(placed(test::half_space({10, 10, 10}, normal, distance)), 10, normal, distance);
    ASSERT_GT(d.count, 20);
    EXPECT_LT(d.mean, 0.03) << "direction " << direction.x << " " << direction.y << " " << direction.z;
    EXPECT_LT(d.worst, 0.06) << "direction " << direction.x << " " << direction.y << " " << direction.z;
  }
}

// A plane along the grid moves no node within the plane.
TEST(PlaceNodes, MovesAPlaneAlongTheGridAlongItsNormal) {
  for (const double at : {3.2, 3.5, 3.9, 4.3}) {
    test::Case input = test::voxels("slab", {7, 4, 4}, 2, [](const Index3&) { return 0; });
    input.fill = [at](const Index3& c, Fractions& f) {
      const double one = std::clamp(static_cast<double>(c[0]) + 1 - at, 0.0, 1.0);
      if (one < 1) f.add(0, 1 - one);
      if (one > 0) f.add(1, one);
    };
    const Placed p = placed(input);
    for (const LocalId n : p.faces.nodes) {
      const Vec3 before = p.before[static_cast<std::size_t>(n)],
                 after = p.cells.position[static_cast<std::size_t>(n)];
      EXPECT_NEAR(after.x, at, 0.1);
      EXPECT_NEAR(after.y, before.y, 1e-12);
      EXPECT_NEAR(after.z, before.z, 1e-12);
    }
  }
}

TEST(PlaceNodes, FindsABall) {
  const Vec3 centre{7.03, 6.9, 7.1};
  const double radius = 4.3;
  const Placed p = placed(test::ball({14, 14, 14}, centre, radius));
  double worst = 0;
  for (const LocalId n : p.faces.nodes)
    worst = std::max(worst, std::fabs(norm(p.cells.position[static_cast<std::size_t>(n)] - centre) - radius));
  EXPECT_LT(worst, 0.12);
}

void expect_held(const test::Case& input) {
  const Placed p = placed(input);
  EXPECT_EQ(test::box_problem(p.cells, input.grid), "") << input.name;
  std::vector<std::uint8_t> on_interface(p.before.size(), 0);
  for (const LocalId n : p.faces.nodes) on_interface[static_cast<std::size_t>(n)] = 1;
  for (std::size_t n = 0; n < p.before.size(); ++n) {
    const Vec3 move = p.cells.position[n] - p.before[n];
    if (!on_interface[n]) EXPECT_EQ(move, Vec3{}) << "a node away from the interfaces moved";
    for (std::size_t d = 0; d < 3; ++d) EXPECT_LE(std::fabs(move[d]), (0.7 + 1e-12) * p.cells.cell_size[d]);
  }
}

TEST(PlaceNodes, MovesInterfaceNodesOnlyAndKeepsTheBox) {
  expect_held(test::noise({6, 7, 5}, 5, 4));
  test::Case stretched = test::grains({8, 6, 7}, 12, 5, 2);
  stretched.grid = box_grid(stretched.grid.cells, {-1, 0.1, 5}, {3, 0.2, 25});
  expect_held(stretched);
  expect_held(test::two_phase_fractions({9, 8, 1}, 3));
}

TEST(EdgeCrossings, LieBetweenTheCellCentresWithNormalsFromSmallToLarge) {
  const test::Overlay o = test::filtered(test::grains({8, 8, 8}, 10, 4, 5));
  const Interfaces faces = trace_interfaces(o.cells, face_neighbours(o.cells));
  const auto crossings = edge_crossings(o.cells, faces, o.fractions, NodeHexes(o.cells));
  ASSERT_EQ(crossings.size(), faces.quads.size());
  for (std::size_t q = 0; q < crossings.size(); ++q) {
    std::array<Vec3, 2> centre;
    for (std::size_t s = 0; s < 2; ++s)
      for (const Vec3& p : o.cells.corners(faces.quads[q].cell[s])) centre[s] += 0.125 * p;
    const Vec3 step = centre[1] - centre[0], rest = crossings[q].point - centre[0];
    EXPECT_NEAR(norm(cross(step, rest)), 0, 1e-12);
    const double t = dot(rest, step);
    EXPECT_GE(t, 0.05 - 1e-12);
    EXPECT_LE(t, 0.95 + 1e-12);
    EXPECT_NEAR(norm(crossings[q].normal), 1, 1e-12);
  }
}

}  // namespace
}  // namespace sculpt
