#include "sculpt/adapt/forest.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "adapt/template_store.hpp"
#include "support/fields.hpp"

namespace sculpt::test {
namespace {

const Index3 kGrids[] = {{8, 8, 8}, {9, 7, 5}, {12, 1, 6}, {3, 2, 11}, {1, 1, 1}, {7, 1, 1}};

// The cells of a level around a cell, inside the grid.
std::vector<Index3> around(const Forest& forest, int level, const Index3& cell) {
  std::vector<Index3> cells;
  for (int o = 0; o < 27; ++o) {
    const Index3 c{cell[0] + o % 3 - 1, cell[1] + o / 3 % 3 - 1, cell[2] + o / 9 - 1};
    if (whole(forest.cells(level)).contains(c)) cells.push_back(c);
  }
  return cells;
}

// What close() promises; empty when it holds.
std::string problem(const Forest& forest) {
  for (int level = 0; level < forest.levels(); ++level) {
    const IndexBox blocks = whole(forest.blocks(level));
    for (std::int64_t b = 0; b < blocks.size(); ++b) {
      const Index3 block = blocks.cell(b);
      if (!forest.refined(level, block)) continue;
      if (level == 0) continue;
      for (const Index3& cell : around(forest, level - 1, block))  // the block is this cell, halved
        if (!forest.refined(level - 1, {cell[0] / 2, cell[1] / 2, cell[2] / 2}))
          return "a cell beside a refined one is coarser";
    }
  }
  std::string found;
  const IndexBox base = whole(forest.blocks(0));
  for (std::int64_t b = 0; b < base.size(); ++b)
    forest.for_each_leaf(base.cell(b), [&](int level, const Index3& block) {
      if (!transition_exists(forest.pattern(level, block), forest.ends(level, block)))
        found = "a leaf has no transition";
    });
  return found;
}

TEST(Forest, ClosedOnesKeepTheirPromises) {
  int grown = 0;
  for (const Index3& cells : kGrids)
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      const int levels = 1 + static_cast<int>(seed % 3);
      // Some end inside a cell.
      const Index3 missing{0, seed > 3 ? 1 : 0, seed == 5 ? (std::int64_t{1} << levels) - 1 : 0};
      Forest forest(cells, levels, kNotPeriodic, missing);
      const IndexBox box = whole(forest.cells(levels - 1));
      for (std::int64_t c = 0; c < box.size(); ++c)
        if (scatter_unit(seed, static_cast<std::uint64_t>(c)) < 0.02)
          forest.refine_cell(levels - 1, box.cell(c));
      const std::vector<std::uint64_t> asked(forest.words().begin(), forest.words().end());
      grown += forest.close() > 0;
      EXPECT_EQ(problem(forest), "") << "seed " << seed;
      for (std::size_t w = 0; w < asked.size(); ++w)
        EXPECT_EQ(forest.words()[w] & asked[w], asked[w]) << "a block that was asked for is missing";
      EXPECT_EQ(forest.close(), 0) << "closing again adds blocks";
    }
  EXPECT_GT(grown, 10);
}

// The result is the smallest closed set as the rules make it, in whatever order blocks were asked for.
TEST(Forest, ClosingInStepsIsClosingAtOnce) {
  Forest once({9, 8, 7}, 2, kNotPeriodic), in_steps = once;
  const IndexBox box = whole(once.cells(1));
  std::vector<std::int64_t> asked;
  for (std::int64_t c = 0; c < box.size(); ++c)
    if (scatter_unit(3, static_cast<std::uint64_t>(c)) < 0.004) asked.push_back(c);
  ASSERT_GT(asked.size(), 5U);
  for (const std::int64_t c : asked) once.refine_cell(1, box.cell(c));
  once.close();
  for (const std::int64_t c : asked) {
    in_steps.refine_cell(1, box.cell(c));
    in_steps.close();
  }
  EXPECT_TRUE(std::ranges::equal(once.words(), in_steps.words()));
}

TEST(Forest, LeavesFillTheGridOnce) {
  for (const Index3& cells : kGrids) {
    const Forest forest = random_forest(cells, 3, 0.01, 5);
    // In cells of the finest level.
    const IndexBox finest = whole(forest.cells(3)), base = whole(forest.blocks(0));
    std::vector<int> covered(static_cast<std::size_t>(finest.size()), 0);
    for (std::int64_t b = 0; b < base.size(); ++b)
      forest.for_each_leaf(base.cell(b), [&](int level, const Index3& block) {
        const std::int64_t edge = std::int64_t{2} << (3 - level);
        IndexBox box;
        for (std::size_t d = 0; d < 3; ++d) {
          box.lo[d] = block[d] * edge;
          box.hi[d] = box.lo[d] + edge;
        }
        box = intersection(box, finest);
        for (std::int64_t c = 0; c < box.size(); ++c)
          ++covered[static_cast<std::size_t>(finest.position(box.cell(c)))];
      });
    EXPECT_TRUE(std::all_of(covered.begin(), covered.end(), [](int n) { return n == 1; }));
  }
}

TEST(Forest, LastBlocksOfOddAxesEndAtTheirMiddle) {
  const Forest forest({5, 4, 3}, 2, kNotPeriodic);
  EXPECT_EQ(forest.blocks(0), (Index3{3, 2, 2}));
  EXPECT_EQ(forest.blocks(1), (Index3{5, 4, 3}));
  EXPECT_EQ(forest.ends(0, {2, 1, 1}), 5U);
  EXPECT_EQ(forest.ends(0, {1, 1, 0}), 0U);
  EXPECT_EQ(forest.ends(1, {4, 3, 2}), 0U);
}

// Beyond the middle plane of the last block lies the mirror image of what is before it.
TEST(Forest, OddEndsAreMirrors) {
  Forest forest({5, 4, 4}, 1, kNotPeriodic);
  forest.refine_block(0, {1, 0, 0});
  EXPECT_TRUE(forest.refined(0, {3, 0, 0}));
  EXPECT_FALSE(forest.refined(0, {2, 0, 0}));
  EXPECT_FALSE(forest.refined(0, {-1, 0, 0}));
  EXPECT_EQ(forest.pattern(0, {2, 0, 0}), 3U);  // -x and +x
}

TEST(Forest, RanksAddTheirWords) {
  Forest a({8, 8, 8}, 2, kNotPeriodic), b = a, both = a;
  a.refine_cell(1, {3, 4, 5});
  b.refine_cell(0, {7, 0, 2});
  both.refine_cell(1, {3, 4, 5});
  both.refine_cell(0, {7, 0, 2});
  for (std::size_t w = 0; w < a.words().size(); ++w) a.words()[w] |= b.words()[w];
  EXPECT_TRUE(std::ranges::equal(a.words(), both.words()));
}

}  // namespace
}  // namespace sculpt::test
