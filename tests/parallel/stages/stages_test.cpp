// The same mesh, to the last bit, whoever owns which cells: checksums after every stage, all ranks together
// against each rank on its own.
#include <gtest/gtest.h>

#include "sculpt/mesh/adjacency.hpp"
#include "support/mesh_checks.hpp"
#include "support/stages.hpp"

namespace sculpt::test {

namespace {

void expect_same_alone_and_together(const Case& input, const StageOptions& options = {}) {
  const Comm world = Comm::world();
  const StagesResult together = run_stages(world, input, options),
                     alone = run_stages(Comm::self(), input, options);
  ASSERT_EQ(together.checksums.size(), alone.checksums.size());
  for (std::size_t i = 0; i < alone.checksums.size(); ++i)
    EXPECT_EQ(together.checksums[i].checksum, alone.checksums[i].checksum)
        << input.name << ", after " << alone.checksums[i].stage;
  EXPECT_EQ(together.ghosts, "") << input.name;
  EXPECT_EQ(world.sum(owned_hexes(together.mesh)), owned_hexes(alone.mesh)) << input.name;
  EXPECT_EQ(world.sum(together.quads), alone.quads) << input.name;
  const QualitySummary a = summarise(world, together.mesh), b = summarise(Comm::self(), alone.mesh);
  EXPECT_EQ(a.least, b.least);
  EXPECT_EQ(a.average, b.average);
  EXPECT_EQ(a.shortest_edge, b.shortest_edge);
  EXPECT_EQ(a.least_hex, b.least_hex);
  EXPECT_TRUE(a.least_at == b.least_at) << input.name;
}

TEST(SameMesh, OfFewerCellsThanRanksNeed) {
  expect_same_alone_and_together(noise({3, 5, 4}, 3, 1));
  expect_same_alone_and_together(noise({1, 1, 2}, 2, 2));
}

TEST(SameMesh, OfOneLayer) { expect_same_alone_and_together(noise({9, 8, 1}, 3, 3)); }

TEST(SameMesh, OfGrains) { expect_same_alone_and_together(grains({12, 12, 12}, 20, 8, 4)); }

TEST(SameMesh, OfTwoPhaseNoise) {
  Case input = two_phase_fractions({9, 8, 10}, 5);
  input.grid = box_grid(input.grid.cells, {-0.3, 0.1, 1}, {0.7, 1.1, 1.9});
  expect_same_alone_and_together(input);
}

TEST(SameMesh, WithoutTheVoid) {
  StageOptions options;
  options.void_material = 0;
  expect_same_alone_and_together(ball({10, 10, 10}, {5.2, 4.9, 5}, 3.7), options);
  expect_same_alone_and_together(grains({8, 8, 8}, 9, 4, 6), options);
}

TEST(SameMesh, WithSurfacePillows) {
  StageOptions options;
  options.pillow_surfaces = true;
  expect_same_alone_and_together(grains({10, 9, 8}, 12, 5, 7), options);
}

TEST(SameMesh, UnderAllCurveRules) {
  for (const CurveRule rule : {CurveRule::kOff, CurveRule::kCircle, CurveRule::kAverageTangent,
                               CurveRule::kNeighbourSurfaceNormal, CurveRule::kVfrac, CurveRule::kLinear}) {
    StageOptions options;
    options.interfaces.curve = rule;
    options.smoothing.improve_sweeps = 1;
    expect_same_alone_and_together(grains({7, 7, 7}, 8, 4, 8), options);
  }
}

TEST(SameMesh, OnQuadrics) {
  StageOptions options;
  options.interfaces.projection = SurfaceProjection::kQuadric;
  expect_same_alone_and_together(grains({8, 7, 7}, 8, 4, 9), options);
}

TEST(SameMesh, WithGuaranteedQuality) {
  StageOptions options;
  options.smoothing.guarantee_rounds = 4;
  options.smoothing.guarantee = 0.5;
  expect_same_alone_and_together(grains({8, 8, 7}, 10, 5, 3), options);
}

TEST(SameMesh, HeldOnTheGeometryOrNearIt) {
  StageOptions options;
  options.smoothing.hold_on_geometry = true;
  options.smoothing.fidelity = 10;
  expect_same_alone_and_together(grains({8, 7, 7}, 9, 5, 4), options);
  expect_same_alone_and_together(ball({8, 8, 8}, {4.2, 3.9, 4}, 2.7), options);
  options.smoothing.hold_on_geometry = false;
  options.smoothing.max_deviation = 0.2;
  expect_same_alone_and_together(noise({6, 6, 6}, 3, 12), options);
}

TEST(SameMesh, OfThePublishedMethod) {
  StageOptions options;
  options.smoothing.method = OptimisationMethod::kPublished;
  options.smoothing.target = 0.2;
  expect_same_alone_and_together(grains({8, 7, 7}, 9, 5, 4), options);
  options.smoothing.damping = false;
  options.smoothing.size_aware = true;
  expect_same_alone_and_together(two_phase_fractions({6, 6, 6}, 8), options);
}

TEST(ShaveBoundary, IsTheSameAloneAndTogether) {
  const Comm world = Comm::world();
  const Case input = noise({7, 6, 9}, 6, 9);
  Overlay together = overlay(world, input), alone = overlay(input);
  EXPECT_EQ(shave_boundary(together.cells, face_neighbours(together.cells), 0),
            shave_boundary(alone.cells, face_neighbours(alone.cells), 0));
  EXPECT_EQ(checksum(world, together.cells), checksum(Comm::self(), alone.cells));
}

TEST(ResolveNonManifold, ReportsTheSameAloneAndTogether) {
  const Comm world = Comm::world();
  for (const Case& input : {noise({8, 9, 7}, 2, 10), noise({8, 8, 8}, 50, 11),
                            voxels("checkerboard", {10, 8, 6}, 2, [](const Index3& c) {
                              return static_cast<std::int32_t>((c[0] + c[1] + c[2]) % 2);
                            })}) {
    Overlay together = overlay(world, input), alone = overlay(input);
    const auto resolve = [](Overlay& o) {
      return resolve_non_manifold(o.cells, o.fractions, face_neighbours(o.cells), NodeHexes(o.cells));
    };
    const ManifoldReport a = resolve(together), b = resolve(alone);
    EXPECT_EQ(a.bad_nodes, b.bad_nodes) << input.name;
    EXPECT_EQ(a.changed_cells, b.changed_cells) << input.name;
    EXPECT_EQ(a.passes, b.passes) << input.name;
    EXPECT_EQ(checksum(world, together.cells), checksum(Comm::self(), alone.cells)) << input.name;
    EXPECT_TRUE(
        interfaces_are_manifold(together.cells, face_neighbours(together.cells), NodeHexes(together.cells)));
    EXPECT_EQ(ghost_problem(together.cells), "") << input.name;
  }
}

}  // namespace
}  // namespace sculpt::test
