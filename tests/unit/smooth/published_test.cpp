// The report's own optimisation: its objective by hand, and what it does to meshes.
#include "smooth/published.hpp"

#include <gtest/gtest.h>

#include "smooth/node_objective.hpp"
#include "support/mesh_checks.hpp"
#include "support/stages.hpp"

namespace sculpt {
namespace {

using test::lattice;
constexpr LocalId kMiddle = 1 + 3 * (1 + 3 * 1);  // of a lattice of 2 x 2 x 2 cells

NodeObjective objective_at_middle(const HexMesh& mesh, bool size_aware = false, double scale = 1) {
  NodeObjective objective;
  const NodeHexes around(mesh);
  objective.gather(mesh, around[kMiddle], kMiddle, scale, size_aware);
  return objective;
}

TEST(NodeObjective, IsTheWorstCornerWhileAllArePositive) {
  const NodeObjective objective = objective_at_middle(lattice({2, 2, 2}));
  EXPECT_NEAR(objective.mean_edge(), 1, 1e-15);
  const auto here = objective.at_displacement({});
  EXPECT_TRUE(here.valid());
  EXPECT_NEAR(here.quality(), 1, 1e-15);
  // Half a cell along x and y: at the node the edges to its neighbours in x run along x, those in y turn. The
  // worst corner is at a neighbour in z, where the edge to the node makes an angle with z: cos = 1 /
  // sqrt(1.5) before the other corners are looked at.
  const auto moved = objective.at_displacement({0.5, 0, 0});
  EXPECT_TRUE(moved.valid());
  // At the node: edges (0.5,0,0), (-0.5,1,0), (-0.5,0,1): 0.5 / (0.5 * 1.25).
  EXPECT_NEAR(moved.quality(), 0.8, 1e-15);
}

TEST(NodeObjective, IsTheNegativeVolumeOtherwise) {
  const NodeObjective objective = objective_at_middle(lattice({2, 2, 2}));
  // A quarter of a cell beyond the far side of the cells ahead: their edges along x point backwards.
  const auto through = objective.at_displacement({1.25, 0, 0});
  EXPECT_FALSE(through.valid());
  // Each of the four hexes ahead: its corner at the node and the one beyond it both have -0.25 of a cell, the
  // two beside it stay right: 0.25 / 6 each.
  EXPECT_EQ(through.negative, 8);
  EXPECT_NEAR(through.quality(), -2 * 0.25 / 6, 1e-15);
  EXPECT_LT(objective.at_displacement({1.5, 0, 0}).quality(), through.quality());
}

TEST(NodeObjective, WeighsSize) {
  HexMesh mesh = lattice({2, 2, 2});
  for (Vec3& p : mesh.position) p = 0.5 * p;
  EXPECT_NEAR(objective_at_middle(mesh, false).at_displacement({}).quality(), 1, 1e-15);
  EXPECT_NEAR(objective_at_middle(mesh, true).at_displacement({}).quality(), 0.5, 1e-15);  // too small by 2
  EXPECT_NEAR(objective_at_middle(mesh, true, 2).at_displacement({}).quality(), 1, 1e-15);
  EXPECT_NEAR(objective_at_middle(mesh, true, 8).at_displacement({}).quality(), 0.25,
              1e-15);  // too large by 4
}

SmoothOptions published() {
  SmoothOptions options;
  options.method = OptimisationMethod::kPublished;
  options.target = 0.2;
  return options;
}

Geometry no_interfaces(const HexMesh& mesh) {
  Geometry g;
  g.index.assign(mesh.position.size(), kNone);
  return g;
}

TEST(PublishedMethod, DoesNotTouchAPerfectGrid) {
  HexMesh mesh = lattice({5, 4, 3});
  const std::vector<Vec3> before = mesh.position;
  smooth_mesh(mesh, no_interfaces(mesh), published(), Log());
  EXPECT_EQ(mesh.position, before);
}

TEST(PublishedMethod, BringsASingleNodeBack) {
  for (const bool colour : {false, true}) {
    HexMesh mesh = lattice({4, 4, 4});
    const LocalId node = 2 + 5 * (2 + 5 * 2);
    mesh.position[static_cast<std::size_t>(node)] += Vec3{1.2, 0.2, -0.1};
    ASSERT_LT(test::least_scaled_jacobian(mesh), 0);
    SmoothOptions options = published();
    (colour ? options.improve_sweeps : options.target_rounds) = 0;
    smooth_mesh(mesh, no_interfaces(mesh), options, Log());
    EXPECT_GT(test::least_scaled_jacobian(mesh), colour ? 0.2 : 0.0);
  }
}

TEST(PublishedMethod, NeverMakesTheWholeMeshWorse) {
  for (const bool damping : {false, true}) {
    HexMesh mesh = lattice({6, 6, 6});
    for (std::size_t n = 0; n < mesh.position.size(); ++n) {
      Vec3 move;
      for (std::size_t d = 0; d < 3; ++d) move[d] = 0.7 * (test::scatter_unit(4, 3 * n + d) - 0.5);
      mesh.position[n] += held_on_box(move, mesh.box_sides[n]);
    }
    const double before = test::least_scaled_jacobian(mesh);
    const std::int64_t bad = summarise(Comm::self(), mesh).not_positive;
    SmoothOptions options = published();
    options.damping = damping;
    smooth_mesh(mesh, no_interfaces(mesh), options, Log());
    const QualitySummary after = summarise(Comm::self(), mesh);
    EXPECT_TRUE(after.not_positive < bad || after.least > before);
    EXPECT_EQ(test::box_problem(mesh, uniform_grid({6, 6, 6}, {}, {1, 1, 1})), "");
  }
}

// Nodes of surfaces keep to the sphere, whatever is optimised.
TEST(PublishedMethod, KeepsSurfaceNodesOnTheirSurface) {
  const Vec3 centre{5.1, 4.9, 5};
  test::StageOptions options;
  options.smoothing = published();
  options.smoothing.release_curves_below = -1;
  const test::StagesResult result =
      test::run_stages(Comm::self(), test::ball({10, 10, 10}, centre, 3.4), options);
  double worst = 0;
  for (std::size_t n = 0; n < result.mesh.position.size(); ++n)
    if (result.geometry.index[n] != kNone)
      worst = std::max(worst, std::fabs(norm(result.mesh.position[n] - centre) - 3.4));
  EXPECT_LT(worst, 0.1);
}

}  // namespace
}  // namespace sculpt
