#include "sculpt/mesh/edit.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "support/mesh_checks.hpp"
#include "support/stages.hpp"

namespace sculpt {
namespace {

HexMesh row(std::int32_t cells) {
  std::vector<std::int32_t> material(static_cast<std::size_t>(cells));
  std::iota(material.begin(), material.end(), 0);
  return test::overlay(test::voxels({cells, 1, 1}, material)).cells;
}

TEST(Transform, ScalesThenTranslates) {
  HexMesh mesh = row(2);
  transform(mesh, {2, 0.5, 4}, {10, 0, 1});
  EXPECT_EQ(mesh.position.front(), (Vec3{10, 0, 1}));
  EXPECT_EQ(mesh.position.back(), (Vec3{14, 0.5, 5}));
  EXPECT_EQ(mesh.cell_size, (Vec3{2, 0.5, 4}));
  EXPECT_NEAR(test::volume(mesh), 8, 1e-14);
}

TEST(RemoveHexes, TakesTheirNodesAlongAndKeepsIds) {
  HexMesh mesh = row(4);
  const HexMesh before = mesh;
  const std::vector<LocalId> index = remove_hexes(Comm::self(), mesh, std::vector<std::uint8_t>{1, 0, 1, 0});
  EXPECT_EQ(index, (std::vector<LocalId>{kNone, 0, kNone, 1}));
  EXPECT_EQ(mesh.hex_id, (std::vector<GlobalId>{1, 3}));
  EXPECT_EQ(mesh.material, (std::vector<std::int32_t>{1, 3}));
  EXPECT_EQ(mesh.nodes(), 16) << "the four nodes at x = 0 are gone";
  for (LocalId h = 0; h < 2; ++h) {
    const auto old = static_cast<LocalId>(mesh.hex_id[at(h)]);
    EXPECT_EQ(mesh.corners(h), before.corners(old));
    for (std::size_t c = 0; c < 8; ++c)
      EXPECT_EQ(mesh.node_id[at(mesh.hexes[at(h)][c])], before.node_id[at(before.hexes[at(old)][c])]);
  }
  EXPECT_EQ(test::conformity_problem(mesh, 0), "");
}

TEST(RemoveHexes, KeepsTheSizesAroundTheNodesThatStay) {
  HexMesh mesh = row(3);
  for (LocalId n = 0; n < mesh.nodes(); ++n) mesh.node_unit.push_back(static_cast<float>(n % 4));
  mesh.lattice = {0, 0, 0};
  (void)remove_hexes(Comm::self(), mesh, std::vector<std::uint8_t>{1, 0, 0});
  ASSERT_EQ(mesh.node_unit.size(), mesh.position.size());
  for (LocalId n = 0; n < mesh.nodes(); ++n) EXPECT_EQ(mesh.node_unit[at(n)], mesh.position[at(n)].x);
}

TEST(HexMesh, LengthsInCellsAreThoseOfTheSmallestCellsAround) {
  HexMesh mesh = row(2);
  mesh.cell_size = {2, 4, 8};
  EXPECT_EQ(mesh.unit(0), 1);
  EXPECT_EQ(mesh.hex_unit(0), 1);
  EXPECT_EQ(mesh.per_cell(0), (Vec3{0.5, 0.25, 0.125}));
  mesh.node_unit.assign(mesh.position.size(), 1);
  mesh.node_unit[at(mesh.hexes[0][3])] = 0.25F;
  EXPECT_EQ(mesh.unit(mesh.hexes[0][3]), 0.25);
  EXPECT_EQ(mesh.per_cell(mesh.hexes[0][3]), (Vec3{2, 1, 0.5}));
  EXPECT_EQ(mesh.hex_unit(0), 0.25);
  EXPECT_EQ(mesh.hex_unit(1), 1);
}

TEST(RemoveHexes, OfNothingChangesNothing) {
  HexMesh mesh = row(3);
  const HexMesh before = mesh;
  const std::vector<LocalId> index = remove_hexes(Comm::self(), mesh, std::vector<std::uint8_t>(3, 0));
  EXPECT_EQ(index, (std::vector<LocalId>{0, 1, 2}));
  EXPECT_EQ(mesh.hexes, before.hexes);
  EXPECT_EQ(mesh.position, before.position);
  EXPECT_EQ(mesh.node_id, before.node_id);
}

}  // namespace
}  // namespace sculpt
