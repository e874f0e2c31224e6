// Seeded random refined grids without any interface: smoothing makes every hex good.
#include <gtest/gtest.h>

#include "sculpt/adapt/leaf_mesh.hpp"
#include "support/fields.hpp"
#include "support/mesh_checks.hpp"

namespace sculpt::test {
namespace {

HexMesh smoothed(const Forest& forest, const Grid& grid) {
  HexMesh mesh = leaf_mesh(Comm::self(), grid, forest, alone(forest), 2).cells;
  Geometry no_interface;
  no_interface.index.assign(mesh.position.size(), kNone);
  smooth_mesh(mesh, no_interface, {}, Log());
  return mesh;
}

void expect_sound(const HexMesh& mesh, const Grid& grid, const std::string& name) {
  EXPECT_EQ(conformity_problem(mesh, 0), "") << name;
  EXPECT_EQ(boundary_problem(mesh), "") << name;
  EXPECT_EQ(box_problem(mesh, grid), "") << name;
  EXPECT_EQ(summarise(Comm::self(), mesh).not_positive_inside, 0) << name;
  EXPECT_NEAR(volume(mesh) / volume(grid), 1, 1e-12) << name;
}

// All blocks of 2x2x2 blocks in the middle of a grid.
TEST(RefinedGrid, EveryPatternOfEightBlocksReachesTheTarget) {
  const Grid grid = unit_grid({8, 8, 8});
  double least = 1;
  for (unsigned pattern = 1; pattern < 256; ++pattern) {
    Forest forest(grid.cells, 1, kNotPeriodic);
    for (unsigned b = 0; b < 8; ++b)
      if (pattern >> b & 1) forest.refine_block(0, {1 + (b & 1), 1 + (b >> 1 & 1), 1 + (b >> 2)});
    forest.close();
    const HexMesh mesh = smoothed(forest, grid);
    expect_sound(mesh, grid, "pattern " + std::to_string(pattern));
    EXPECT_GE(least_scaled_jacobian(mesh), 0.3) << "pattern " << pattern;
    least = std::min(least, least_scaled_jacobian(mesh));
  }
  std::printf("least scaled Jacobian of all patterns: %.4f\n", least);
}

TEST(RefinedGrid, RandomCellsReachTheTarget) {
  constexpr std::uint64_t kCases = 90;
  const Index3 grids[] = {{8, 8, 8}, {9, 7, 5}, {12, 1, 6}, {3, 2, 11}, {6, 6, 6}};
  double least = 1;
  int poor = 0;
  for (std::uint64_t n = 0; n < kCases; ++n) {
    const std::uint64_t seed = scatter(1, n);
    const int levels = 1 + static_cast<int>(n / 5 % 3);
    const double share = levels == 3 ? 0.001 : levels == 2 ? 0.01 : 0.06;
    const Grid grid = uniform_grid(grids[n % 5], {-0.37, 12.1, 0}, {0.1, 0.12, 0.11});
    const HexMesh mesh = smoothed(random_forest(grid.cells, levels, share, seed), grid);
    const std::string name = "case " + std::to_string(n);
    expect_sound(mesh, grid, name);
    EXPECT_GE(least_scaled_jacobian(mesh), 0.2) << name;
    poor += least_scaled_jacobian(mesh) < 0.3;
    least = std::min(least, least_scaled_jacobian(mesh));
  }
  std::printf("least scaled Jacobian of random cells: %.4f, below 0.3 in %d of %d\n", least, poor,
              static_cast<int>(kCases));
  EXPECT_LE(poor, 3);
}

}  // namespace
}  // namespace sculpt::test
