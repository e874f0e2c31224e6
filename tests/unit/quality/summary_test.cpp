#include "sculpt/quality/summary.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "support/mesh_checks.hpp"
#include "support/stages.hpp"

namespace sculpt {
namespace {

HexMesh lattice(const Index3& cells, const Vec3& size, const std::vector<std::int32_t>& material) {
  test::Case input = test::voxels(cells, material);
  input.grid = uniform_grid(cells, {0.1, -3, 7}, size);
  return test::overlay(input).cells;
}

TEST(Summarise, CountsByHand) {
  HexMesh mesh = lattice({2, 1, 1}, {1, 1, 1}, {0, 0});
  QualitySummary s = summarise(Comm::self(), mesh);
  EXPECT_EQ(s.hexes, 2);
  EXPECT_EQ(s.not_positive, 0);
  EXPECT_NEAR(s.least, 1, 1e-15);
  EXPECT_NEAR(s.average, 1, 1e-9);
  EXPECT_NEAR(s.shortest_edge, 1, 1e-15);
  EXPECT_EQ(s.histogram[19], 2);
  // Shear the second cell: its far side sinks by 3, so the angle's cosine is 3 / sqrt(10).
  for (std::size_t n = 0; n < mesh.position.size(); ++n)
    if (mesh.box_sides[n] & kXmax) mesh.position[n].y -= 3;
  s = summarise(Comm::self(), mesh);
  const double sheared = 1 / std::sqrt(10.0);
  EXPECT_NEAR(s.least, sheared, 1e-12);
  EXPECT_NEAR(s.average, (1 + sheared) / 2, 1e-9);
  ASSERT_EQ(s.worst.size(), 2U);
  EXPECT_EQ(s.worst[0].hex, 1);
  EXPECT_EQ(s.worst[0].element, 2);
  EXPECT_NEAR(norm(s.worst[0].centre - Vec3{1.6, -4, 7.5}), 0, 1e-12);
  EXPECT_NEAR(s.worst[0].least_determinant, 1, 1e-12) << "a shear keeps the volume";
  EXPECT_EQ(s.worst[0].valid, 1);
  EXPECT_EQ(s.below_03, 0);
  EXPECT_EQ(s.below_05, 1);
  EXPECT_EQ(s.histogram[13], 1) << "0.316 lies in 0.3 .. 0.4";
  EXPECT_TRUE(s.invalid.empty());
  // Turn it inside out.
  for (std::size_t n = 0; n < mesh.position.size(); ++n)
    if (mesh.box_sides[n] & kXmax) mesh.position[n] += Vec3{-1.5, 3, 0};
  s = summarise(Comm::self(), mesh);
  EXPECT_EQ(s.not_positive, 1);
  EXPECT_EQ(s.below_01, 1);
  EXPECT_EQ(s.below_02, 1);
  EXPECT_EQ(s.below_03, 1);
  EXPECT_EQ(s.histogram[0], 1);
  EXPECT_NEAR(s.least, -1, 1e-12);
  EXPECT_EQ(s.not_positive_inside, 1);
  ASSERT_EQ(s.invalid.size(), 1U);
  EXPECT_EQ(s.invalid[0].element, 2);
  EXPECT_EQ(s.invalid[0].valid, 0);
  EXPECT_NEAR(s.invalid[0].least_determinant, -0.5, 1e-12);
  EXPECT_NEAR(s.materials[0].volume, 0.5, 1e-9);
}

// Hexes of material 0 come first in the files, those of material 2 last, whatever their place in the grid.
TEST(Summarise, NumbersHexesAsTheFilesDo) {
  const HexMesh mesh = lattice({6, 1, 1}, {1, 1, 1}, {2, 0, 2, 1, 0, 2});
  const QualitySummary s = summarise(Comm::self(), mesh);
  ASSERT_EQ(s.worst.size(), 6U);
  const std::vector<GlobalId> expected{4, 1, 5, 3, 2, 6};
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(s.worst[i].hex, static_cast<GlobalId>(i)) << "equal ones ascend in key";
    EXPECT_EQ(s.worst[i].element, expected[i]);
  }
}

TEST(Summarise, TellsMaterialsApartAndMeasuresInCells) {
  HexMesh mesh = lattice({3, 1, 1}, {0.5, 2, 4}, {0, 3, 3});
  for (std::size_t n = 0; n < mesh.position.size(); ++n)  // the last cell is stretched to twice its length
    if (mesh.box_sides[n] & kXmax) mesh.position[n].x += 0.5;
  const QualitySummary s = summarise(Comm::self(), mesh);
  ASSERT_EQ(s.materials.size(), 4U);
  EXPECT_EQ(s.materials[0].hexes, 1);
  EXPECT_EQ(s.materials[1].hexes, 0);
  EXPECT_EQ(s.materials[3].hexes, 2);
  EXPECT_NEAR(s.materials[0].volume, 1, 1e-9);
  EXPECT_NEAR(s.materials[3].volume, 3, 1e-9);
  EXPECT_NEAR(s.materials[3].mean, 1, 1e-9);
  EXPECT_NEAR(s.shortest_edge, 0.5, 1e-15);
  EXPECT_NEAR(s.shortest_edge_cells, 1, 1e-15);
  for (std::size_t n = 0; n < mesh.position.size();
       ++n)  // z is now the shortest edge in cells, not in length
    if (mesh.box_sides[n] & kZmax) mesh.position[n].z -= 3.2;
  EXPECT_NEAR(summarise(Comm::self(), mesh).shortest_edge_cells, 0.2, 1e-14);
  EXPECT_NEAR(summarise(Comm::self(), mesh).shortest_edge, 0.5, 1e-14);
}

// Counts, histogram, lists and single values of a bad mesh say the same.
TEST(Summarise, AgreesWithTheSingleHexes) {
  HexMesh mesh = lattice({7, 6, 5}, {1, 1, 1}, std::vector<std::int32_t>(210, 0));
  for (std::size_t n = 0; n < mesh.position.size(); ++n)
    for (std::size_t d = 0; d < 3; ++d) mesh.position[n][d] += 1.1 * (test::scatter_unit(9, 3 * n + d) - 0.5);
  const QualitySummary s = summarise(Comm::self(), mesh);
  std::vector<double> q = scaled_jacobians(mesh);
  for (LocalId h = 0; h < mesh.size(); ++h) EXPECT_NEAR(q[at(h)], scaled_jacobian(mesh.corners(h)), 1e-14);
  const auto below = [&](double limit) {
    return std::count_if(q.begin(), q.end(), [limit](double x) { return x < limit; });
  };
  EXPECT_EQ(s.below_01, below(0.1));
  EXPECT_EQ(s.below_02, below(0.2));
  EXPECT_EQ(s.below_03, below(0.3));
  EXPECT_EQ(s.below_05, below(0.5));
  std::int64_t sum = 0;
  for (int b = 0; b < QualitySummary::kBins; ++b) {
    EXPECT_EQ(sum, below(QualitySummary::bin_begin(b))) << b;
    sum += s.histogram[static_cast<std::size_t>(b)];
  }
  EXPECT_EQ(sum, s.hexes);
  EXPECT_NEAR(s.average, std::accumulate(q.begin(), q.end(), 0.0) / 210, 1e-9);
  std::vector<double> sorted = q;
  std::sort(sorted.begin(), sorted.end());
  ASSERT_EQ(s.worst.size(), kWorstListed);
  for (std::size_t i = 0; i < kWorstListed; ++i) EXPECT_EQ(s.worst[i].scaled_jacobian, sorted[i]);
  EXPECT_GT(s.not_positive_inside, s.not_positive - 1);
  ASSERT_EQ(s.invalid.size(),
            std::min<std::size_t>(kInvalidListed, static_cast<std::size_t>(s.not_positive_inside)));
  ASSERT_GT(s.invalid.size(), 3U) << "the mesh is not bad enough to test anything";
  for (const ListedHex& h : s.worst) {
    const HexCorners p = mesh.corners(static_cast<LocalId>(h.hex));
    EXPECT_NEAR(corner_scaled_jacobian(p, h.corner - 1), h.scaled_jacobian, 1e-14);
    EXPECT_EQ(h.valid != 0, is_positive_inside(p));
  }
}

}  // namespace
}  // namespace sculpt
