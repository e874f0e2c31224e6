#include "sculpt/write/side_set_stats.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "support/stages.hpp"

namespace sculpt::test {
namespace {

TEST(Quads, OfKnownShapes) {
  const std::array<Vec3, 4> rectangle{{{0, 0, 1}, {3, 0, 1}, {3, 2, 1}, {0, 2, 1}}};
  EXPECT_DOUBLE_EQ(quad_area(rectangle), 6);
  EXPECT_DOUBLE_EQ(quad_scaled_jacobian(rectangle), 1);
  const std::array<Vec3, 4> rhombus{{{0, 0, 0}, {2, 0, 0}, {3, std::sqrt(3), 0}, {1, std::sqrt(3), 0}}};
  EXPECT_NEAR(quad_area(rhombus), 2 * std::sqrt(3), 1e-14);
  EXPECT_NEAR(quad_scaled_jacobian(rhombus), std::sin(std::numbers::pi / 3), 1e-14);
  const std::array<Vec3, 4> triangle{{{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {0, 2, 0}}};
  EXPECT_NEAR(quad_area(triangle), 2, 1e-14);
  EXPECT_NEAR(quad_scaled_jacobian(triangle), 0, 1e-14) << "a flat corner";
  const std::array<Vec3, 4> arrow{{{0, 0, 0}, {2, 0, 0}, {0.5, 0.5, 0}, {0, 2, 0}}};
  EXPECT_LT(quad_scaled_jacobian(arrow), 0) << "a corner turned over";
  const std::array<Vec3, 4> point{};
  EXPECT_EQ(quad_scaled_jacobian(point), 0);
  // Begun at another corner it is the same quad.
  const std::array<Vec3, 4> bent{{{0, 0, 0}, {1, 0, 0.3}, {1.2, 1, 0}, {0, 0.9, 0.4}}};
  const std::array<Vec3, 4> turned_bent{{bent[1], bent[2], bent[3], bent[0]}};
  EXPECT_NEAR(quad_area(turned_bent), quad_area(bent), 1e-15);
  EXPECT_NEAR(quad_scaled_jacobian(turned_bent), quad_scaled_jacobian(bent), 1e-15);
}

TEST(SideSetStats, OfALattice) {
  HexMesh mesh = lattice({4, 3, 2});
  for (Vec3& p : mesh.position) p = {2 * p.x, p.y, p.z + 5};
  mesh.cell_size = {2, 1, 1};
  std::vector<SideFace> faces;
  for (LocalId h = 0; h < mesh.size(); ++h)
    for (std::int32_t f = 0; f < 6; ++f)
      if (face_sides(mesh, h, f) == kZmax) faces.push_back({3, h, f});
  const auto stats = side_set_stats(Comm::self(), mesh, std::vector<std::int64_t>{3, 8}, faces);
  ASSERT_EQ(stats.size(), 2U);
  EXPECT_EQ(stats[0].id, 3);
  EXPECT_EQ(stats[0].faces, 12);
  EXPECT_NEAR(stats[0].area, 24, 1e-7);
  EXPECT_EQ(stats[0].least, 1);
  EXPECT_EQ(stats[0].mean, 1);
  EXPECT_EQ(stats[0].most, 1);
  EXPECT_EQ(stats[0].bounds.lo, (Vec3{0, 0, 7}));
  EXPECT_EQ(stats[0].bounds.hi, (Vec3{8, 3, 7}));
  EXPECT_EQ(stats[1].faces, 0);
  EXPECT_EQ(stats[1].area, 0);
}

}  // namespace
}  // namespace sculpt::test
