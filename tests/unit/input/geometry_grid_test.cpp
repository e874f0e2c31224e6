#include "input/geometry_grid.hpp"

#include <gtest/gtest.h>

#include "sculpt/base/error.hpp"

namespace sculpt {
namespace {

const Box kGeometry{{1, -2, 0}, {3, 2, 10}};  // 2 x 4 x 10

Deck counts(std::int64_t nx, std::int64_t ny, std::int64_t nz) {
  Deck deck;
  deck.nelx = nx;
  deck.nely = ny;
  deck.nelz = nz;
  for (const char* name : {"nelx", "nely", "nelz"}) deck.given_options.add(name, "test");
  return deck;
}
Deck size(double h) {
  Deck deck;
  deck.cell_size = h;
  deck.given_options.add("cell_size", "test");
  return deck;
}
template <class T>
void give(Deck& deck, const char* name, T Deck::*slot, T value) {
  deck.*slot = value;
  deck.given_options.add(name, "test");
}
Grid grid(const Deck& deck) { return geometry_grid(deck, "stl_file", kGeometry); }
std::string error_of(const Deck& deck) {
  try {
    (void)grid(deck);
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

TEST(GeometryGrid, LeavesTwoAndAHalfCellsBesideTheGeometry) {
  const Grid g = grid(counts(10, 25, 3));
  EXPECT_EQ(g.cells, (Index3{10, 25, 3}));
  EXPECT_NEAR(g.cell_size().x, 2.0 / 5, 1e-12);
  EXPECT_NEAR(g.planes[0].front(), 1 - 2.5 * 0.4, 1e-12);
  EXPECT_NEAR(g.planes[0].back(), 3 + 2.5 * 0.4, 1e-12);
  EXPECT_NEAR(g.planes[1].front(), -2.5, 1e-12);
  EXPECT_NEAR(g.planes[2].front(), -1, 1e-12) << "too few cells: a tenth of the size";
  EXPECT_NEAR(g.planes[2].back(), 11, 1e-12);
}

TEST(GeometryGrid, KeepsEveryGivenBoundToTheLastBit) {
  Deck deck = counts(10, 10, 10);
  give(deck, "xmin", &Deck::xmin, 0.1);
  give(deck, "ymax", &Deck::ymax, 0.3);
  give(deck, "zmin", &Deck::zmin, -0.7);
  give(deck, "zmax", &Deck::zmax, 1.1);
  const Grid by_counts = grid(deck);
  EXPECT_EQ(by_counts.planes[0].front(), 0.1);
  EXPECT_GT(by_counts.planes[0].back(), 3);
  EXPECT_LT(by_counts.planes[1].front(), -2);
  EXPECT_EQ(by_counts.planes[1].back(), 0.3);
  EXPECT_EQ(by_counts.planes[2].front(), -0.7);
  EXPECT_EQ(by_counts.planes[2].back(), 1.1);
  give(deck, "cell_size", &Deck::cell_size, 0.07);
  const Grid by_size = grid(deck);
  EXPECT_EQ(by_size.planes[0].front(), 0.1);
  EXPECT_EQ(by_size.planes[1].back(), 0.3);
  EXPECT_EQ(by_size.planes[2].front(), -0.7);
  EXPECT_EQ(by_size.planes[2].back(), 1.1);
  EXPECT_EQ(by_size.cells[2], 26) << "1.8 / 0.07 = 25.7";
  EXPECT_NEAR(by_size.cell_size().x, 0.07, 1e-12);
  EXPECT_NEAR(by_size.cell_size().z, 1.8 / 26, 1e-12);
}

TEST(GeometryGrid, OfACellSizeHasFiveCellsMoreThanTheGeometry) {
  const Grid g = grid(size(0.3));
  EXPECT_EQ(g.cells, (Index3{7 + 5, 13 + 5, 33 + 5}));
  for (std::size_t d = 0; d < 3; ++d) {
    EXPECT_NEAR(g.cell_size()[d], 0.3, 1e-12);
    EXPECT_NEAR(g.planes[d].front() + g.planes[d].back(), kGeometry.lo[d] + kGeometry.hi[d], 1e-12)
        << "centred";
  }
}

TEST(GeometryGrid, OfACellSizeReachesFromAGivenBoundBeyondTheGeometry) {
  Deck deck = size(0.5);
  give(deck, "xmin", &Deck::xmin, 0.0);
  give(deck, "ymax", &Deck::ymax, 5.0);
  const Grid g = grid(deck);
  EXPECT_EQ(g.cells[0], 6 + 3);
  EXPECT_EQ(g.planes[0].front(), 0);
  EXPECT_NEAR(g.planes[0].back(), 4.5, 1e-12);
  EXPECT_EQ(g.cells[1], 14 + 3);
  EXPECT_EQ(g.planes[1].back(), 5);
  EXPECT_NEAR(g.planes[1].front(), -3.5, 1e-12);
}

TEST(GeometryGrid, GrowsByTheShareThatIsAskedFor) {
  Deck deck = counts(10, 10, 10);
  give(deck, "bbox_expand", &Deck::bbox_expand, 25.0);
  const Grid g = grid(deck);
  EXPECT_NEAR(g.planes[0].front(), 0.5, 1e-12);
  EXPECT_NEAR(g.planes[2].back(), 12.5, 1e-12);
  deck.bbox_expand = 0;
  EXPECT_EQ(grid(deck).planes[1].front(), -2);
  Deck cubes = size(0.5);
  give(cubes, "bbox_expand", &Deck::bbox_expand, 10.0);
  EXPECT_EQ(grid(cubes).cells, (Index3{5, 10, 24}));  // 2.4, 4.8 and 12 long
}

TEST(GeometryGrid, TellsWhatIsMissingOrWrong) {
  EXPECT_EQ(error_of({}), "stl_file needs a grid: expected cell_size, or nelx, nely and nelz");
  EXPECT_NE(error_of(counts(3, 0, 3)).find("stl_file needs nely, found 0"), std::string::npos);
  EXPECT_EQ(error_of(size(0)), "cell_size = 0, expected a size > 0");
  EXPECT_NE(error_of(size(1e-12)).find("more cells than can be numbered"), std::string::npos);
  Deck deck = counts(3, 3, 3);
  give(deck, "xmin", &Deck::xmin, 4.0);
  EXPECT_EQ(error_of(deck), "xmin = 4 lies beyond the geometry, which reaches from 1 to 3");
  give(deck, "xmax", &Deck::xmax, 3.5);
  EXPECT_EQ(error_of(deck), "xmin = 4, xmax = 3.5: expected xmin < xmax");
  EXPECT_THROW(
      {
        try {
          (void)geometry_grid(counts(3, 3, 3), "stl_file", {{0, 0, 2}, {1, 1, 2}});
        } catch (const Error& e) {
          EXPECT_STREQ(e.what(), "the geometry is flat: in z it reaches from 2 to 2");
          throw;
        }
      },
      Error);
}

}  // namespace
}  // namespace sculpt
