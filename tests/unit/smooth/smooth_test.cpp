#include "sculpt/smooth/smooth.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/mesh_checks.hpp"
#include "support/stages.hpp"

namespace sculpt {
namespace {

Geometry no_interfaces(const HexMesh& mesh) {
  Geometry g;
  g.index.assign(mesh.position.size(), kNone);
  return g;
}

HexMesh lattice(const Index3& cells, const Vec3& size = {1, 1, 1}) {
  test::Case input =
      test::voxels(cells, std::vector<std::int32_t>(static_cast<std::size_t>(whole(cells).size()), 0));
  input.grid = uniform_grid(cells, {0.1, -3, 7}, size);
  return test::overlay(input).cells;
}

TEST(SmoothMesh, DoesNotTouchAPerfectGrid) {
  for (const Vec3 size : {Vec3{1, 1, 1}, Vec3{0.1, 3, 0.7}}) {
    HexMesh mesh = lattice({6, 5, 4}, size);
    const std::vector<Vec3> before = mesh.position;
    smooth_mesh(mesh, no_interfaces(mesh), {}, Log());
    EXPECT_EQ(mesh.position, before);
  }
}

TEST(SmoothMesh, UntanglesANodeThatWasDraggedThroughItsHexes) {
  HexMesh mesh = lattice({5, 5, 5});
  const LocalId middle = 2 + 6 * (2 + 6 * 2);
  mesh.position[static_cast<std::size_t>(middle)] += Vec3{1.4, 0.3, -0.2};
  ASSERT_LT(test::least_scaled_jacobian(mesh), 0);
  smooth_mesh(mesh, no_interfaces(mesh), {}, Log());
  EXPECT_GT(test::least_scaled_jacobian(mesh), 0.3);
}

TEST(SmoothMesh, RaisesARandomMeshOnAnyGrid) {
  for (const Vec3 size : {Vec3{1, 1, 1}, Vec3{0.02, 0.02, 0.02}, Vec3{1, 2, 1.5}}) {
    HexMesh mesh = lattice({6, 6, 6}, size);
    for (std::size_t n = 0; n < mesh.position.size(); ++n) {
      Vec3 move;
      for (std::size_t d = 0; d < 3; ++d) move[d] = 0.9 * size[d] * (test::scatter_unit(4, 3 * n + d) - 0.5);
      mesh.position[n] += held_on_box(move, mesh.box_sides[n]);
    }
    const HexMesh before = mesh;
    ASSERT_LT(test::least_scaled_jacobian(mesh), 0.2);
    smooth_mesh(mesh, no_interfaces(mesh), {}, Log());
    EXPECT_GE(test::least_scaled_jacobian(mesh), 0.3);
    EXPECT_EQ(mesh.hexes, before.hexes);
    for (std::size_t n = 0; n < mesh.position.size(); ++n) {
      const Vec3 move = mesh.position[n] - before.position[n];
      EXPECT_EQ(held_on_box(move, mesh.box_sides[n]), move) << "a node left its side of the box";
    }
  }
}

TEST(SmoothMesh, MakesEveryHexOfRandomNoisePositive) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const test::Case input = test::two_phase_fractions({9, 8, 7}, seed);
    const HexMesh mesh = test::run_stages(Comm::self(), input).mesh;
    EXPECT_GT(test::least_scaled_jacobian(mesh), 0) << input.name;
    EXPECT_EQ(test::box_problem(mesh, input.grid), "") << input.name;
    EXPECT_EQ(summarise(Comm::self(), mesh).not_positive, 0);
  }
}

TEST(SmoothMesh, KeepsABallRound) {
  const Vec3 centre{6, 6, 6};
  const HexMesh mesh = test::run_stages(Comm::self(), test::ball({12, 12, 12}, centre, 4)).mesh;
  EXPECT_GE(test::least_scaled_jacobian(mesh), 0.3);
  EXPECT_NEAR(test::volumes(mesh, 2)[1], 4.0 / 3 * std::acos(-1.0) * 64, 0.03 * 268);
}

// Polycrystals with surface pillows on which the optimisation alone leaves edges of 0.018 and 0.034.
TEST(SmoothMesh, LeavesNoEdgeThatIsAboutToVanish) {
  for (const std::uint64_t seed : {10U, 11U}) {
    test::StageOptions options;
    options.layers.surfaces = true;
    const test::StagesResult r =
        test::run_stages(Comm::self(), test::grains({14, 13, 12}, 12, 8, seed), options);
    const QualitySummary s = summarise(Comm::self(), r.mesh);
    EXPECT_GE(s.shortest_edge, 0.05) << seed;
    EXPECT_GE(s.least, 0.3) << seed;
    EXPECT_EQ(s.not_positive_inside, 0) << seed;
  }
}

