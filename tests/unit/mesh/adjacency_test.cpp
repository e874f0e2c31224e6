#include "sculpt/mesh/adjacency.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/stages.hpp"

namespace sculpt {
namespace {

using test::lattice;

TEST(FaceNeighbours, OfALatticeByHand) {
  const FaceNeighbours n = face_neighbours(lattice({3, 2, 2}));
  //                                       -y  +x  +y  -x  -z  +z
  EXPECT_EQ(n[0], (std::array<LocalId, 6>{-1, 1, 3, -1, -1, 6}));
  EXPECT_EQ(n[4], (std::array<LocalId, 6>{1, 5, -1, 3, -1, 10}));
  EXPECT_EQ(n[11], (std::array<LocalId, 6>{8, -1, -1, 10, 5, -1}));
}

TEST(FaceNeighbours, AreTheSameWithoutTheLattice) {
  for (const Index3 cells : {Index3{4, 3, 5}, Index3{1, 1, 1}, Index3{6, 1, 2}, Index3{1, 7, 1}}) {
    const HexMesh mesh = lattice(cells);
    EXPECT_EQ(face_neighbours(mesh), face_neighbours_of_any(mesh));
    HexMesh loose = mesh;
    loose.lattice = {0, 0, 0};
    EXPECT_EQ(face_neighbours(loose), face_neighbours(mesh));
  }
}

TEST(FaceNeighbours, FollowTheNodesWhateverTheCornerOrder) {
  HexMesh mesh = lattice({2, 1, 1});
  const Hex h = mesh.hexes[1];
  mesh.hexes[1] = {h[4], h[7], h[6], h[5], h[0], h[3], h[2], h[1]};  // turned over: -x becomes face 0
  const FaceNeighbours n = face_neighbours_of_any(mesh);
  EXPECT_EQ(n[0][1], 1);
  EXPECT_EQ(std::count(n[1].begin(), n[1].end(), 0), 1);
  EXPECT_EQ(n[1][0], 0);
}

TEST(FaceNeighbours, OfTurnedHexesAreTheSameCells) {
  const HexMesh mesh = lattice({5, 4, 3}), turned = test::turned(mesh);
  FaceNeighbours all = face_neighbours(mesh), found = face_neighbours(turned);
  for (std::size_t h = 0; h < all.size(); ++h) {
    for (std::size_t f = 0; f < 6; ++f) {
      if (found[h][f] == kNone) continue;
      std::array<LocalId, 4> nodes;
      for (std::size_t v = 0; v < 4; ++v) nodes[v] = turned.hexes[h][static_cast<std::size_t>(kFaces[f][v])];
      EXPECT_GE(face_with_nodes(turned.hexes[at(found[h][f])], nodes), 0);
    }
    std::sort(all[h].begin(), all[h].end());
    std::sort(found[h].begin(), found[h].end());
    EXPECT_EQ(found[h], all[h]);
  }
}

TEST(NodeHexes, ListsHexAndCornerAscending) {
  const HexMesh mesh = lattice({3, 3, 2});
  const NodeHexes around(mesh);
  EXPECT_EQ(around.largest(), 8U);
  std::size_t total = 0;
  for (LocalId n = 0; n < mesh.nodes(); ++n) {
    const auto items = around[n];
    total += items.size();
    EXPECT_TRUE(std::is_sorted(items.begin(), items.end()));
    for (const std::int32_t item : items)
      EXPECT_EQ(mesh.hexes[static_cast<std::size_t>(item / 8)][static_cast<std::size_t>(item % 8)], n);
  }
  EXPECT_EQ(total, 8 * mesh.hexes.size());
  EXPECT_EQ(around[0].size(), 1U);
  EXPECT_EQ(around[1 + 4 + 16].size(), 8U);  // node (1,1,1)
}

TEST(FaceWithNodes, FindsTheFaceInAnyOrder) {
  const Hex hex{10, 11, 12, 13, 14, 15, 16, 17};
  for (std::size_t f = 0; f < 6; ++f) {
    std::array<LocalId, 4> nodes;
    for (std::size_t v = 0; v < 4; ++v) nodes[v] = 10 + kFaces[f][3 - v];
    EXPECT_EQ(face_with_nodes(hex, nodes), static_cast<int>(f));
    std::swap(nodes[0], nodes[1]);
    EXPECT_EQ(face_with_nodes(hex, nodes), static_cast<int>(f));
  }
  EXPECT_EQ(face_with_nodes(hex, {10, 12, 14, 16}), -1);
  EXPECT_EQ(face_with_nodes(hex, {10, 11, 12, 99}), -1);
}

TEST(HeldOnBox, TakesAwayWhatLeavesTheSides) {
  const Vec3 move{1, 2, 3};
  EXPECT_EQ(held_on_box(move, 0), move);
  EXPECT_EQ(held_on_box(move, kXmin), (Vec3{0, 2, 3}));
  EXPECT_EQ(held_on_box(move, kXmax | kZmin), (Vec3{0, 2, 0}));
  EXPECT_EQ(held_on_box(move, kXmin | kYmax | kZmax), Vec3{});
}

}  // namespace
}  // namespace sculpt
