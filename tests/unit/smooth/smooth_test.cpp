#include "sculpt/smooth/smooth.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace sculpt