// Planes on cell faces that cross each other: pillows move, interfaces do not.
TEST(SmoothMesh, LeavesPlaneInterfacesWhereTheyAre) {
  const test::Case cross = test::voxels(
      "cross", {7, 6, 5}, 4, [](const Index3& c) { return (c[0] < 3 ? 0 : 1) + (c[1] < 4 ? 0 : 2); });
  std::vector<SmoothOptions> all(5);
  all[1].guarantee_rounds = 2;
  all[2].hold_on_geometry = true;
  all[3].max_deviation = 0.1;
  all[4].method = OptimisationMethod::kPublished;
  for (const SmoothOptions& smoothing : all) {
    test::StageOptions options;
    options.smoothing = smoothing;
    const test::StagesResult r = test::run_stages(Comm::self(), cross, options);
    std::int64_t on_planes = 0;
    for (std::size_t n = 0; n < r.mesh.position.size(); ++n) {
      if (r.geometry.index[n] == kNone) continue;
      for (std::size_t d = 0; d < 3; ++d) EXPECT_EQ(r.mesh.position[n][d], std::round(r.mesh.position[n][d]));
      ++on_planes;
    }
    EXPECT_EQ(on_planes, 7 * 6 + 8 * 6 - 6);
  }
}

// Distance of each interface node from its point of the geometry, the largest; along its box sides.
double farthest_from_geometry(const test::StagesResult& r) {
  double farthest = 0;
  for (std::size_t n = 0; n < r.mesh.position.size(); ++n) {
    if (r.geometry.index[n] == kNone) continue;
    const Vec3& p = r.mesh.position[n];
    farthest = std::max(farthest,
                        norm(held_on_box(r.geometry.onto(r.geometry.index[n], p) - p, r.mesh.box_sides[n])));
  }
  return farthest;
}

TEST(SmoothMesh, HoldsTheLimitOfDeviation) {
  const test::Case input = test::grains({10, 10, 10}, 25, 10, 3);
  for (const double limit : {0.35, 0.25}) {
    test::StageOptions options;
    options.interfaces.pairs = 20;
    options.smoothing.max_deviation = limit;
    const test::StagesResult r = test::run_stages(Comm::self(), input, options);
    EXPECT_LE(farthest_from_geometry(r), limit);
    EXPECT_GE(test::least_scaled_jacobian(r.mesh), 0.3);
  }
  test::StageOptions free;  // the limit is what does it
  free.interfaces.pairs = 20;
  free.smoothing.max_deviation = 100;
  EXPECT_GT(farthest_from_geometry(test::run_stages(Comm::self(), input, free)), 0.4);
}

TEST(SmoothMesh, HoldsInterfacesOnTheGeometry) {
  const Vec3 centre{6.1, 5.9, 6};
  test::StageOptions options;
  options.interfaces.exact = [&](const Vec3& p, std::int32_t, std::int32_t) {
    return std::optional<Vec3>(centre + 4 * unit(p - centre));
  };
  options.smoothing.hold_on_geometry = true;
  options.smoothing.fidelity = 10;
  const test::StagesResult r = test::run_stages(Comm::self(), test::ball({12, 12, 12}, centre, 4), options);
  EXPECT_GE(test::least_scaled_jacobian(r.mesh), 0.3);
  for (std::size_t n = 0; n < r.mesh.position.size(); ++n)
    if (r.geometry.index[n] != kNone) EXPECT_NEAR(norm(r.mesh.position[n] - centre), 4, 0.005);
}

struct Guaranteed {
  double least;
  std::string log;
};
Guaranteed guaranteed(double goal, int rounds) {
  test::StageOptions options;
  options.smoothing.guarantee = goal;
  options.smoothing.guarantee_rounds = rounds;
  options.log = Log(true);
  testing::internal::CaptureStdout();
  const HexMesh mesh = test::run_stages(Comm::self(), test::grains({9, 9, 9}, 18, 8, 5), options).mesh;
  return {test::least_scaled_jacobian(mesh), testing::internal::GetCapturedStdout()};
}

TEST(SmoothMesh, GuaranteesQuality) {
  const Guaranteed without = guaranteed(0.5, 0), with = guaranteed(0.5, 10);
  ASSERT_LT(without.least, 0.5);
  EXPECT_EQ(without.log.find("Guaranteed"), std::string::npos);
  EXPECT_GE(with.least, 0.5);
  EXPECT_NE(with.log.find("Guaranteed Quality Iter: 1, Num below 0.5: "), std::string::npos) << with.log;
  EXPECT_NE(with.log.find("farthest interface node: 0."), std::string::npos);
  EXPECT_NE(with.log.find("Guaranteed quality 0.5 holds"), std::string::npos);
}

TEST(SmoothMesh, TellsWhereTheGuaranteeFails) {
  const Guaranteed without = guaranteed(0.95, 0), with = guaranteed(0.95, 2);
  EXPECT_LT(with.least, 0.95);
  EXPECT_GE(with.least, std::min(without.least, 0.3));
  EXPECT_NE(with.log.find("stay below the guaranteed quality 0.95"), std::string::npos);
}

}  // namespace
}  // namespace sculpt
