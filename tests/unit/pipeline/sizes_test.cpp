// Cells of several sizes through all stages.
#include <gtest/gtest.h>

#include <cmath>

#include "sculpt/quality/fidelity.hpp"
#include "support/mesh_checks.hpp"
#include "support/stages.hpp"

namespace sculpt {
namespace {

using test::StageOptions;
using test::StagesResult;

// Half cells of a grid of doubled cells are the cells of the grid: to the last bit, after every stage.
void expect_same_at_all_levels(const test::Case& input, const StageOptions& options = {}) {
  const StagesResult at0 = test::run_stages(Comm::self(), at_level(input, 0), options);
  for (const int level : {1, 3}) {
    const StagesResult r = test::run_stages(Comm::self(), at_level(input, level), options);
    ASSERT_EQ(r.checksums.size(), at0.checksums.size());
    for (std::size_t i = 0; i < r.checksums.size(); ++i)
      EXPECT_EQ(r.checksums[i].checksum, at0.checksums[i].checksum)
          << input.name << ", level " << level << ", after " << r.checksums[i].stage;
    const QualitySummary a = summarise(Comm::self(), at0.mesh), b = summarise(Comm::self(), r.mesh);
    EXPECT_EQ(a.least, b.least);
    EXPECT_EQ(a.shortest_edge, b.shortest_edge);
    EXPECT_EQ(a.shortest_edge_cells, b.shortest_edge_cells);
    EXPECT_EQ(a.worst.front().least_determinant, b.worst.front().least_determinant);
    for (std::size_t m = 0; m < a.materials.size(); ++m)
      EXPECT_NEAR(a.materials[m].volume, std::ldexp(b.materials[m].volume, 3 * level), 1e-4);
  }
}

TEST(Levels, AreButAnotherUnit) {
  expect_same_at_all_levels(test::grains({8, 7, 6}, 12, 6, 1));
  expect_same_at_all_levels(test::two_phase_fractions({7, 6, 5}, 2));
  test::Case flat = test::grains({8, 7, 6}, 9, 5, 3);
  // (A cube root is scaled exactly while the exponent keeps its sign.)
  flat.grid = uniform_grid(flat.grid.cells, {-1, 2, 0}, {3, 1.7, 4});
  expect_same_at_all_levels(flat);
}

TEST(Levels, AreButAnotherUnitUnderTheOptionsThatMeasureLengths) {
  const test::Case input = test::grains({8, 7, 6}, 12, 6, 4);
  std::vector<StageOptions> all(6);
  all[0].smoothing.hold_on_geometry = true;
  all[1].smoothing.max_deviation = 0.2;
  all[2].smoothing.guarantee_rounds = 3;
  all[2].smoothing.guarantee = 0.6;
  all[3].smoothing.method = OptimisationMethod::kPublished;
  all[3].smoothing.size_aware = true;
  all[4].layers.surfaces = true;
  all[5].interfaces.projection = SurfaceProjection::kInterface;
  for (const StageOptions& options : all) expect_same_at_all_levels(input, options);
}

TEST(Levels, MakeTheDefaultLimitOfDeviationThatOfTheCellsThere) {
  const test::Case input = test::grains({8, 7, 6}, 12, 6, 4);
  StageOptions at0, at1;
  at0.smoothing.deviation_by_level = at1.smoothing.deviation_by_level = true;
  at0.smoothing.max_deviation = 0.2;
  at1.smoothing.max_deviation = 0.4;
  const StagesResult a = test::run_stages(Comm::self(), at_level(input, 0), at0),
                     b = test::run_stages(Comm::self(), at_level(input, 1), at1);
  EXPECT_EQ(a.checksums.back().checksum, b.checksums.back().checksum);
}

void expect_good(const test::Case& input, const StagesResult& r, double least) {
  EXPECT_EQ(test::conformity_problem(r.mesh, r.pillows), "") << input.name;
  EXPECT_EQ(test::boundary_problem(r.mesh), "") << input.name;
  EXPECT_EQ(test::box_problem(r.mesh, input.grid), "") << input.name;
  const QualitySummary s = summarise(Comm::self(), r.mesh);
  EXPECT_GE(s.least, least) << input.name;
  EXPECT_EQ(s.not_positive_inside, 0) << input.name;
  EXPECT_GE(s.shortest_edge_cells, 0.06) << input.name;
  EXPECT_EQ(r.mesh.node_unit.size(), r.mesh.position.size());
}

// Largest and mean distance of interface nodes inside the box from a surface, in cells.
template <class Distance>
void expect_near(const StagesResult& r, double largest, double mean, Distance&& distance) {
  double most = 0, sum = 0;
  int count = 0;
  for (LocalId n = 0; n < r.mesh.nodes(); ++n) {
    // The gradients are mirrored at the box, where nodes leave a slanted surface.
    if (r.geometry.index[at(n)] == kNone || r.mesh.box_sides[at(n)] != 0) continue;
    const double off = std::fabs(distance(r.mesh.position[at(n)])) / r.mesh.unit(n);
    most = std::max(most, off);
    sum += off;
    ++count;
  }
  EXPECT_GT(count, 0);
  EXPECT_LE(most, largest);
  EXPECT_LE(sum / count, mean);
}

TEST(GradedMesh, OfABallThatCrossesTheGrading) {
  const Vec3 centre{6.1, 5.9, 6};
  const auto distance = [&](const Vec3& p) { return norm(p - centre) - 3.3; };
  const test::Case input = test::graded({15, 15, 15}, 6, [&](const Vec3& p) { return distance(p) < 0; });
  const StagesResult r = test::run_stages(Comm::self(), input);
  expect_good(input, r, 0.3);
  expect_near(r, 0.45, 0.07, distance);
  EXPECT_NEAR(test::volumes(r.mesh, 2)[1], 4.0 / 3 * std::acos(-1.0) * std::pow(3.3, 3), 4.5);
}

TEST(GradedMesh, OfASlantedPlaneThatCrossesTheGrading) {
  const Vec3 normal = unit({0.5, 0.7, 1});
  const auto distance = [&](const Vec3& p) { return dot(p - Vec3{6, 6, 6}, normal); };
  const test::Case input = test::graded({15, 14, 16}, 6, [&](const Vec3& p) { return distance(p) > 0; });
  const StagesResult r = test::run_stages(Comm::self(), input);
  expect_good(input, r, 0.3);
  expect_near(r, 0.45, 0.08, distance);
}

TEST(IrregularMesh, GoesThroughAllStages) {
  std::vector<StageOptions> all(5);
  for (std::size_t i = 1; i < 4; ++i) {
    all[i].filter.defeature = all[i].filter.collapse = all[i].filter.reversals = true;
    all[i].filter.defeature_box = i == 2;
  }
  all[1].filter.keep_materials = 14;
  all[2].layers.surfaces = true;
  all[3].layers.curves = true;
  all[3].layers.curve_threshold = 0.5;
  all[4].interfaces.projection = SurfaceProjection::kInterface;
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    for (const StageOptions& options : all) {
      const StagesResult r = test::run_stages(
          Comm::self(), test::irregular(Comm::self(), {9, 10, 9}, 14, seed, options.layers.ghost_layers()),
          true, options);
      // The ids tell the pillow of the cells as well.
      EXPECT_EQ(test::conformity_problem(r.mesh, r.pillows), "") << seed;
      EXPECT_EQ(test::boundary_problem(r.mesh), "") << seed;
      EXPECT_NEAR(test::volume(r.mesh), 810, 1e-9) << seed;
      EXPECT_GE(test::least_scaled_jacobian(r.mesh), 0.3) << seed;
      EXPECT_EQ(summarise(Comm::self(), r.mesh).not_positive_inside, 0) << seed;
    }
}

TEST(GradedMesh, CountsVolumesByTheCells) {
  const test::Case input = test::graded({9, 8, 7}, 4, [](const Vec3& p) { return p.x + p.y < 5.3; });
  const test::Overlay o = test::overlay(input);
  const std::vector<double> volume = input_volumes(Comm::self(), o.cells, o.fractions, 2);
  EXPECT_NEAR(volume[0] + volume[1], 6.5 * 6 * 5.5, 1e-6);
  EXPECT_NEAR(volume[1], (5.3 * 5.3 / 2) * 5.5, 0.4);
}

}  // namespace
}  // namespace sculpt
