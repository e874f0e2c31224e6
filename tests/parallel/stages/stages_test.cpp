// The same mesh, to the last bit, whoever owns which cells: checksums after every stage, all ranks together
// against each rank on its own.
#include <gtest/gtest.h>

#include <algorithm>

#include "sculpt/filter/thicken.hpp"
#include "sculpt/mesh/adjacency.hpp"
#include "support/features.hpp"
#include "support/mesh_checks.hpp"
#include "support/stages.hpp"

namespace sculpt::test {

namespace {

void expect_same(const StagesResult& together, const StagesResult& alone, const std::string& name) {
  const Comm world = Comm::world();
  EXPECT_EQ(together.checksums.size(), alone.checksums.size());
  for (std::size_t i = 0; i < std::min(alone.checksums.size(), together.checksums.size()); ++i)
    EXPECT_EQ(together.checksums[i].checksum, alone.checksums[i].checksum)
        << name << ", after " << alone.checksums[i].stage;
  EXPECT_EQ(together.ghosts, "") << name;
  EXPECT_EQ(world.sum(owned_hexes(together.mesh)), owned_hexes(alone.mesh)) << name;
  EXPECT_EQ(world.sum(together.quads), alone.quads) << name;
}

// Answers how many pillows the mesh has.
int expect_same_alone_and_together(const Case& input, const StageOptions& options = {}) {
  const StagesResult together = run_stages(Comm::world(), input, options),
                     alone = run_stages(Comm::self(), input, options);
  expect_same(together, alone, input.name);
  return alone.pillows;
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

TEST(SameMesh, OfCellsOfSeveralSizes) {
  const Vec3 centre{4.1, 3.9, 4};
  expect_same_alone_and_together(
      graded({10, 11, 9}, 4, [&](const Vec3& p) { return norm(p - centre) < 2.3; }));
}

TEST(SameMesh, OfIrregularCells) {
  StageOptions options;
  options.filter.defeature = options.filter.collapse = options.filter.reversals = true;
  for (const bool surfaces : {false, true}) {
    options.layers.surfaces = surfaces;
    const auto run = [&](const Comm& comm) {
      return run_stages(comm, irregular(comm, {9, 8, 10}, 12, 5, options.layers.ghost_layers()), true,
                        options);
    };
    expect_same(run(Comm::world()), run(Comm::self()), "irregular cells");
  }
}

TEST(SameMesh, WithoutTheVoid) {
  StageOptions options;
  options.void_material = 0;
  expect_same_alone_and_together(ball({10, 10, 10}, {5.2, 4.9, 5}, 3.7), options);
  expect_same_alone_and_together(grains({8, 8, 8}, 9, 4, 6), options);
}

TEST(SameMesh, WithSurfacePillows) {
  StageOptions options;
  options.layers.surfaces = true;
  expect_same_alone_and_together(grains({10, 9, 8}, 12, 5, 7), options);
}

TEST(SameMesh, OfACapturedBox) {
  const auto box = turned_box({6.1, 5.9, 6.05}, {3.6, 3.1, 3.3});
  StageOptions options;
  options.features = box;
  options.layers.captured = options.smoothing.hold_on_geometry = options.smoothing.captured = true;
  expect_same_alone_and_together(box_case({12, 12, 12}, *box), options);
  options.void_material = 0;
  expect_same_alone_and_together(box_case({12, 12, 12}, *box), options);
}

TEST(SameMesh, WithLayersAlongTheBox) {
  StageOptions options;
  options.layers.boundary_layers = 2;
  expect_same_alone_and_together(grains({9, 8, 7}, 10, 5, 7), options);
  options.void_material = 0;
  expect_same_alone_and_together(noise({3, 5, 4}, 3, 1), options);
}

// The growth and completion of the set around curves cross the borders between ranks.
TEST(SameMesh, WithLayersAroundCurves) {
  StageOptions options;
  options.layers.curves = true;
  options.layers.curve_threshold = 0.5;
  for (const int layers : {1, 3})
    for (const bool smooth : {false, true}) {
      options.layers.curve_layers = layers;
      options.layers.smooth_after = smooth;
      const int pillows = expect_same_alone_and_together(grains({12, 9, 8}, 9, 9, 7), options);
      if (!smooth) EXPECT_EQ(pillows, 2);
    }
}

// Periodic meshes: odd and even numbers of cells, axes so short that the ghosts wrap around more than once,
// and cells that compete with each other all around the torus.
TEST(SameMesh, OfPeriodicGrids) {
  expect_same_alone_and_together(periodic(grains({12, 11, 10}, 20, 8, 4)));
  expect_same_alone_and_together(periodic(grains({9, 8, 7}, 12, 5, 7), {true, false, true}));
  expect_same_alone_and_together(periodic(noise({7, 6, 5}, 3, 3)));
  Case input = periodic(two_phase_fractions({9, 8, 10}, 5));
  input.grid = box_grid(input.grid.cells, {-0.3, 0.1, 1}, {0.7, 1.1, 1.9});
  expect_same_alone_and_together(input);
}

TEST(SameMesh, OfThinPeriodicGrids) {
  for (const std::int64_t n : {2, 3})
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      expect_same_alone_and_together(periodic(noise({8, 7, n}, 3, seed)));
      expect_same_alone_and_together(periodic(noise({n, n, 3}, 2, seed)));
    }
  expect_same_alone_and_together(periodic(noise({6, 1, 2}, 2, 8), {true, false, true}));
}

TEST(SameMesh, OfPeriodicGridsWithLayers) {
  StageOptions options;
  options.layers.surfaces = true;
  options.layers.curves = true;
  options.layers.curve_threshold = 0.6;
  expect_same_alone_and_together(periodic(grains({10, 9, 4}, 12, 5, 7)), options);
  options.layers = {};
  options.layers.boundary_layers = 2;
  expect_same_alone_and_together(periodic(grains({8, 7, 6}, 9, 5, 7), {true, true, false}), options);
  options = {};
  options.void_material = 0;
  expect_same_alone_and_together(periodic(noise({5, 5, 4}, 3, 1)), options);
  options.smoothing.method = OptimisationMethod::kPublished;
  expect_same_alone_and_together(periodic(grains({8, 7, 6}, 9, 5, 7)), options);
}

TEST(SameMesh, WithAllLayers) {
  StageOptions options;
  options.void_material = 1;
  options.layers.surfaces = options.layers.curves = true;
  options.layers.curve_threshold = 0.4;
  options.layers.curve_layers = 2;
  options.layers.boundary_layers = 1;
  options.layers.smooth_after = false;
  EXPECT_EQ(expect_same_alone_and_together(grains({9, 8, 7}, 8, 5, 3), options), 4);
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

// Every option of the filter at once and alone, on data that needs it.
TEST(FilterMaterials, IsTheSameAloneAndTogether) {
  const Comm world = Comm::world();
  FilterOptions shave, defeature, collapse, all;
  collapse.collapse = true;
  shave.shave_to = 0;
  defeature.defeature = true;
  defeature.min_vol_cells = 3;
  all = defeature;
  all.defeature_box = all.reversals = all.collapse = true;
  all.shave_to = 1;
  all.keep_materials = 30;
  for (const Case& input : {noise({7, 6, 9}, 6, 9), noise({9, 8, 7}, 2, 3), grains({10, 9, 8}, 40, 30, 7),
                            two_phase_fractions({8, 9, 7}, 4)})
    for (const FilterOptions& options : {shave, defeature, collapse, all}) {
      Overlay together = overlay(world, input), alone = overlay(input);
      const auto filter = [&options](Overlay& o) {
        return filter_materials(o.cells, o.fractions, face_neighbours(o.cells), NodeHexes(o.cells), options);
      };
      const FilterReport a = filter(together), b = filter(alone);
      EXPECT_EQ(a.shaved, b.shaved) << input.name;
      EXPECT_EQ(a.islands, b.islands) << input.name;
      EXPECT_EQ(a.island_cells, b.island_cells) << input.name;
      EXPECT_EQ(a.protrusions, b.protrusions) << input.name;
      EXPECT_EQ(a.collapses, b.collapses) << input.name;
      EXPECT_EQ(a.rounds, b.rounds) << input.name;
      EXPECT_EQ(a.reversals, b.reversals) << input.name;
      EXPECT_EQ(checksum(world, together.cells), checksum(Comm::self(), alone.cells)) << input.name;
      EXPECT_TRUE(interfaces_are_manifold(together.cells, face_neighbours(together.cells),
                                          NodeHexes(together.cells)));
      EXPECT_EQ(ghost_problem(together.cells), "") << input.name;
    }
}

TEST(Defeature, OfPeriodicGridsIsTheSameAloneAndTogether) {
  const Comm world = Comm::world();
  FilterOptions options;
  options.defeature = options.collapse = options.reversals = true;
  options.keep_materials = 3;
  const auto stripes = [](const Index3& c) { return static_cast<std::int32_t>((c[0] + c[1] + c[2]) % 3); };
  for (const Case& input :
       {periodic(noise({7, 6, 5}, 3, 5)), periodic(voxels("stripes", {9, 6, 3}, 3, stripes)),
        periodic(noise({8, 2, 3}, 3, 9)), periodic(noise({6, 5, 4}, 3, 2), {false, true, false})}) {
    Overlay together = overlay(world, input), alone = overlay(Comm::self(), input);
    const auto filter = [&options](Overlay& o) {
      return filter_materials(o.cells, o.fractions, face_neighbours(o.cells), NodeHexes(o.cells), options);
    };
    const FilterReport a = filter(together), b = filter(alone);
    EXPECT_EQ(a.islands, b.islands) << input.name;
    EXPECT_EQ(a.island_cells, b.island_cells) << input.name;
    EXPECT_EQ(a.manifold_cells, b.manifold_cells) << input.name;
    EXPECT_EQ(checksum(world, together.cells), checksum(Comm::self(), alone.cells)) << input.name;
    EXPECT_TRUE(
        interfaces_are_manifold(together.cells, face_neighbours(together.cells), NodeHexes(together.cells)));
    EXPECT_EQ(ghost_problem(together.cells), "") << input.name;
  }
}

TEST(Thicken, IsTheSameAloneAndTogether) {
  const Comm world = Comm::world();
  const Case input = noise({7, 9, 8}, 3, 21);
  Overlay together = overlay(world, input), alone = overlay(input);
  for (Overlay* o : {&together, &alone}) {
    const FaceNeighbours neighbours = face_neighbours(o->cells);
    const NodeHexes around(o->cells);
    thicken(o->cells, o->fractions, neighbours, around, 1, 0.4);
    thicken(o->cells, o->fractions, neighbours, around, 2, 0.25);
    (void)separate_by_void(o->cells, o->fractions, around, 0, false);
  }
  EXPECT_EQ(checksum(world, together.cells), checksum(Comm::self(), alone.cells));
  EXPECT_EQ(ghost_problem(together.cells), "");
}

TEST(ResolveNonManifold, ReportsTheSameAloneAndTogether) {
  const Comm world = Comm::world();
  for (const Case& input : {noise({8, 9, 7}, 2, 10), noise({8, 8, 8}, 50, 11),
                            voxels("checkerboard", {10, 8, 6}, 2, [](const Index3& c) {
                              return static_cast<std::int32_t>((c[0] + c[1] + c[2]) % 2);
                            })}) {
    Overlay together = overlay(world, input), alone = overlay(input);
    const auto resolve = [](Overlay& o) {
      return filter_materials(o.cells, o.fractions, face_neighbours(o.cells), NodeHexes(o.cells));
    };
    const FilterReport a = resolve(together), b = resolve(alone);
    EXPECT_EQ(a.bad_nodes, b.bad_nodes) << input.name;
    EXPECT_EQ(a.manifold_cells, b.manifold_cells) << input.name;
    EXPECT_EQ(a.manifold_passes, b.manifold_passes) << input.name;
    EXPECT_EQ(checksum(world, together.cells), checksum(Comm::self(), alone.cells)) << input.name;
    EXPECT_TRUE(
        interfaces_are_manifold(together.cells, face_neighbours(together.cells), NodeHexes(together.cells)));
    EXPECT_EQ(ghost_problem(together.cells), "") << input.name;
  }
}

}  // namespace
}  // namespace sculpt::test
