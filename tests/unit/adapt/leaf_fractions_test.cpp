#include "sculpt/adapt/leaf_fractions.hpp"

#include <gtest/gtest.h>

#include "support/fields.hpp"
#include "support/mesh_checks.hpp"

namespace sculpt::test {
namespace {

double share(const Fractions& f, LocalId cell, std::int32_t material) {
  for (auto e = static_cast<std::size_t>(f.offset[at(cell)]);
       e < static_cast<std::size_t>(f.offset[at(cell) + 1]); ++e)
    if (f.material[e] == material) return f.value[e];
  return 0;
}

// Materials ascend, fractions lie in (0,1] and add up to 1.
void expect_valid(const Fractions& f, LocalId cells) {
  ASSERT_EQ(f.cells(), cells);
  for (std::size_t c = 0; c < at(cells); ++c) {
    double sum = 0;
    for (auto e = static_cast<std::size_t>(f.offset[c]); e < static_cast<std::size_t>(f.offset[c + 1]); ++e) {
      sum += f.value[e];
      EXPECT_TRUE(f.value[e] > 0 && f.value[e] <= 1) << f.value[e];
      if (e > static_cast<std::size_t>(f.offset[c])) EXPECT_GT(f.material[e], f.material[e - 1]);
    }
    EXPECT_NEAR(sum, 1, 1e-12) << "cell " << c;
  }
}

struct Measured {
  LeafMesh mesh;
  Fractions fractions;
};
Measured measured(const Forest& forest, MaterialField& field) {
  const Grid grid = unit_grid(forest.cells(0));
  Measured m{leaf_mesh(Comm::self(), grid, forest, alone(forest), 2), {}};
  m.fractions = leaf_fractions(grid, m.mesh, field);
  expect_valid(m.fractions, m.mesh.cells.size());
  return m;
}

double volume_of(const Measured& m, std::int32_t material) {
  double sum = 0;
  for (LocalId h = 0; h < m.mesh.cells.size(); ++h)
    sum += share(m.fractions, h, material) * hex_volume(m.mesh.cells.corners(h));
  return sum;
}

TEST(LeafFractions, OfCubesAreThoseOfTheField) {
  const Forest forest = random_forest({8, 7, 6}, 2, 0.01, 1);
  const double at = 3.3;
  const auto field = half_space_field(0, at);
  const Measured m = measured(forest, *field);
  int plain = 0, mixed = 0;
  for (const Leaf& leaf : m.mesh.leaves)
    for (LocalId h = leaf.first; h < leaf.end && !leaf.transition; ++h) {
      const HexCorners p = m.mesh.cells.corners(h);
      const double exact = std::clamp((p[6].x - at) / (p[6].x - p[0].x), 0.0, 1.0);
      EXPECT_EQ(share(m.fractions, h, 1), exact);
      mixed += exact > 0 && exact < 1;
      ++plain;
    }
  EXPECT_GT(plain, 100);
  EXPECT_GT(mixed, 20);
}

TEST(LeafFractions, OfCubesCutByATiltedPlane) {
  const Forest forest = random_forest({6, 6, 6}, 2, 0.01, 2);
  const Vec3 normal = unit({1, -2, 3});
  const auto field = half_space_field(normal, 2.2);
  const Measured m = measured(forest, *field);
  for (const Leaf& leaf : m.mesh.leaves)
    for (LocalId h = leaf.first; h < leaf.end && !leaf.transition; ++h) {
      const HexCorners p = m.mesh.cells.corners(h);
      const double edge = p[6].x - p[0].x;
      EXPECT_NEAR(share(m.fractions, h, 1), part_above((1 / edge) * p[0], normal, 2.2 / edge), 1e-9);
    }
}

// The volume that the fractions tell is that of the field, although hexes of transitions are sampled.
TEST(LeafFractions, KeepVolumes) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const Index3 n = seed % 2 == 0 ? Index3{8, 8, 8} : Index3{7, 9, 5};
    const Forest forest = random_forest(n, 1 + static_cast<int>(seed % 3), 0.02, seed);
    const double size = static_cast<double>(n[1] * n[2]), at = 3.37;
    const Measured plane = measured(forest, *half_space_field(0, at));
    EXPECT_NEAR(volume_of(plane, 0) / (size * at), 1, 0.005) << "seed " << seed;
    const Grid grid = unit_grid(n);
    const auto balls = balls_field(grid, {{{3.9, 4.1, 2.6}, 2.3, 1}});
    EXPECT_NEAR(volume_of(measured(forest, *balls), 1) / (4.0 / 3 * M_PI * std::pow(2.3, 3)), 1, 0.01)
        << "seed " << seed;
  }
}

TEST(LeafFractions, WherePureStayPure) {
  const Forest forest = random_forest({8, 8, 8}, 2, 0.02, 4);
  // Materials of whole blocks of the grid: no leaf has two.
  const Case blocks = voxels("blocks", {8, 8, 8}, 8, [](const Index3& c) {
    return static_cast<std::int32_t>(c[0] / 2 % 2 + 2 * (c[1] / 2 % 2) + 4 * (c[2] / 2 % 2));
  });
  const auto field = data_field_of(blocks);
  const Measured m = measured(forest, *field);
  EXPECT_EQ(m.fractions.material.size(), at(m.mesh.cells.size()));
  for (const double v : m.fractions.value) EXPECT_EQ(v, 1);
}

// A hex of a transition between two materials has both.
TEST(LeafFractions, HexesOfTransitionsAreMeasuredWhereTheyAre) {
  Forest forest({8, 4, 4}, 1, kNotPeriodic);
  for (std::int64_t k = 0; k < 2; ++k)
    for (std::int64_t j = 0; j < 2; ++j) forest.refine_block(0, {0, j, k});
  ASSERT_EQ(forest.close(), 0);
  const double plane = 2.7;  // through the transitions beside the refined blocks
  const Measured m = measured(forest, *half_space_field(0, plane));
  int checked = 0;
  for (const Leaf& leaf : m.mesh.leaves)
    for (LocalId h = leaf.first; h < leaf.end && leaf.transition; ++h) {
      double lo = 1e9, hi = -1e9;
      for (const Vec3& p : m.mesh.cells.corners(h)) {
        lo = std::min(lo, p.x);
        hi = std::max(hi, p.x);
      }
      const double s = share(m.fractions, h, 1);
      if (hi <= plane) EXPECT_EQ(s, 0);
      if (lo >= plane) EXPECT_EQ(s, 1);
      if (lo < plane - 0.2 && hi > plane + 0.2) {
        EXPECT_GT(s, 0.02);
        EXPECT_LT(s, 0.98);
        ++checked;
      }
    }
  EXPECT_GT(checked, 0);
}

}  // namespace
}  // namespace sculpt::test
