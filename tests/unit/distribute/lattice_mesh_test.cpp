#include <gtest/gtest.h>

#include <cmath>

#include "sculpt/base/error.hpp"
#include "sculpt/distribute/cartesian.hpp"
#include "sculpt/mesh/edit.hpp"
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

// Periodic in x (odd) and z (even, shorter than the ghosts reach).
HexMesh periodic_mesh() {
  CartesianParts parts = cut_grid({3, 4, 2}, 1, {0, 0, 0});
  parts.periodic = {true, false, true};
  HexMesh mesh = lattice_mesh(Comm::self(), box_grid({3, 4, 2}, {-0.3, 0, 10}, {0.6, 1, 11}), parts, 3);
  mesh.material.assign(mesh.hexes.size(), 0);
  return mesh;
}

TEST(PeriodicLattice, GoesOnBeyondItsEnds) {
  const HexMesh mesh = periodic_mesh();
  EXPECT_EQ(mesh.lattice, (std::array<LocalId, 3>{9, 4, 8}));
  EXPECT_EQ(mesh.nodes(), 10 * 5 * 9);
  EXPECT_EQ(test::owned_hexes(mesh), 24);
  EXPECT_EQ(test::conformity_problem(mesh, 0), "");
  EXPECT_EQ(test::ghost_problem(mesh), "");
  CartesianParts parts = cut_grid({3, 4, 2}, 1, {0, 0, 0});
  parts.periodic = {true, false, true};
  EXPECT_EQ(numbered_grid(parts, 3), (Index3{9, 4, 8}));
}

TEST(PeriodicLattice, ImagesKnowTheirHomes) {
  const HexMesh mesh = periodic_mesh();
  for (LocalId k = 0, c = 0; k < 8; ++k)
    for (LocalId j = 0; j < 4; ++j)
      for (LocalId i = 0; i < 9; ++i, ++c) {
        const Image image{static_cast<std::int16_t>(i / 3 - 1), 0,
                          static_cast<std::int16_t>((k + 1) / 2 - 2)};
        EXPECT_EQ(mesh.hex_id[at(c)], c);
        EXPECT_EQ(mesh.image_of(c), image);
        EXPECT_EQ(mesh.hex_home[at(c)], i % 3 + 3 + 9 * (j + 4 * ((k + 1) % 2 + 3)));
        EXPECT_EQ(mesh.hex_owner[at(c)], image == (Image{0, 0, 0}) ? 0 : 1);
        EXPECT_EQ(mesh.layer[at(c)] == 0, image == (Image{0, 0, 0}));
      }
}

TEST(PeriodicLattice, HoldsNodesOnTheOtherSidesOnly) {
  const HexMesh mesh = periodic_mesh();
  for (LocalId n = 0; n < mesh.nodes(); ++n) {
    const LocalId j = n / 10 % 5;
    EXPECT_EQ(mesh.box_sides[at(n)], j == 0 ? kYmin : j == 4 ? kYmax : 0);
  }
}

TEST(PeriodicLattice, NodesOfAHexDifferInColourOrAreImagesOfEachOther) {
  const HexMesh mesh = periodic_mesh();
  EXPECT_EQ(mesh.colours, 3 * 2 * 2);
  for (const Hex& hex : mesh.hexes)
    for (const LocalId a : hex)
      for (const LocalId b : hex) {
        if (a != b) EXPECT_NE(mesh.colour[at(a)], mesh.colour[at(b)]);
        if (mesh.node_home[at(a)] == mesh.node_home[at(b)]) EXPECT_EQ(a, b);
      }
}

// 0.9 is no multiple of the spacing of doubles where the images are.
TEST(PeriodicLattice, TranslatesWithoutRounding) {
  HexMesh mesh = periodic_mesh();
  EXPECT_EQ(mesh.period, (Vec3{0.6 - -0.3, 0, 1}));
  for (Vec3& p : mesh.position) p += {0.01 / 3, 0.2 / 7, 0.1 / 3};
  share_positions(mesh);
  const LocalId home = 3 + 10 * (2 + 5 * 3);
  for (const LocalId step : {3, -3}) {
    const Vec3 a = mesh.position[at(home + step)] - mesh.position[at(home)],
               b = mesh.position[at(home + step + 1)] - mesh.position[at(home + 1)];
    EXPECT_EQ(a, b);
    EXPECT_NEAR(std::fabs(a.x), 0.9, 1e-15);
  }
  // In the end images are exactly the period away.
  const Vec3 before = mesh.position[at(home)];
  transform(mesh, {2, 1, 1}, {0.125, 0, 0});
  EXPECT_EQ(mesh.position[at(home)].x, 2 * before.x + 0.125);
  EXPECT_EQ(mesh.position[at(home + 3)].x, mesh.position[at(home)].x + 2 * (0.6 - -0.3));
}

TEST(PeriodicLattice, NeedsTwoCellsOnAnAxis) {
  CartesianParts parts = cut_grid({3, 4, 1}, 1, {0, 0, 0});
  parts.periodic = {false, false, true};
  EXPECT_THROW((void)lattice_mesh(Comm::self(), box_grid({3, 4, 1}, {0, 0, 0}, {1, 1, 1}), parts, 2), Error);
}

}  // namespace
}  // namespace sculpt
