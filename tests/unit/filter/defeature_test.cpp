#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "sculpt/filter/filter.hpp"
#include "support/mesh_checks.hpp"
#include "support/stages.hpp"

namespace sculpt {
namespace {

using test::Overlay;

FilterReport filter(Overlay& o, const FilterOptions& options) {
  return filter_materials(o.cells, o.fractions, face_neighbours(o.cells), NodeHexes(o.cells), options);
}
FilterOptions defeaturing() {
  FilterOptions o;
  o.defeature = true;
  return o;
}

// A grid of material 0 with the given cells of material 1 (and 2 where `other` lists them).
Overlay particles(const Index3& cells, const std::set<std::vector<std::int64_t>>& one,
                  const std::set<std::vector<std::int64_t>>& two = {}) {
  return test::overlay(test::voxels("particles", cells, 3, [&](const Index3& c) -> std::int32_t {
    const std::vector<std::int64_t> key(c.begin(), c.end());
    return one.contains(key) ? 1 : two.contains(key) ? 2 : 0;
  }));
}
std::int64_t count(const Overlay& o, std::int32_t material) {
  return std::count(o.cells.material.begin(), o.cells.material.end(), material);
}

TEST(Shave, ReassignsLoneCellsOnTheBoxOnly) {
  // A lone cell of 2 inside, one in a side, one in a corner, a pair of 1 in another side; all else 0.
  Overlay o = particles({5, 5, 5}, {{0, 2, 4}, {0, 3, 4}}, {{2, 2, 2}, {4, 2, 2}, {0, 0, 0}});
  FilterOptions options;
  options.shave_to = 0;
  EXPECT_EQ(filter(o, options).shaved, 2);
  EXPECT_EQ(count(o, 1), 2);
  EXPECT_EQ(count(o, 2), 1);
  EXPECT_EQ(o.cells.material[2 + 5 * (2 + 5 * 2)], 2);
  EXPECT_EQ(filter(o, options).shaved, 0) << "cells that have the material already are left";
}

TEST(Shave, JudgesAllCellsBeforeItChangesAny) {
  // Alternating row: every cell is alone, whichever is looked at first.
  FilterOptions options;
  options.shave_to = 0;
  Overlay row = test::overlay(test::voxels({6, 1, 1}, {1, 2, 1, 2, 1, 2}));
  EXPECT_EQ(filter(row, options).shaved, 6);
  Overlay one = test::overlay(test::voxels({1, 1, 1}, {2}));
  EXPECT_EQ(filter(one, options).shaved, 0) << "a grid of one cell has no neighbours";
}

TEST(Islands, OfFewerCellsThanAskedForGo) {
  // A plate of 4 cells and a block of 2x2x2 of material 1, all with three other faces at most.
  std::set<std::vector<std::int64_t>> one{{1, 1, 1}, {2, 1, 1}, {1, 2, 1}, {2, 2, 1}};
  for (std::int64_t i : {5, 6})
    for (std::int64_t j : {5, 6})
      for (std::int64_t k : {5, 6}) one.insert({i, j, k});
  FilterOptions options = defeaturing();
  for (const std::int64_t least : {1, 8, 9}) {
    Overlay o = particles({9, 9, 9}, one);
    options.min_vol_cells = least;
    const FilterReport report = filter(o, options);
    // Without being an island the plate goes as well: its cells have four faces outwards.
    EXPECT_EQ(report.islands, least == 1 ? 0 : least == 8 ? 1 : 2);
    EXPECT_EQ(count(o, 1), least < 9 ? 8 : 0);
    EXPECT_TRUE(report.settled);
  }
}

TEST(Islands, TakeTheMaterialWithMostFaces) {
  // A lone cell of 2 in a wall between 0 and 1: four faces to 1, one to 0 and one to 1.
  Overlay o = test::overlay(test::voxels("wall", {5, 5, 5}, 3, [](const Index3& c) -> std::int32_t {
    if (c == Index3{2, 2, 2}) return 2;
    return c[0] >= 2 ? 1 : 0;
  }));
  filter(o, defeaturing());
  EXPECT_EQ(count(o, 2), 0);
  EXPECT_EQ(count(o, 1), 3 * 25);
}

TEST(Islands, AlsoWhenEverythingIsSmall) {
  // Eight cells of eight materials: all are islands, one of them must win in the end.
  Overlay o = test::overlay(test::voxels({2, 2, 2}, {0, 1, 2, 3, 4, 5, 6, 7}));
  const FilterReport report = filter(o, defeaturing());
  const std::set<std::int32_t> left(o.cells.material.begin(), o.cells.material.end());
  EXPECT_EQ(left.size(), 1U);
  EXPECT_TRUE(report.settled);
}

TEST(Protrusions, FourForeignFacesGo) {
  // A plate of 1 with a lone cell on top (five foreign faces) and a row of two (four and five).
  std::set<std::vector<std::int64_t>> one;
  for (std::int64_t i = 0; i < 8; ++i)
    for (std::int64_t j = 0; j < 8; ++j)
      for (std::int64_t k = 0; k < 3; ++k) one.insert({i, j, k});
  const auto flat = static_cast<std::int64_t>(one.size());
  one.insert({2, 2, 3});
  one.insert({5, 5, 3});
  one.insert({6, 5, 3});
  Overlay o = particles({8, 8, 8}, one);
  const FilterReport report = filter(o, defeaturing());
  EXPECT_EQ(count(o, 1), flat);
  EXPECT_EQ(report.protrusions, 3);
}

TEST(Protrusions, AStepWithThreeForeignFacesStays) {
  std::set<std::vector<std::int64_t>> one;  // a block of 3x3x3: corners have three foreign faces
  for (std::int64_t i : {2, 3, 4})
    for (std::int64_t j : {2, 3, 4})
      for (std::int64_t k : {2, 3, 4}) one.insert({i, j, k});
  Overlay o = particles({7, 7, 7}, one);
  const FilterReport report = filter(o, defeaturing());
  EXPECT_EQ(count(o, 1), 27);
  EXPECT_EQ(report.protrusions, 0);
  EXPECT_EQ(report.rounds, 1);
}

TEST(Protrusions, CountTheBoxWhereAskedFor) {
  // A bar one cell wide in an edge of the box, with its end inside: own faces 1 or 2, other ones 2 or 3,
  // box 2.
  std::set<std::vector<std::int64_t>> one;
  for (std::int64_t k = 0; k < 8; ++k) one.insert({0, 0, k});
  Overlay inside = particles({6, 6, 12}, one), box = particles({6, 6, 12}, one);
  FilterOptions options = defeaturing();
  filter(inside, options);
  EXPECT_EQ(count(inside, 1), 8) << "three other faces at most";
  options.defeature_box = true;
  filter(box, options);
  EXPECT_EQ(count(box, 1), 0)
      << "its end has three faces to the other material, one of its own, two on the box";
}

TEST(Protrusions, StayWhereNoMaterialHasMoreFaces) {
  // Two faces of its own, four of four other materials: no change makes the interfaces smaller.
  Overlay o = test::overlay(test::voxels("cross", {5, 5, 9}, 5, [](const Index3& c) -> std::int32_t {
    if (c[0] == 2 && c[1] == 2) return 0;
    return c[0] < 2 ? 1 : c[0] > 2 ? 2 : c[1] < 2 ? 3 : 4;
  }));
  const FilterReport report = filter(o, defeaturing());
  EXPECT_EQ(report.protrusions, 0);
  EXPECT_EQ(count(o, 0), 9);
}

TEST(Defeature, IsIdempotent) {
  for (const test::Case& input :
       {test::grains({14, 13, 12}, 60, 60, 3), test::noise({10, 11, 12}, 2, 5),
        test::noise({10, 10, 10}, 20, 6), test::two_phase_fractions({12, 9, 10}, 7)}) {
    Overlay o = test::overlay(input);
    FilterOptions options = defeaturing();
    options.defeature_rounds = 40;
    const FilterReport first = filter(o, options);
    ASSERT_TRUE(first.settled) << input.name;
    EXPECT_GT(first.island_cells + first.protrusions, 0) << input.name;
    const std::vector<std::int32_t> material = o.cells.material;
    const FilterReport again = filter(o, options);
    EXPECT_EQ(again.rounds, 1) << input.name;
    EXPECT_EQ(o.cells.material, material) << input.name;
  }
}

// A bar of 2 stands on a wall of 1; width: cells across.
Overlay bar_on_wall(std::int64_t width) {
  return test::overlay(test::voxels("bar", {8, 7, 7}, 3, [=](const Index3& c) -> std::int32_t {
    if (c[0] < 3) return 1;
    return c[0] < 6 && c[1] >= 3 && c[1] < 3 + width && c[2] == 3 ? 2 : 0;
  }));
}

TEST(Collapse, RemovesAContactInOneFace) {
  Overlay o = bar_on_wall(1), untouched = bar_on_wall(1);
  FilterOptions options;
  EXPECT_EQ(filter(untouched, options).collapses, 0) << "not asked for";
  options.collapse = true;
  const FilterReport report = filter(o, options);
  EXPECT_EQ(report.collapses, 1);
  EXPECT_TRUE(report.settled);
  std::vector<std::int32_t> expected = untouched.cells.material;
  expected[3 + 8 * (3 + 7 * 3)] = 0;
  EXPECT_EQ(o.cells.material, expected) << "the foot of the bar, and nothing else";
  EXPECT_EQ(filter(o, options).collapses, 0);
}

TEST(Collapse, LeavesAContactInTwoFaces) {
  Overlay o = bar_on_wall(2);
  FilterOptions options;
  options.collapse = true;
  EXPECT_EQ(filter(o, options).collapses, 0);
}

TEST(Filter, DoesTheSameWhateverTheOrderOfCorners) {
  std::vector<FilterOptions> all(4, defeaturing());
  all[1].defeature = false;
  all[1].collapse = true;
  all[2].collapse = all[2].reversals = all[2].defeature_box = true;
  all[3].collapse = true;
  all[3].keep_materials = 60;
  for (const FilterOptions& options : all)
    for (const test::Case& input : {test::grains({13, 12, 11}, 150, 60, 5), test::noise({9, 8, 7}, 4, 6),
                                    test::grains({9, 9, 1}, 20, 7, 7)}) {
      Overlay o = test::overlay(input), turned = test::overlay(input);
      turned.cells = test::turned(turned.cells);
      ASSERT_GT(test::least_scaled_jacobian(turned.cells), 0.99);
      const FilterReport a = filter(o, options), b = filter(turned, options);
      EXPECT_EQ(o.cells.material, turned.cells.material) << input.name;
      EXPECT_EQ(a.collapses, b.collapses);
      EXPECT_EQ(a.reversals, b.reversals);
    }
}

TEST(Collapse, IsIdempotent) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    Overlay o = test::overlay(test::grains({13, 12, 11}, 150, 150, seed));
    FilterOptions options;
    options.collapse = true;
    EXPECT_GT(filter(o, options).collapses, 0) << seed;
    const std::vector<std::int32_t> material = o.cells.material;
    EXPECT_TRUE(interfaces_are_manifold(o.cells, face_neighbours(o.cells), NodeHexes(o.cells)));
    EXPECT_EQ(filter(o, options).collapses, 0) << seed;
    EXPECT_EQ(o.cells.material, material) << seed;
  }
}

