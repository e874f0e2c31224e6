#include "sculpt/adapt/leaf_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "sculpt/mesh/adjacency.hpp"
#include "support/cases.hpp"
#include "support/mesh_checks.hpp"

namespace sculpt {
namespace {

constexpr std::array<bool, 3> kNotPeriodic{false, false, false};

BlockParts alone(const Forest& forest) {
  const Index3 n = forest.blocks(0);
  return {n, {whole(n)}, std::vector<std::int32_t>(static_cast<std::size_t>(n[0] * n[1] * n[2]), 0)};
}

Grid unit_grid(const Index3& cells) { return uniform_grid(cells, {0, 0, 0}, {1, 1, 1}); }

// Pairs of hexes that share two faces or more.
int doublets(const HexMesh& mesh) {
  int count = 0;
  const FaceNeighbours neighbours = face_neighbours(mesh);
  for (LocalId h = 0; h < mesh.size(); ++h) {
    std::array<LocalId, 6> around = neighbours[at(h)];
    std::sort(around.begin(), around.end());
    for (std::size_t f = 1; f < 6; ++f) count += around[f] != kNone && around[f] == around[f - 1];
  }
  return count;
}

// All that must hold of the mesh of any closed forest; empty when it does.
std::string problem(const Forest& forest) {
  const Grid grid = unit_grid(forest.cells(0));
  const LeafMesh made = leaf_mesh(Comm::self(), grid, forest, alone(forest), 2);
  for (const std::string& p : {test::conformity_problem(made.cells, 0), test::boundary_problem(made.cells),
                               test::box_problem(made.cells, grid)})
    if (!p.empty()) return p;
  const double excess = test::volume(made.cells) - test::volume(grid);
  if (std::fabs(excess) > 1e-10 * test::volume(grid)) return "volume off by " + std::to_string(excess);
  if (doublets(made.cells) > 0) return "two hexes share two faces";
  for (LocalId h = 0; h < made.cells.size(); ++h)
    for (int side = 0; side < 6; ++side) {
      int faces = 0;
      for (int f = 0; f < 6; ++f) faces += face_sides(made.cells, h, f) >> side & 1;
      if (faces > 1) return "a hex has two faces on one side of the box";
    }
  return "";
}

TEST(LeafMesh, WithoutRefinementItIsTheGrid) {
  const Forest forest({5, 4, 3}, 1, kNotPeriodic);
  const LeafMesh made = leaf_mesh(Comm::self(), unit_grid({5, 4, 3}), forest, alone(forest), 2);
  EXPECT_EQ(made.cells.size(), 60);
  EXPECT_EQ(made.cells.nodes(), 6 * 5 * 4);
  EXPECT_EQ(problem(forest), "");
  EXPECT_EQ(test::least_scaled_jacobian(made.cells), 1);
}

TEST(LeafMesh, EverythingRefinedIsTheFineGrid) {
  for (const Index3& n : {Index3{4, 4, 4}, Index3{5, 3, 4}, Index3{1, 7, 2}, Index3{1, 1, 1}}) {
    Forest forest(n, 2, kNotPeriodic);
    for (int l = 0; l < 2; ++l)
      for (std::int64_t b = 0; b < whole(forest.blocks(l)).size(); ++b)
        forest.refine_block(l, whole(forest.blocks(l)).cell(b));
    EXPECT_EQ(forest.close(), 0);
    const LeafMesh made = leaf_mesh(Comm::self(), unit_grid(n), forest, alone(forest), 2);
    EXPECT_EQ(made.cells.size(), 64 * n[0] * n[1] * n[2]);
    EXPECT_EQ(problem(forest), "");
    EXPECT_EQ(test::least_scaled_jacobian(made.cells), 1);
    EXPECT_EQ(made.cells.colours, 8);
  }
}

TEST(LeafMesh, EveryPatternOfEightBlocks) {
  for (unsigned pattern = 1; pattern < 256; ++pattern) {
    Forest forest({8, 8, 8}, 1, kNotPeriodic);
    for (unsigned b = 0; b < 8; ++b)
      if (pattern >> b & 1) forest.refine_block(0, {1 + (b & 1), 1 + (b >> 1 & 1), 1 + (b >> 2)});
    forest.close();
    ASSERT_EQ(problem(forest), "") << "pattern " << pattern;
  }
}

TEST(LeafMesh, EveryPatternOfEightBlocksInACornerOfAnOddGrid) {
  for (unsigned pattern = 1; pattern < 256; ++pattern) {
    Forest forest({5, 5, 5}, 1, kNotPeriodic);
    for (unsigned b = 0; b < 8; ++b)
      if (pattern >> b & 1) forest.refine_block(0, {1 + (b & 1), 1 + (b >> 1 & 1), 1 + (b >> 2)});
    forest.close();
    ASSERT_EQ(problem(forest), "") << "pattern " << pattern;
  }
}

TEST(LeafMesh, RandomCellsOfSeveralLevels) {
  const std::vector<Index3> grids{{8, 8, 8}, {9, 7, 5}, {12, 1, 6}, {3, 2, 11}, {6, 6, 6}};
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Index3 n = grids[seed % grids.size()];
    const int levels = 1 + static_cast<int>(seed / 5 % 3);
    Forest forest(n, levels, kNotPeriodic);
    for (int l = 0; l < levels; ++l) {
      const IndexBox box = whole(forest.cells(l));
      const double share = l == levels - 1 ? 0.02 : 0.0;
      for (std::int64_t c = 0; c < box.size(); ++c)
        if (test::scatter_unit(seed, static_cast<std::uint64_t>(c)) < share)
          forest.refine_cell(l, box.cell(c));
    }
    forest.close();
    ASSERT_EQ(problem(forest), "") << "seed " << seed;
  }
}

TEST(LeafMesh, ShellsOfFourLevels) {
  for (const double radius : {1.3, 2.1, 2.9}) {
    Forest forest({6, 6, 6}, 3, kNotPeriodic);
    const IndexBox box = whole(forest.cells(2));
    for (std::int64_t c = 0; c < box.size(); ++c) {
      const Index3 i = box.cell(c);
      Vec3 x;
      for (std::size_t d = 0; d < 3; ++d) x[d] = (static_cast<double>(i[d]) + 0.5) / 4 - 3.1;
      if (std::fabs(norm(x) - radius) < 0.2) forest.refine_cell(2, i);
    }
    forest.close();
    EXPECT_EQ(problem(forest), "") << "radius " << radius;
  }
}

// Domains that end inside a cell of the grid: the cells there are refined until they fit.
TEST(LeafMesh, TheDomainMayEndInsideACell) {
  for (const Index3& finest : {Index3{7, 17, 28}, Index3{5, 1, 11}, Index3{13, 6, 3}, Index3{9, 9, 9}})
    for (const int levels : {1, 2, 3}) {
      const std::int64_t size = std::int64_t{1} << levels;
      Index3 cells, missing;
      Grid fine = uniform_grid(finest, {0, 0, 0}, {1, 1, 1});
      for (std::size_t d = 0; d < 3; ++d) {
        cells[d] = (finest[d] + size - 1) / size;
        missing[d] = cells[d] * size - finest[d];
      }
      Forest forest(cells, levels, kNotPeriodic, missing);
      if (levels < 3) forest.refine_cell(0, {0, 0, 0});
      forest.close();
      const double s = static_cast<double>(size);
      const LeafMesh made =
          leaf_mesh(Comm::self(), uniform_grid(cells, {0, 0, 0}, {s, s, s}), forest, alone(forest), 2,
                    Vec3{static_cast<double>(finest[0]), static_cast<double>(finest[1]),
                         static_cast<double>(finest[2])});
      ASSERT_EQ(test::conformity_problem(made.cells, 0), "");
      ASSERT_EQ(test::boundary_problem(made.cells), "");
      ASSERT_EQ(test::box_problem(made.cells, fine), "");
      EXPECT_NEAR(test::volume(made.cells), test::volume(fine), 1e-9);
      EXPECT_EQ(doublets(made.cells), 0);
    }
}

TEST(Forest, ClosingAddsTheCoarserLevelsAround) {
  Forest forest({8, 8, 8}, 2, kNotPeriodic);
  forest.refine_cell(1, {8, 8, 8});  // its block is cell (4,4,4) of the grid
  EXPECT_FALSE(forest.refined(0, {2, 2, 2}));
  EXPECT_GT(forest.close(), 0);
  EXPECT_TRUE(forest.refined(0, {2, 2, 2}));
  EXPECT_TRUE(forest.refined(0, {1, 2, 2}));  // cell (3,4,4) is beside it
  EXPECT_EQ(forest.close(), 0);
}

TEST(Forest, PeriodicAxesWrap) {
  Forest forest({8, 8, 8}, 2, {true, false, false});
  forest.refine_cell(1, {0, 8, 8});
  forest.close();
  EXPECT_TRUE(forest.refined(0, {3, 2, 2}));
  EXPECT_TRUE(forest.refined(0, {-1, 2, 2}));
  EXPECT_FALSE(forest.refined(0, {0, -1, 2}));
}

}  // namespace
}  // namespace sculpt
