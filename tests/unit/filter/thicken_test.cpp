#include <gtest/gtest.h>

#include <algorithm>

#include "sculpt/filter/thicken.hpp"
#include "sculpt/vfrac/fractions.hpp"
#include "support/stages.hpp"

namespace sculpt {
namespace {

using test::Overlay;

void thicken(Overlay& o, std::int32_t material, double value) {
  sculpt::thicken(o.cells, o.fractions, face_neighbours(o.cells), NodeHexes(o.cells), material, value);
}
Overlay half(std::int64_t first_of_one) {
  return test::overlay(test::voxels(
      "half", {6, 5, 5}, 2, [=](const Index3& c) -> std::int32_t { return c[0] >= first_of_one ? 1 : 0; }));
}
LocalId cell(std::int64_t i, std::int64_t j, std::int64_t k) {
  return static_cast<LocalId>(i + 6 * (j + 5 * k));
}

TEST(Thicken, AddsTheValueBesideAFlatInterface) {
  Overlay o = half(3);
  thicken(o, 1, 0.2);
  EXPECT_DOUBLE_EQ(fraction_of(o.fractions, cell(2, 2, 2), 1), 0.2);
  EXPECT_DOUBLE_EQ(fraction_of(o.fractions, cell(2, 2, 2), 0), 0.8);
  EXPECT_DOUBLE_EQ(fraction_of(o.fractions, cell(1, 2, 2), 1), 0) << "not beyond the neighbours";
  EXPECT_DOUBLE_EQ(fraction_of(o.fractions, cell(3, 2, 2), 1), 1) << "its own cells are full";
  EXPECT_EQ(std::count(o.cells.material.begin(), o.cells.material.end(), 1), 75) << "0.2 moves no cell";
  Overlay more = half(3);
  thicken(more, 1, 0.6);
  EXPECT_EQ(std::count(more.cells.material.begin(), more.cells.material.end(), 1), 100)
      << "0.6 moves a layer";
}

TEST(Thicken, KeepsTheSumOfFractionsAndTheRatioOfTheOthers) {
  test::Case input = test::voxels({3, 1, 1}, {0, 0, 0});
  input.materials = 3;
  input.fill = [](const Index3& c, Fractions& f) {
    if (c[0] == 2) {
      f.add(2, 1);
    } else {
      f.add(0, 0.6);
      f.add(1, 0.3);
      f.add(2, 0.1);
    }
  };
  Overlay o = test::overlay(input);
  thicken(o, 2, 0.1);
  const double gained = fraction_of(o.fractions, 1, 2) - 0.1;
  EXPECT_GT(gained, 0.05);
  EXPECT_NEAR(fraction_of(o.fractions, 1, 0) / fraction_of(o.fractions, 1, 1), 2, 1e-12);
  EXPECT_NEAR(
      fraction_of(o.fractions, 1, 0) + fraction_of(o.fractions, 1, 1) + fraction_of(o.fractions, 1, 2), 1,
      1e-12);
  thicken(o, 2, 1);
  EXPECT_LE(fraction_of(o.fractions, 1, 2), 1);
}

TEST(Thicken, FillsNotchesFirst) {
  // A plane of 1 with a notch of one cell.
  Overlay o = test::overlay(test::voxels("notch", {6, 5, 5}, 2, [](const Index3& c) -> std::int32_t {
    return c[0] >= 3 && c != Index3{3, 2, 2} ? 1 : 0;
  }));
  thicken(o, 1, 0.3);
  EXPECT_EQ(o.cells.material[at(cell(3, 2, 2))], 1);
  EXPECT_EQ(std::count(o.cells.material.begin(), o.cells.material.end(), 1), 75);
}

TEST(SeparateByVoid, LeavesAGapBetweenMaterials) {
  for (const bool both : {false, true}) {
    Overlay o = test::overlay(test::grains({9, 9, 9}, 7, 6, 5));
    for (std::int32_t& m : o.cells.material) m += 1;  // 0 is the void, and not there yet
    const std::int64_t emptied = separate_by_void(o.cells, o.fractions, NodeHexes(o.cells), 0, both);
    EXPECT_GT(emptied, 0);
    EXPECT_EQ(std::count(o.cells.material.begin(), o.cells.material.end(), 0), emptied);
    const NodeHexes around(o.cells);
    for (LocalId n = 0; n < o.cells.nodes(); ++n) {
      std::int32_t found = 0;
      for (const std::int32_t item : around[n]) {
        const std::int32_t m = o.cells.material[at(item / 8)];
        EXPECT_TRUE(m == 0 || found == 0 || m == found) << "two materials at a node";
        if (m != 0) found = m;
      }
    }
    EXPECT_EQ(separate_by_void(o.cells, o.fractions, around, 0, both), 0) << "nothing is left to do";
  }
}

}  // namespace
}  // namespace sculpt
