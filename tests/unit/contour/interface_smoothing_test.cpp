#include "sculpt/contour/interface_smoothing.hpp"

#include <gtest/gtest.h>

#include "support/mesh_checks.hpp"
#include "support/stages.hpp"

namespace sculpt {
namespace {

struct Surface {
  HexMesh cells;
  Interfaces faces;
  std::vector<Crossing> crossings;
  std::vector<Vec3> grid_position;
};

Surface surface(const test::Case& input) {
  test::Overlay o = test::filtered(input);
  Surface s{std::move(o.cells), {}, {}, {}};
  s.faces = trace_interfaces(s.cells, face_neighbours(s.cells));
  s.crossings = edge_crossings(s.cells, s.faces, o.fractions, NodeHexes(s.cells));
  for (const LocalId n : s.faces.nodes)
    s.grid_position.push_back(s.cells.position[static_cast<std::size_t>(n)]);
  return s;
}

constexpr CurveRule kAllRules[] = {CurveRule::kOff,
                                   CurveRule::kCircle,
                                   CurveRule::kHermite,
                                   CurveRule::kAverageTangent,
                                   CurveRule::kNeighbourSurfaceNormal,
                                   CurveRule::kVfrac,
                                   CurveRule::kLinear};

TEST(SmoothInterface, LeavesAFlatInterfaceAlone) {
  for (const CurveRule rule : kAllRules) {
    Surface s = surface(test::voxels("slab", {6, 5, 4}, 2, [](const Index3& c) { return c[0] < 3 ? 0 : 1; }));
    const std::vector<Vec3> before = s.cells.position;
    smooth_interface(s.cells, s.faces, s.crossings, s.grid_position, {.pairs = 5, .curve = rule});
    for (std::size_t n = 0; n < before.size(); ++n)
      EXPECT_NEAR(norm(s.cells.position[n] - before[n]), 0, 1e-12);
  }
}

TEST(SmoothInterface, TakesAStepOutOfTheStaircase) {
  // A slope of one step in three cells: after smoothing the spread about the mean plane is smaller.
  const auto roughness = [](const Surface& s) {
    const Vec3 normal = unit({1, 0, -3});
    double sum = 0, squares = 0, count = 0;
    for (const LocalId n : s.faces.nodes) {
      const double off = dot(normal, s.cells.position[static_cast<std::size_t>(n)]);
      sum += off;
      squares += off * off;
      ++count;
    }
    return squares / count - (sum / count) * (sum / count);
  };
  Surface s = surface(
      test::voxels("stairs", {12, 5, 8}, 2, [](const Index3& c) { return c[2] < 2 + c[0] / 3 ? 0 : 1; }));
  const double before = roughness(s);
  smooth_interface(s.cells, s.faces, s.crossings, s.grid_position, {});
  EXPECT_LT(roughness(s), 0.6 * before);
}

TEST(SmoothInterface, KeepsTheBoxAndTheReachUnderAllRules) {
  const test::Case input = test::grains({8, 7, 6}, 14, 6, 8);
  for (const CurveRule rule : kAllRules) {
    Surface s = surface(input);
    const std::vector<Vec3> before = s.cells.position;
    smooth_interface(s.cells, s.faces, s.crossings, s.grid_position, {.pairs = 10, .curve = rule});
    EXPECT_EQ(test::box_problem(s.cells, input.grid), "");
    for (std::size_t n = 0; n < before.size(); ++n) {
      EXPECT_LE(largest(s.cells.position[n] - before[n]), 0.45 + 1e-12);
      if (s.faces.index_of[n] == kNone) EXPECT_EQ(s.cells.position[n], before[n]);
    }
  }
}

// With projection the nodes of a ball stay on it, and spread.
TEST(SmoothInterface, ProjectsToTheTrueSurface) {
  const Vec3 centre{6.1, 5.9, 6};
  Surface s = surface(test::ball({12, 12, 12}, centre, 4));
  place_nodes(s.cells, s.faces, s.crossings);
  smooth_interface(s.cells, s.faces, s.crossings, s.grid_position,
                   {.projection = SurfaceProjection::kInterface});
  double worst = 0;
  for (const LocalId n : s.faces.nodes)
    worst = std::max(worst, std::fabs(norm(s.cells.position[static_cast<std::size_t>(n)] - centre) - 4));
  EXPECT_LT(worst, 0.1);
}

// On quadrics a ball of voxels keeps its size; plain shrinking draws it in.
TEST(SmoothInterface, OnQuadricsABallKeepsItsSize) {
  const Vec3 centre{8, 8, 8};
  Surface s = surface(test::voxels("ball", {16, 16, 16}, 2, [&](const Index3& c) {
    const Vec3 p{static_cast<double>(c[0]) + 0.5, static_cast<double>(c[1]) + 0.5,
                 static_cast<double>(c[2]) + 0.5};
    return norm(p - centre) < 5 ? 1 : 0;
  }));
  const auto mean_radius = [&] {
    double sum = 0;
    for (const LocalId n : s.faces.nodes) sum += norm(s.cells.position[static_cast<std::size_t>(n)] - centre);
    return sum / static_cast<double>(s.faces.nodes.size());
  };
  place_nodes(s.cells, s.faces, s.crossings);
  const std::vector<Vec3> placed = s.cells.position;
  const double before = mean_radius();
  smooth_interface(s.cells, s.faces, s.crossings, s.grid_position, {.pairs = 5, .grow = 0});
  EXPECT_LT(mean_radius(), before - 0.15);
  s.cells.position = placed;
  smooth_interface(s.cells, s.faces, s.crossings, s.grid_position,
                   {.pairs = 5, .projection = SurfaceProjection::kQuadric});
  EXPECT_NEAR(mean_radius(), before, 0.05);
}

TEST(SmoothInterface, GoesToTheExactSurface) {
  const Vec3 centre{6.1, 5.9, 6};
  Surface s = surface(test::ball({12, 12, 12}, centre, 4));
  place_nodes(s.cells, s.faces, s.crossings);
  const ExactSurface sphere = [&](const Vec3& p, std::int32_t a, std::int32_t b) {
    EXPECT_EQ(a, 0);
    EXPECT_EQ(b, 1);
    return std::optional<Vec3>(centre + 4 * unit(p - centre));
  };
  smooth_interface(s.cells, s.faces, s.crossings, s.grid_position,
                   {.projection = SurfaceProjection::kInterface, .exact = sphere});
  for (const LocalId n : s.faces.nodes)
    EXPECT_NEAR(norm(s.cells.position[static_cast<std::size_t>(n)] - centre), 4, 1e-9);
}

TEST(SmoothInterface, LeavesAFlatInterfaceAloneToTheLastBit) {
  for (const SurfaceProjection projection :
       {SurfaceProjection::kOff, SurfaceProjection::kQuadric, SurfaceProjection::kInterface}) {
    Surface s = surface(test::voxels(
        "cross", {6, 5, 4}, 4, [](const Index3& c) { return (c[0] < 3 ? 0 : 1) + (c[1] < 2 ? 0 : 2); }));
    const std::vector<Vec3> before = s.cells.position;
    place_nodes(s.cells, s.faces, s.crossings);
    smooth_interface(s.cells, s.faces, s.crossings, s.grid_position, {.projection = projection});
    EXPECT_EQ(s.cells.position, before);
  }
}

TEST(SmoothInterface, WithoutPairsDoesNothing) {
  Surface s = surface(test::noise({5, 5, 5}, 3, 3));
  const std::vector<Vec3> before = s.cells.position;
  smooth_interface(s.cells, s.faces, s.crossings, s.grid_position, {.pairs = 0});
  EXPECT_EQ(s.cells.position, before);
}

double weighed(const Weight& w, const Vec3& d) {
  return w[0] * d.x * d.x + w[3] * d.y * d.y + w[5] * d.z * d.z +
         2 * (w[1] * d.x * d.y + w[2] * d.x * d.z + w[4] * d.y * d.z);
}

TEST(DeviationWeights, HoldSurfacesAlongTheirNormalAndCurvesAcross) {
  const Surface s = surface(test::voxels("three", {4, 4, 4}, 3, [](const Index3& c) {
    return c[2] < 2 ? 2 : c[0] < 2 ? 0 : 1;
  }));
  const std::vector<Weight> weights = deviation_weights(s.cells, s.faces);
  const auto at = [&](LocalId i, LocalId j, LocalId k) {
    return weights[static_cast<std::size_t>(s.faces.index_of[static_cast<std::size_t>(i + 5 * (j + 5 * k))])];
  };
  const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  const Weight on_surface = at(1, 2, 2);  // of the plane z = 2
  EXPECT_NEAR(weighed(on_surface, z), 1, 1e-12);
  EXPECT_LT(weighed(on_surface, x), 0.5);
  EXPECT_LT(weighed(on_surface, y), 0.5);
  const Weight on_curve = at(2, 2, 2);  // runs along y
  EXPECT_NEAR(weighed(on_curve, x), 1, 1e-12);
  EXPECT_NEAR(weighed(on_curve, z), 1, 1e-12);
  EXPECT_LT(weighed(on_curve, y), 0.5);
  const Weight on_vertex = at(2, 0, 2);
  for (const Vec3& d : {x, y, z}) EXPECT_NEAR(weighed(on_vertex, d), 1, 1e-12);
}

}  // namespace
}  // namespace sculpt
