#include "sculpt/adapt/criteria.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/fields.hpp"

namespace sculpt::test {
namespace {

// What the criterion asks for, before anything else follows from it.
Forest asked(const Grid& grid, int levels, MaterialField& field, const AdaptCriterion& criterion) {
  Forest forest(grid.cells, levels, kNotPeriodic);
  mark_cells(grid, whole(grid.cells), field, criterion, forest);
  return forest;
}

AdaptCriterion fractions(double threshold) {
  AdaptCriterion c;
  c.threshold = threshold;
  return c;
}

std::vector<Index3> refined_blocks(const Forest& forest, int level) {
  std::vector<Index3> blocks;
  const IndexBox all = whole(forest.blocks(level));
  for (std::int64_t b = 0; b < all.size(); ++b)
    if (forest.refined(level, all.cell(b))) blocks.push_back(all.cell(b));
  return blocks;
}
std::size_t count(const Forest& forest, int level) { return refined_blocks(forest, level).size(); }

// Blocks of level 0 whose first index is one of these.
std::vector<Index3> layers(const Forest& forest, const std::vector<std::int64_t>& along_x) {
  std::vector<Index3> blocks;
  const IndexBox all = whole(forest.blocks(0));
  for (std::int64_t b = 0; b < all.size(); ++b)
    if (std::ranges::count(along_x, all.cell(b)[0]) > 0) blocks.push_back(all.cell(b));
  return blocks;
}

Box cell_box(const Index3& cell, int level) {
  const double h = std::ldexp(1.0, -level);
  const Vec3 lo{h * static_cast<double>(cell[0]), h * static_cast<double>(cell[1]),
                h * static_cast<double>(cell[2])};
  return {lo, lo + Vec3{h, h, h}};
}

double share_in(MaterialField& field, const Box& box, std::int32_t material) {
  Fractions f;
  field.measure(box, f);
  for (std::size_t e = 0; e < f.material.size(); ++e)
    if (f.material[e] == material) return f.value[e];
  return 0;
}

// Largest difference of the eight parts of a cell from their average; two materials.
double parts_differ(MaterialField& field, const Box& box) {
  std::array<double, 8> part{};
  double mean = 0, most = 0;
  for (unsigned o = 0; o < 8; ++o) {
    Box b = box;
    for (std::size_t d = 0; d < 3; ++d) (o >> d & 1 ? b.lo[d] : b.hi[d]) = 0.5 * (box.lo[d] + box.hi[d]);
    part[o] = share_in(field, b, 1);
    mean += 0.125 * part[o];
  }
  for (const double p : part) most = std::max(most, std::fabs(p - mean));
  return most;
}

// A plane through the cells between x = 3 and 4: their parts hold 0.4 and 1 of material 1, 0.3 off their
// average.
TEST(FractionsCriterion, ComparesThePartsWithTheirAverage) {
  const Grid grid = unit_grid({8, 4, 4});
  const auto field = half_space_field(0, 3.3);
  for (const double threshold : {0.0, 1e-4, 0.29}) {
    const Forest forest = asked(grid, 1, *field, fractions(threshold));
    EXPECT_EQ(refined_blocks(forest, 0), layers(forest, {1})) << threshold;
  }
  EXPECT_EQ(count(asked(grid, 1, *field, fractions(0.31)), 0), 0U);
}

// Between cells of two blocks, and between the two of one.
TEST(FractionsCriterion, RefinesBothSidesOfFacesOfCells) {
  const Grid grid = unit_grid({8, 4, 4});
  const Case data = voxels("halves", {8, 4, 4}, 2, [](const Index3& c) { return c[0] < 4 ? 0 : 1; });
  const auto voxel = data_field_of(data), plane = half_space_field(0, 4), inside = half_space_field(0, 3);
  for (MaterialField* field : {voxel.get(), plane.get()}) {
    for (const double threshold : {0.0, 1e-4, 0.99}) {
      const Forest forest = asked(grid, 1, *field, fractions(threshold));
      EXPECT_EQ(refined_blocks(forest, 0), layers(forest, {1, 2})) << threshold;
    }
    EXPECT_EQ(count(asked(grid, 1, *field, fractions(1)), 0), 0U);
  }
  const Forest forest = asked(grid, 1, *inside, fractions(1e-4));
  EXPECT_EQ(refined_blocks(forest, 0), layers(forest, {1}));
}

// Cells that touch along an edge or at a corner only.
TEST(FractionsCriterion, RefinesAroundEdgesAndCorners) {
  const auto with_corner = [](std::int64_t k) {
    return voxels("corner", {8, 8, 8}, 2,
                  [k](const Index3& c) { return c[0] < 4 && c[1] < 4 && c[2] < k ? 1 : 0; });
  };
  const Grid grid = unit_grid({8, 8, 8});
  const auto edge = data_field_of(with_corner(8)), corner = data_field_of(with_corner(4));
  EXPECT_TRUE(asked(grid, 1, *edge, fractions(0.5)).refined(0, {2, 2, 0}));
  EXPECT_TRUE(asked(grid, 1, *corner, fractions(0.5)).refined(0, {2, 2, 2}));
  EXPECT_FALSE(asked(grid, 1, *corner, fractions(0.5)).refined(0, {3, 3, 3}));
}

TEST(FractionsCriterion, HalvesEveryCellWhosePartsDiffer) {
  const Grid grid = unit_grid({9, 8, 7});
  const auto field = balls_field(grid, {{{4.3, 3.9, 3.6}, 2.7, 1}});
  std::size_t before = 1000;
  for (const double threshold : {0.0, 1e-4, 0.05, 0.2, 0.4}) {
    const Forest forest = asked(grid, 1, *field, fractions(threshold));
    std::vector<Index3> needed;
    for (std::int64_t c = 0; c < grid.cell_count(); ++c) {
      const Index3 cell = whole(grid.cells).cell(c);
      if (parts_differ(*field, cell_box(cell, 0)) <= threshold) continue;
      EXPECT_TRUE(forest.refined(0, {cell[0] / 2, cell[1] / 2, cell[2] / 2})) << threshold << ", cell " << c;
      needed.push_back({cell[0] / 2, cell[1] / 2, cell[2] / 2});
    }
    std::sort(needed.begin(), needed.end());
    needed.erase(std::unique(needed.begin(), needed.end()), needed.end());
    EXPECT_GT(needed.size(), 0U);
    // Few more blocks, where the ball touches a side of a cell.
    EXPECT_LE(count(forest, 0), needed.size() + 4) << threshold;
    EXPECT_LE(count(forest, 0), before) << threshold;
    before = count(forest, 0);
  }
}

TEST(FractionsCriterion, GoesDownToTheLastLevel) {
  const Grid grid = unit_grid({8, 8, 8});
  const auto field = balls_field(grid, {{{4.1, 3.9, 4.05}, 2.7, 1}});
  const Forest forest = asked(grid, 3, *field, fractions(1e-4));
  for (int level = 0; level < 3; ++level) {
    const IndexBox cells = whole(forest.cells(level));
    for (std::int64_t c = 0; c < cells.size(); ++c) {
      const Index3 cell = cells.cell(c);
      if (parts_differ(*field, cell_box(cell, level)) > 1e-3)
        EXPECT_TRUE(forest.refined(level, {cell[0] / 2, cell[1] / 2, cell[2] / 2})) << "level " << level;
    }
    if (level > 0) {  // the interface is a surface
      const double growth =
          static_cast<double>(count(forest, level)) / static_cast<double>(count(forest, level - 1));
      EXPECT_GT(growth, 2.5);
      EXPECT_LT(growth, 5);
    }
  }
}

TEST(FractionsCriterion, RefinesNothingWhereThereIsOneMaterial) {
  const Grid grid = unit_grid({8, 8, 8});
  EXPECT_EQ(count(asked(grid, 2, *half_space_field(0, 9.0), fractions(0)), 0), 0U);
}

// Data finer than the grid, as when coarsening: 2^levels cells of the data per cell.
TEST(FractionsCriterion, CoarsensDenseData) {
  Grid coarse = unit_grid({4, 4, 4});
  for (auto& planes : coarse.planes)
    for (double& x : planes) x *= 4;
  const Case dense = voxels("dense", {16, 16, 16}, 2,
                            [](const Index3& c) { return c[0] < 5 && c[1] < 5 && c[2] < 5 ? 1 : 0; });
  const auto field = data_field_of(dense);
  const Forest forest = asked(coarse, 2, *field, fractions(0));
  // Cells of level 1 hold 2^3 voxels: those beside the cube of 5 voxels are halved to voxels.
  for (std::int64_t c = 0; c < whole(dense.grid.cells).size(); ++c) {
    const Index3 voxel = whole(dense.grid.cells).cell(c);
    bool at_interface = false;
    for (std::size_t d = 0; d < 3; ++d)
      for (const int way : {-1, 1}) {
        Index3 other = voxel;
        other[d] += way;
        const auto inside = [](const Index3& v) { return v[0] < 5 && v[1] < 5 && v[2] < 5; };
        at_interface =
            at_interface || (whole(dense.grid.cells).contains(other) && inside(voxel) != inside(other));
      }
    if (at_interface)
      EXPECT_TRUE(forest.refined(1, {voxel[0] / 4, voxel[1] / 4, voxel[2] / 4})) << "voxel " << c;
  }
  EXPECT_FALSE(forest.refined(0, {1, 1, 1}) && forest.refined(1, {3, 3, 3})) << "far from the interface";
}

AdaptCriterion materials(std::vector<AdaptCriterion::Material> list) {
  AdaptCriterion c;
  c.measure = AdaptMeasure::kMaterial;
  c.materials = std::move(list);
  return c;
}

TEST(MaterialCriterion, HalvesCellsWithMoreThanTheFraction) {
  const Grid grid = unit_grid({10, 4, 4});
  const auto field = half_space_field(0, 6.7);  // cells at 6 hold 0.3 of material 1
  const Forest some = asked(grid, 1, *field, materials({{1, 1, 0.29, 0}}));
  EXPECT_EQ(refined_blocks(some, 0), layers(some, {3, 4}));
  const Forest most = asked(grid, 1, *field, materials({{1, 1, 0.31, 0}}));
  EXPECT_EQ(refined_blocks(most, 0), layers(most, {3, 4})) << "cell 7 is in the block of cell 6";
  const auto later = half_space_field(0, 7.7);
  const Forest last = asked(grid, 1, *later, materials({{1, 1, 0.31, 0}}));
  EXPECT_EQ(refined_blocks(last, 0), layers(last, {4}));
  EXPECT_EQ(count(asked(grid, 1, *field, materials({{1, 1, 1, 0}})), 0), 0U) << "nothing holds more than all";
  EXPECT_EQ(count(asked(grid, 1, *field, materials({{5, 1, 0, 0}})), 0), 0U) << "not in the grid";
}

TEST(MaterialCriterion, ReachesAsFarAsTheDistance) {
  const Grid grid = unit_grid({12, 4, 4});
  const auto field = half_space_field(0, 10.0);
  const auto refined = [&](double distance) {
    const Forest f = asked(grid, 1, *field, materials({{1, 1, 0, distance}}));
    EXPECT_EQ(refined_blocks(f, 0).size() % 4, 0U);
    return f;
  };
  Forest f = refined(0);
  EXPECT_EQ(refined_blocks(f, 0), layers(f, {5}));
  f = refined(0.5);  // cell 9 is beside it, in block 4
  EXPECT_EQ(refined_blocks(f, 0), layers(f, {4, 5}));
  f = refined(2.5);  // cells 7 and above
  EXPECT_EQ(refined_blocks(f, 0), layers(f, {3, 4, 5}));
  f = refined(100);
  EXPECT_EQ(count(f, 0), 24U);
}

// A cell counts by itself as well where the larger box holds less of the material.
TEST(MaterialCriterion, OfSmallThingsInALargeDistance) {
  const Grid grid = unit_grid({12, 12, 12});
  const auto field = balls_field(grid, {{{6, 6, 6}, 1.8, 1}});
  const Forest near = asked(grid, 1, *field, materials({{1, 1, 0.9, 0}}));
  const Forest far = asked(grid, 1, *field, materials({{1, 1, 0.9, 4}}));
  EXPECT_GT(count(near, 0), 0U);
  EXPECT_EQ(refined_blocks(far, 0), refined_blocks(near, 0));
}

TEST(MaterialCriterion, EachMaterialHasItsLevels) {
  const Grid grid = unit_grid({12, 4, 4});
  const Case data =
      voxels("three", {12, 4, 4}, 3, [](const Index3& c) { return static_cast<std::int32_t>(c[0] / 4); });
  const auto field = data_field_of(data);
  const Forest f = asked(grid, 3, *field, materials({{0, 1, 0, 0}, {2, 2, 0, 0}}));
  EXPECT_EQ(refined_blocks(f, 0), layers(f, {0, 1, 4, 5}));
  EXPECT_EQ(count(f, 1), 64U);  // all cells of material 2
  for (const Index3& b : refined_blocks(f, 1)) EXPECT_GE(b[0], 8);
  EXPECT_EQ(count(f, 2), 0U);
  EXPECT_EQ(count(asked(grid, 3, *field, materials({})), 0), 0U);
}

// Two cells of one material that meet at an edge, and two that meet at a corner.
TEST(NonManifold, PlacesAreRefined) {
  const Grid grid = unit_grid({8, 8, 8});
  const Case edge = voxels("edge", {8, 8, 8}, 2, [](const Index3& c) {
    const bool a = c[0] < 4 && c[1] < 4, b = c[0] >= 4 && c[1] >= 4;
    return (a || b) && c[2] == 2 ? 1 : 0;
  });
  const auto field = data_field_of(edge);
  AdaptCriterion c = fractions(1);  // nothing by itself
  EXPECT_EQ(count(asked(grid, 1, *field, c), 0), 0U);
  c.non_manifold = true;
  const Forest forest = asked(grid, 1, *field, c);
  for (const std::int64_t i : {1, 2})
    for (const std::int64_t j : {1, 2}) EXPECT_TRUE(forest.refined(0, {i, j, 1}));
  EXPECT_FALSE(forest.refined(0, {0, 0, 1}));
  EXPECT_FALSE(forest.refined(0, {3, 1, 1}));
  const Forest deeper = asked(grid, 2, *field, c);
  EXPECT_GT(count(deeper, 1), 0U);
  EXPECT_LT(count(deeper, 1), 8 * count(deeper, 0));
}

TEST(NonManifold, SmoothInterfacesAreLeftAlone) {
  const Grid grid = unit_grid({8, 8, 8});
  AdaptCriterion c = fractions(1);
  c.non_manifold = true;
  EXPECT_EQ(count(asked(grid, 1, *half_space_field(2, 4.0), c), 0), 0U);
  EXPECT_EQ(count(asked(grid, 1, *half_space_field(unit({1, 2, 3}), 7), c), 0), 0U);
}

constexpr AdaptMeasure kDistances[] = {AdaptMeasure::kFacetToSurface, AdaptMeasure::kSurfaceToFacet,
                                       AdaptMeasure::kSurfaceToSurface};

// A large ball and a small one, far from each other.
struct TwoBalls {
  Grid grid = unit_grid({24, 12, 12});
  std::vector<Ball> balls{{{6.2, 6.1, 5.9}, 5, 1}, {{18.3, 5.8, 6.1}, 1.7, 1}};
  std::unique_ptr<MaterialField> field = balls_field(grid, balls);

