#include <gtest/gtest.h>

#include "sculpt/base/error.hpp"
#include "sculpt/distribute/cartesian.hpp"

namespace sculpt {
namespace {

Index3 segments(const Index3& cells, int ranks, const Index3& user = {0, 0, 0}) {
  return cut_grid(cells, ranks, user).segments;
}

// Splits that real Sculpt prints for these grids.
TEST(CutGrid, IsThatOfSculpt) {
  EXPECT_EQ(segments({26, 26, 26}, 10), (Index3{1, 2, 5}));
  EXPECT_EQ(segments({36, 20, 20}, 4), (Index3{2, 1, 2}));
  EXPECT_EQ(segments({16, 16, 16}, 2), (Index3{1, 1, 2}));
}

TEST(CutGrid, LongestPiecesComeFirst) {
  // 26 cells in 5 parts: rank 0 has 6 of them.
  const CartesianParts parts = cut_grid({26, 1, 1}, 5, {0, 0, 0});
  EXPECT_EQ(parts.segments, (Index3{5, 1, 1}));
  EXPECT_EQ(parts.owned(0).extent(0), 6);
  EXPECT_EQ(parts.cuts[0], (std::vector<std::int64_t>{0, 6, 11, 16, 21, 26}));
}

TEST(CutGrid, CutsTheLongAxis) {
  EXPECT_EQ(segments({100, 10, 10}, 4), (Index3{4, 1, 1}));
  EXPECT_EQ(segments({10, 100, 10}, 5), (Index3{1, 5, 1}));
  EXPECT_EQ(segments({8, 8, 8}, 8), (Index3{2, 2, 2}));
  EXPECT_EQ(segments({64, 64, 64}, 7), (Index3{1, 1, 7}));
}

TEST(CutGrid, ThinGridsAndPrimesUseWhatFits) {
  EXPECT_EQ(segments({9, 9, 1}, 3), (Index3{1, 3, 1}));
  EXPECT_EQ(segments({5, 1, 1}, 5), (Index3{5, 1, 1}));
  EXPECT_EQ(segments({3, 1, 1}, 7), (Index3{3, 1, 1})) << "the largest number of parts that fits";
  EXPECT_EQ(segments({2, 2, 1}, 7), (Index3{2, 2, 1}));
  EXPECT_EQ(segments({1, 1, 1}, 64), (Index3{1, 1, 1}));
  EXPECT_EQ(segments({3, 3, 3}, 5), (Index3{1, 2, 2})) << "5 has no factors up to 3";
}

TEST(CutGrid, EveryCellHasOneOwner) {
  for (const Index3 cells : {Index3{26, 26, 26}, Index3{7, 5, 3}, Index3{1, 9, 4}, Index3{2, 1, 1}})
    for (const int ranks : {1, 2, 3, 4, 5, 6, 7, 8, 13}) {
      const CartesianParts parts = cut_grid(cells, ranks, {0, 0, 0});
      std::int64_t sum = 0;
      for (int r = 0; r < ranks; ++r) {
        const IndexBox box = parts.owned(r);
        sum += box.size();
        for (std::int64_t p = 0; p < box.size(); ++p) ASSERT_EQ(parts.owner(box.cell(p)), r);
      }
      EXPECT_EQ(sum, cells[0] * cells[1] * cells[2]) << ranks << " ranks";
      EXPECT_LE(parts.segments[0] * parts.segments[1] * parts.segments[2], ranks);
    }
}

TEST(CutGrid, RanksBeyondTheSegmentsOwnNothing) {
  const CartesianParts parts = cut_grid({3, 1, 1}, 7, {0, 0, 0});
  for (int r = 3; r < 7; ++r) {
    EXPECT_TRUE(parts.owned(r).empty());
    EXPECT_TRUE(parts.ghosted(r, 2).empty());
  }
}

TEST(CutGrid, GhostLayersStopAtTheGrid) {
  const CartesianParts parts = cut_grid({8, 6, 4}, 2, {2, 1, 1});
  EXPECT_EQ(parts.owned(1), (IndexBox{{4, 0, 0}, {8, 6, 4}}));
  EXPECT_EQ(parts.ghosted(1, 2), (IndexBox{{2, 0, 0}, {8, 6, 4}}));
  EXPECT_EQ(parts.ghosted(0, 9), (IndexBox{{0, 0, 0}, {8, 6, 4}}));
}

TEST(CutGrid, FollowsTheUser) {
  EXPECT_EQ(segments({26, 26, 26}, 10, {10, 0, 0}), (Index3{10, 1, 1}));
  EXPECT_EQ(segments({26, 26, 26}, 10, {0, 5, 0}), (Index3{1, 5, 2}));
  EXPECT_EQ(segments({26, 26, 26}, 12, {2, 2, 3}), (Index3{2, 2, 3}));
}

TEST(CutGrid, RefusesWhatTheUserCannotHave) {
  for (const Index3 user : {Index3{3, 0, 0}, Index3{2, 2, 2}, Index3{0, 0, 10}}) {
    try {
      (void)cut_grid({26, 26, 5}, 10, user);
      ADD_FAILURE() << "nothing was thrown";
    } catch (const Error& e) {
      const std::string text = e.what();
      EXPECT_NE(text.find("iproc, jproc, kproc = "), std::string::npos) << text;
      EXPECT_NE(text.find("26 x 26 x 5 cells into 10 parts"), std::string::npos) << text;
    }
  }
}

}  // namespace
}  // namespace sculpt