TEST(Collapse, SparesLockedCells) {
  Overlay o = test::overlay(test::grains({13, 12, 11}, 300, 300, 4));
  const std::set<std::int32_t> before(o.cells.material.begin(), o.cells.material.end());
  FilterOptions options;
  options.collapse = true;
  options.keep_materials = 300;
  EXPECT_GT(filter(o, options).collapses, 0);
  EXPECT_EQ(std::set<std::int32_t>(o.cells.material.begin(), o.cells.material.end()), before);
}

TEST(KeepMaterials, LeavesNoneWithoutACell) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const test::Case input = test::grains({12, 12, 12}, 300, 300, seed);
    Overlay lost = test::overlay(input), kept = test::overlay(input);
    const std::set<std::int32_t> before(kept.cells.material.begin(), kept.cells.material.end());
    FilterOptions options = defeaturing();
    filter(lost, options);
    options.keep_materials = 300;
    filter(kept, options);
    const std::set<std::int32_t> without(lost.cells.material.begin(), lost.cells.material.end()),
        with(kept.cells.material.begin(), kept.cells.material.end());
    EXPECT_LT(without.size(), before.size());
    EXPECT_EQ(with, before);
    EXPECT_TRUE(interfaces_are_manifold(kept.cells, face_neighbours(kept.cells), NodeHexes(kept.cells)));
  }
}

