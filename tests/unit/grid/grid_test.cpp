#include "sculpt/grid/grid.hpp"

#include <gtest/gtest.h>

namespace sculpt {
namespace {

TEST(UniformGrid, HasPlanesAtMultiplesOfTheSize) {
  const Grid g = uniform_grid({3, 1, 2}, {10, 0, -1}, {0.5, 2, 0.1});
  EXPECT_EQ(g.planes[0], (std::vector<double>{10, 10.5, 11, 11.5}));
  EXPECT_EQ(g.planes[1], (std::vector<double>{0, 2}));
  EXPECT_EQ(g.planes[2], (std::vector<double>{-1, -1 + 0.1, -1 + 2 * 0.1}));
  EXPECT_EQ(g.cell_count(), 6);
  EXPECT_EQ(g.cell_size().x, 0.5);
}

TEST(BoxGrid, EndsOnTheCornersToTheLastBit) {
  const Vec3 lo{-0.1, 0.3, 1.0 / 3}, hi{0.7, 1e6 / 3, 2.0 / 3};
  for (std::int64_t n = 1; n < 60; ++n) {
    const Grid g = box_grid({n, n + 1, n + 2}, lo, hi);
    for (std::size_t d = 0; d < 3; ++d) {
      EXPECT_EQ(g.planes[d].front(), lo[d]);
      EXPECT_EQ(g.planes[d].back(), hi[d]);
      EXPECT_EQ(g.planes[d].size(), static_cast<std::size_t>(g.cells[d]) + 1);
      EXPECT_TRUE(std::is_sorted(g.planes[d].begin(), g.planes[d].end()));
    }
  }
}

TEST(Grid, NumbersCellsAndNodesXFastest) {
  const Grid g = uniform_grid({3, 4, 5}, {0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(g.cell_id({2, 3, 4}), 59);
  EXPECT_EQ(g.cell_id({1, 2, 0}), 7);
  EXPECT_EQ(g.node_id({3, 4, 5}), 119);
  EXPECT_EQ(g.node_id({0, 1, 0}), 4);
}

TEST(Grid, IdsGoBeyond32Bits) {
  Grid g;
  g.cells = {5000, 5000, 5000};
  EXPECT_EQ(g.cell_id({4999, 4999, 4999}), 124999999999);
  EXPECT_EQ(g.cell_count(), 125000000000);
}

TEST(IndexBox, PositionAndCellAreInverse) {
  const IndexBox box{{2, -1, 5}, {5, 3, 7}};
  EXPECT_EQ(box.size(), 24);
  for (std::int64_t p = 0; p < box.size(); ++p) {
    EXPECT_TRUE(box.contains(box.cell(p)));
    EXPECT_EQ(box.position(box.cell(p)), p);
  }
  EXPECT_EQ(box.cell(1), (Index3{3, -1, 5}));
  EXPECT_FALSE(box.contains({5, 0, 5}));
}

TEST(IndexBox, EmptyAndIntersection) {
  const IndexBox a{{0, 0, 0}, {4, 4, 4}}, b{{2, 3, -5}, {9, 9, 1}}, apart{{7, 7, 7}, {8, 8, 8}};
  EXPECT_EQ(intersection(a, b), (IndexBox{{2, 3, 0}, {4, 4, 1}}));
  EXPECT_TRUE(intersection(a, apart).empty());
  EXPECT_EQ(intersection(a, apart).size(), 0);
  EXPECT_TRUE(IndexBox{}.empty());
  EXPECT_EQ((IndexBox{{3, 0, 0}, {1, 2, 2}}).size(), 0);
  EXPECT_EQ(whole({3, 4, 5}).size(), 60);
}

}  // namespace
}  // namespace sculpt
