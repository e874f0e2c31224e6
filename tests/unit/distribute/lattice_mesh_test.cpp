#include <gtest/gtest.h>

#include "sculpt/distribute/cartesian.hpp"
#include "support/mesh_checks.hpp"

namespace sculpt {
namespace {

Grid small_grid() { return box_grid({3, 2, 4}, {-1, 0.5, 2}, {2, 1.5, 3}); }

HexMesh small_mesh() {
  return lattice_mesh(Comm::self(), small_grid(), cut_grid({3, 2, 4}, 1, {0, 0, 0}), 2);
}

TEST(LatticeMesh, HasTheNodesOfTheGrid) {
  const HexMesh mesh = small_mesh();
  ASSERT_EQ(mesh.nodes(), 4 * 3 * 5);
  const Grid grid = small_grid();
  for (std::size_t n = 0; n < mesh.position.size(); ++n) {
    EXPECT_EQ(mesh.node_id[n], static_cast<GlobalId>(n));
    const Vec3 expected{grid.planes[0][n % 4], grid.planes[1][n / 4 % 3], grid.planes[2][n / 12]};
    EXPECT_EQ(mesh.position[n], expected);
  }
  EXPECT_EQ(test::box_problem(mesh, grid), "");
}

TEST(LatticeMesh, HasTheCellsOfTheGrid) {
  const HexMesh mesh = small_mesh();
  ASSERT_EQ(mesh.size(), 24);
  for (LocalId c = 0; c < mesh.size(); ++c) {
    EXPECT_EQ(mesh.hex_id[static_cast<std::size_t>(c)], c);
    EXPECT_EQ(mesh.layer[static_cast<std::size_t>(c)], 0);
    EXPECT_NEAR(hex_volume(mesh.corners(c)), 0.5 * 0.25, 1e-15);
    EXPECT_NEAR(scaled_jacobian(mesh.corners(c)), 1, 1e-15);
  }
  EXPECT_EQ(mesh.hexes[7], (Hex{13, 14, 18, 17, 25, 26, 30, 29}));  // cell (1,0,1)
  EXPECT_EQ(mesh.lattice, (std::array<LocalId, 3>{3, 2, 4}));
  EXPECT_EQ(mesh.cell_size, (Vec3{1, 0.5, 0.25}));
}

TEST(LatticeMesh, KnowsTheSidesOfTheBox) {
  const HexMesh mesh = small_mesh();
  EXPECT_EQ(mesh.box_sides[0], kXmin | kYmin | kZmin);
  EXPECT_EQ(mesh.box_sides[59], kXmax | kYmax | kZmax);
  EXPECT_EQ(mesh.box_sides[1], kYmin | kZmin);
  EXPECT_EQ(mesh.box_sides[1 + 4 + 12], 0);
  EXPECT_EQ(mesh.box_sides[3 + 4 + 12], kXmax);
  EXPECT_EQ(face_sides(mesh, 0, 4), kZmin);
  EXPECT_EQ(face_sides(mesh, 0, 0), kYmin);
  EXPECT_EQ(face_sides(mesh, 0, 1), 0);
  EXPECT_EQ(face_sides(mesh, 23, 5), kZmax);
}

TEST(LatticeMesh, NodesOfACellHaveDifferentColours) {
  const HexMesh mesh = small_mesh();
  EXPECT_EQ(mesh.colours, 8);
  for (const Hex& hex : mesh.hexes) {
    unsigned seen = 0;
    for (const LocalId n : hex) seen |= 1U << mesh.colour[static_cast<std::size_t>(n)];
    EXPECT_EQ(seen, 0xffU);
  }
}

TEST(LatticeMesh, IsAConformingBox) {
  const HexMesh mesh = small_mesh();
  EXPECT_EQ(test::conformity_problem(mesh, 0), "");
  EXPECT_EQ(test::boundary_problem(mesh), "");
}

}  // namespace
}  // namespace sculpt