TEST(KeepMaterials, GivesACellToAMaterialThatHasMostOfNone) {
  test::Case input = test::voxels({5, 1, 1}, {0, 0, 0, 0, 0});
  input.materials = 2;
  input.fill = [](const Index3& c, Fractions& f) {
    f.add(0, c[0] == 3 ? 0.7 : 1.0);
    if (c[0] == 3) f.add(1, 0.3);
  };
  Overlay o = test::overlay(input);
  FilterOptions options;
  options.keep_materials = 2;
  filter(o, options);
  EXPECT_EQ(o.cells.material, (std::vector<std::int32_t>{0, 0, 0, 1, 0}));
}

// Four of the eight cells at a node, one after another along x, y and z: manifold, but in y the interface
// faces both ways.
TEST(Reversals, OfATwistedPathAreRemovedWhereAskedFor) {
  const auto twisted = [](const Index3& c) -> std::int32_t {
    const std::int64_t octant = c[0] / 2 | (c[1] / 2) << 1 | (c[2] / 2) << 2;
    return octant == 0 || octant == 1 || octant == 3 || octant == 7;
  };
  Overlay left = test::overlay(test::voxels("twisted", {4, 4, 4}, 2, twisted)), gone = left;
  FilterOptions options;
  EXPECT_EQ(filter(left, options).manifold_cells, 0);
  options.reversals = true;
  const FilterReport report = filter(gone, options);
  EXPECT_GT(report.reversals, 0);
  EXPECT_GT(report.manifold_cells + (gone.cells.material != left.cells.material), 0);
  EXPECT_NE(gone.cells.material, left.cells.material);
  EXPECT_TRUE(interfaces_are_manifold(gone.cells, face_neighbours(gone.cells), NodeHexes(gone.cells)));
  EXPECT_EQ(filter(gone, options).reversals, 0) << "none is left";
}

TEST(Reversals, AStaircaseHasNone) {
  Overlay flat = test::overlay(test::voxels(
      "stairs", {5, 5, 5}, 2, [](const Index3& c) -> std::int32_t { return c[0] + c[1] + c[2] < 7; }));
  const std::vector<std::int32_t> before = flat.cells.material;
  FilterOptions options;
  options.reversals = true;
  EXPECT_EQ(filter(flat, options).reversals, 0);
  EXPECT_EQ(flat.cells.material, before);
}

}  // namespace
}  // namespace sculpt
