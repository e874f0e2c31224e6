#include "adapt/block_template.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "sculpt/geom/hex.hpp"

namespace sculpt {
namespace {

// The pattern without the bits of edges at refined faces.
BlockPattern reduced(BlockPattern p) {
  BlockPattern out = p;
  for (std::size_t b = 6; b < kBlockNeighbours; ++b)
    for (std::size_t d = 0; d < 3; ++d)
      if (kBlockOffset[b][d] != 0 && (p >> (2 * d + (kBlockOffset[b][d] > 0 ? 1 : 0)) & 1)) out &= ~(1U << b);
  return out;
}

HexCorners corners(const BlockTemplate& t, std::size_t hex) {
  HexCorners p;
  for (std::size_t c = 0; c < 8; ++c) p[c] = t.node[t.hex[hex][c]];
  return p;
}

// The faces that no second hex of the template has, by sorted nodes.
std::map<std::array<int, 4>, int> faces_of(const BlockTemplate& t) {
  std::map<std::array<int, 4>, int> count;
  for (const auto& hex : t.hex)
    for (const auto& face : kFaces) {
      std::array<int, 4> quad;
      for (std::size_t v = 0; v < 4; ++v) quad[v] = hex[static_cast<std::size_t>(face[v])];
      std::sort(quad.begin(), quad.end());
      ++count[quad];
    }
  return count;
}

TEST(BlockTemplate, PlainBlockIsEightCubes) {
  const auto t = block_template(0, 0);
  ASSERT_TRUE(t);
  EXPECT_EQ(t->hex.size(), 8U);
  EXPECT_EQ(t->node.size(), 27U);
  EXPECT_EQ(t->surface, 26U);
  for (std::size_t h = 0; h < 8; ++h) EXPECT_EQ(scaled_jacobian(corners(*t, h)), 1);
}

TEST(BlockTemplate, BesideOneRefinedFaceTheNearCellsAreCut) {
  const auto t = block_template(1U << 0, 0);  // -x
  ASSERT_TRUE(t);
  int on_face = 0;
  for (const auto& [quad, count] : faces_of(*t)) {
    const auto low = [&](int n) { return t->node[static_cast<std::size_t>(n)].x == 0; };
    on_face += std::all_of(quad.begin(), quad.end(), low);
    EXPECT_LE(count, 2);
  }
  EXPECT_EQ(on_face, 16);  // 2x2 coarse quads, each cut into four
}

// Every pattern there is: the volume is exact, every face is shared by two hexes or lies on the surface,
// positions on the surface tell nodes apart, and no hex has two faces on one side.
TEST(BlockTemplate, EveryPatternIsAValidSubdivisionOrNone) {
  int valid = 0, none = 0;
  for (BlockPattern p = 0; p < 1U << kBlockNeighbours; ++p) {
    if (reduced(p) != p) continue;
    const auto t = block_template(p, 0);
    if (!t) {
      ++none;
      continue;
    }
    ++valid;
    double volume = 0;
    for (std::size_t h = 0; h < t->hex.size(); ++h) volume += hex_volume(corners(*t, h));
    ASSERT_NEAR(volume, 8, 1e-12) << p;
    std::set<std::array<double, 3>> places;
    for (std::size_t n = 0; n < t->surface; ++n) {
      const Vec3& x = t->node[n];
      ASSERT_TRUE(places.insert({x.x, x.y, x.z}).second) << p;
      for (std::size_t d = 0; d < 3; ++d) ASSERT_EQ(8 * x[d], std::floor(8 * x[d])) << p;
    }
    for (const auto& [quad, count] : faces_of(*t)) {
      ASSERT_LE(count, 2) << p;
      if (count == 2) continue;
      int sides = 0;
      for (std::size_t side = 0; side < 6; ++side)
        sides += std::all_of(quad.begin(), quad.end(), [&](int n) {
          return t->node[static_cast<std::size_t>(n)][side / 2] == (side % 2 == 0 ? 0 : 2);
        });
      ASSERT_EQ(sides, 1) << p;
    }
    for (const auto& hex : t->hex)
      for (std::size_t side = 0; side < 6; ++side) {
        int faces = 0;
        for (const auto& face : kFaces)
          faces += std::all_of(face.begin(), face.end(), [&](int c) {
            return t->node[hex[static_cast<std::size_t>(c)]][side / 2] == (side % 2 == 0 ? 0 : 2);
          });
        if (faces > 1) ASSERT_TRUE(t->double_sides >> side & 1) << p;
      }
  }
  EXPECT_EQ(valid + none, 6210);
  EXPECT_EQ(none, 54);
}

// What lies beyond the middle plane does not matter where the block ends there.
TEST(BlockTemplate, HalfABlockIsHalfOfTheSymmetricOne) {
  const BlockPattern pattern = 1U << 2;  // -y, symmetric in x
  const auto full = block_template(pattern, 0), half = block_template(pattern, 1);
  ASSERT_TRUE(full && half);
  EXPECT_EQ(full->hex.size(), 2 * half->hex.size());
  double volume = 0;
  for (std::size_t h = 0; h < half->hex.size(); ++h) volume += hex_volume(corners(*half, h));
  EXPECT_NEAR(volume, 4, 1e-12);
}

}  // namespace
}  // namespace sculpt
