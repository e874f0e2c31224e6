// The mesh does not depend on the number of ranks, to the last bit of every coordinate.
#include <gtest/gtest.h>

#include <cstring>

#include "cases.hpp"
#include "scratch.hpp"

namespace sculpt::cli {
namespace {

using Ranks = std::vector<int>;
const Ranks kMany{2, 3, 4, 5, 7, 8, 16};
const Ranks kFew{2, 5};

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

class SameBits : public Scratch {
 protected:
  // Returns the mesh of one rank.
  RankMesh expect_same(const std::string& deck, const Ranks& ranks) {
    const RankMesh alone = mesh(deck, 1);
    const std::string console_alone = console();
    EXPECT_GT(hexes_of(alone), 0);
    for (const int n : ranks) {
      SCOPED_TRACE("ranks: " + std::to_string(n));
      const RankMesh together = mesh(deck, n);
      EXPECT_TRUE(same_bits(together.x, alone.x) && same_bits(together.y, alone.y) &&
                  same_bits(together.z, alone.z))
          << "coordinates differ";
      EXPECT_EQ(together.node_id, alone.node_id);
      EXPECT_EQ(together.hex_id, alone.hex_id);
      EXPECT_TRUE(together == alone) << "blocks, connectivity or sets differ";
      for (const char* label :
           {"Num Nodes", "Num Elements", "Num Blocks", "Min Quality", "Avg Quality", "Min Edge Len"})
        EXPECT_EQ(summary(console(), label), summary(console_alone, label)) << label;
    }
    first_console_ = console_alone;
    return alone;
  }
  RankMesh expect_same(const Voxels& voxels, const std::string& more, const Ranks& ranks) {
    write("v.spn", spn_text(voxels));
    return expect_same(spn_deck(voxels, "v.spn") + more, ranks);
  }
  [[nodiscard]] const std::string& first_console() const { return first_console_; }

 private:
  std::string first_console_;
};

TEST_F(SameBits, LetterF) { expect_same(letter_f(), "", kMany); }

TEST_F(SameBits, OneLayer) { expect_same(one_layer(), "", kMany); }

TEST_F(SameBits, Grains) {
  const RankMesh mesh = expect_same(grains(16, 25, 7), "", kMany);
  EXPECT_EQ(mesh.blocks.size(), 25U);
  EXPECT_GE(summary(first_console(), "Min Quality"), 0.3);
}

TEST_F(SameBits, TwoSpheres) {
  write("spheres.diatom", two_spheres());
  const RankMesh mesh = expect_same(two_spheres_deck("spheres.diatom"), kMany);
  EXPECT_EQ(hexes_of(mesh), 1224);
  EXPECT_EQ(hexes_by_block(mesh).size(), 2U);
  EXPECT_GE(summary(first_console(), "Min Quality"), 0.3838);  // what Sculpt reaches
}

TEST_F(SameBits, SmoothFractions) {
  write("f.tec", smooth_fractions());
  const RankMesh mesh = expect_same("input_micro = f.tec\n", kMany);
  EXPECT_EQ(hexes_by_block(mesh).size(), 3U);
}

TEST_F(SameBits, MeshedVoid) {
  write("spheres.diatom", two_spheres());
  const RankMesh mesh =
      expect_same(two_spheres_deck("spheres.diatom") + "mesh_void = true\nvoid_mat = 9\n", kFew);
  EXPECT_EQ(hexes_by_block(mesh).count(9), 1U);
}

TEST_F(SameBits, MicroExpand) { expect_same(grains(7, 6, 3), "micro_expand = 2\n", kFew); }

TEST_F(SameBits, PillowSurfaces) { expect_same(grains(8, 6, 5), "pillow_surfaces = true\n", kFew); }

TEST_F(SameBits, MicroShave) { expect_same(grains(8, 40, 11), "micro_shave = true\n", kFew); }

TEST_F(SameBits, FixedBox) { expect_same(grains(8, 6, 5), "smooth = fixed_bbox\ncsmooth = vfrac\n", kFew); }

TEST_F(SameBits, GuaranteedQuality) {
  expect_same(grains(8, 8, 4), "max_gq_iters = 6\ngq_threshold = 0.5\n", kFew);
}

TEST_F(SameBits, OnTheSpheres) {
  write("spheres.diatom", two_spheres());
  expect_same(two_spheres_deck("spheres.diatom") + "smooth = to_geometry\n", kFew);
}

TEST_F(SameBits, NearTheGeometry) {
  expect_same(grains(8, 8, 4), "smooth = geo_smooth\ngeo_smooth_max_deviation = 0.3\n", kFew);
}

TEST_F(SameBits, Quadrics) {
  expect_same(grains(8, 8, 4), "smooth = 2\nsurface_projection = quadric\n", kFew);
}

TEST_F(SameBits, PublishedMethod) {
  expect_same(grains(8, 8, 4), "opt_method = jacobi\npcol_threshold = 0.2\n", kFew);
}

TEST_F(SameBits, UnmeshedVoid) { expect_same(letter_f(), "void_mat = 1\n", kFew); }

TEST_F(SameBits, Stairs) {
  expect_same(grains(6, 5, 2), "stair = full\n", kFew);
  const RankMesh raw = expect_same(letter_f(), "stair = fast\n", kFew);
  EXPECT_EQ(hexes_by_block(raw), (std::map<std::int64_t, std::int64_t>{{1, 40}, {2, 20}}));
}

TEST_F(SameBits, InteriorStair) {
  write("f.tec", smooth_fractions());
  expect_same("input_micro = f.tec\nstair = interior\n", kFew);
}

TEST_F(SameBits, MoreRanksThanCells) {
  const Voxels two{2, 1, 1, [](int i, int, int) { return i + 1; }};
  EXPECT_EQ(hexes_of(expect_same(two, "", {3, 6})), 4);
}

// The cut of the grid may be chosen, also badly.
TEST_F(SameBits, ChosenSegments) {
  write("v.spn", spn_text(letter_f()));
  const std::string deck = spn_deck(letter_f(), "v.spn");
  const RankMesh alone = mesh(deck, 1);
  EXPECT_TRUE(mesh(deck + "iproc = 1\njproc = 5\nkproc = 1\n", 5) == alone);
  EXPECT_TRUE(mesh(deck + "iproc = 2\njproc = 1\nkproc = 2\n", 4) == alone);
}

TEST_F(SameBits, Transformed) {
  expect_same(letter_f(), "xscale = 0.1\nyscale = 3.7\nxtranslate = 1e3\nztranslate = -0.3\n", kFew);
}

// 552 cells lie inside the larger sphere; the stair mesh shows them.
TEST_F(SameBits, CellsOfTwoSpheres) {
  write("spheres.diatom", two_spheres());
  EXPECT_EQ(hexes_of(expect_same(two_spheres_deck("spheres.diatom") + "stair = full\n", {3})), 552);
}

}  // namespace
}  // namespace sculpt::cli