  // Refined blocks at the large and the small ball.
  std::pair<std::size_t, std::size_t> refined(AdaptMeasure measure, double threshold) {
    AdaptCriterion c = fractions(threshold);
    c.measure = measure;
    c.exact = balls_surface(balls);
    std::pair<std::size_t, std::size_t> n{0, 0};
    for (const Index3& b : refined_blocks(asked(grid, 1, *field, c), 0)) ++(b[0] < 7 ? n.first : n.second);
    return n;
  }
};

TEST(DistanceCriteria, RefineWhereTheSurfaceIsCurved) {
  TwoBalls two;
  for (const AdaptMeasure measure : kDistances) {
    const auto [all_large, all_small] = two.refined(measure, 0);
    EXPECT_GT(all_large, 4 * all_small) << "every cell at the surface counts";
    // The plane of a cell misses a ball of radius 5 by about 1 / 40 cells, one of radius 1.7 by three times
    // as much.
    bool small_alone = false;
    std::pair<std::size_t, std::size_t> before{1000, 1000};
    for (const double threshold : {0.01, 0.03, 0.045, 0.06, 0.08, 0.15, 2.0}) {
      const auto now = two.refined(measure, threshold);
      EXPECT_LE(now.first, before.first) << threshold;
      EXPECT_LE(now.second, before.second) << threshold;
      small_alone = small_alone || (2 * now.second > all_small && 2 * now.first < all_large);
      before = now;
    }
    EXPECT_TRUE(small_alone) << static_cast<int>(measure);
    EXPECT_EQ(before.first + before.second, 0U);
  }
}

// Distances are halved by every level at least, so that a threshold ends the refinement by itself.
TEST(DistanceCriteria, EndByThemselves) {
  TwoBalls two;
  for (const AdaptMeasure measure : kDistances) {
    AdaptCriterion c = fractions(0.03);
    c.measure = measure;
    c.exact = balls_surface(two.balls);
    const Forest forest = asked(two.grid, 4, *two.field, c);
    EXPECT_GT(count(forest, 0), 0U);
    EXPECT_EQ(count(forest, 3), 0U) << static_cast<int>(measure);
  }
}

TEST(DistanceCriteria, LeavePlanesAlone) {
  const Grid grid = unit_grid({8, 6, 6});
  const auto field = half_space_field(0, 3.3);
  AdaptCriterion c = fractions(1e-9);
  c.exact = [](const Vec3& p, std::int32_t, std::int32_t) -> std::optional<Vec3> {
    return Vec3{3.3, p.y, p.z};
  };
  for (const AdaptMeasure measure : kDistances) {
    c.measure = measure;
    EXPECT_EQ(count(asked(grid, 2, *field, c), 0), 0U) << static_cast<int>(measure);
  }
}

// Any cut of the cells among ranks asks for the same.
TEST(MarkCells, OfPartsIsThatOfTheWhole) {
  const Grid grid = unit_grid({9, 8, 7});
  const auto field = balls_field(grid, {{{4.3, 3.9, 3.6}, 2.7, 1}, {{7, 6, 5}, 2, 2}});
  AdaptCriterion c = fractions(1e-4);
  c.non_manifold = true;
  Forest whole_grid = asked(grid, 2, *field, c), parts(grid.cells, 2, kNotPeriodic);
  for (std::int64_t i = 0; i < 9; i += 2)
    mark_cells(grid, {{i, 0, 0}, {std::min<std::int64_t>(i + 2, 9), 8, 7}}, *field, c, parts);
  EXPECT_TRUE(std::ranges::equal(parts.words(), whole_grid.words()));
}

}  // namespace
}  // namespace sculpt::test
