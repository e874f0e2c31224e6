// The mesh does not depend on the number of ranks, to the last bit of every coordinate.
#include "same_bits.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "cases.hpp"

namespace sculpt::cli {
namespace {

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

TEST_F(SameBits, PillowCurves) {
  const Voxels voxels = grains(9, 8, 2);
  const RankMesh before = expect_same(voxels, "", {2});
  const double worst = summary(first_console(), "Min Quality");
  const RankMesh after =
      expect_same(voxels, "pillow_curves = true\npillow_curve_thresh = 0.5\npillow_curve_layers = 2\n", kFew);
  EXPECT_GT(hexes_of(after), hexes_of(before));
  EXPECT_GT(summary(first_console(), "Min Quality"), worst);
  const RankMesh unsmoothed =
      expect_same(voxels, "pillow = 202\npillow_curve_thresh = 0.5\ngen_sidesets = variable\n", kFew);
  EXPECT_EQ(hexes_of(unsmoothed), hexes_of(after)) << "the same layers, not smoothed";
}

// Usual decks ask for curve and boundary pillows; smoothing leaves nothing for them to do.
TEST_F(SameBits, PillowsWithNothingToDo) {
  const RankMesh plain = expect_same(grains(8, 6, 5), "", {2});
  const RankMesh asked = expect_same(
      grains(8, 6, 5), "pillow_curves = true\npillow_boundaries = true\npillow_curve_layers = 3\n", kFew);
  EXPECT_TRUE(asked == plain);
  EXPECT_TRUE(expect_same(grains(8, 6, 5), "pillow = domain_boundaries\n", {3}) == plain);
}

TEST_F(SameBits, PillowBoundaryLayers) {
  const Voxels voxels = grains(8, 6, 5);
  const RankMesh plain = expect_same(voxels, "", {2});
  const RankMesh layers = expect_same(voxels, "pillow_boundary_layers = 2\ngen_sidesets = rve\n", kFew);
  EXPECT_GE(summary(first_console(), "Min Quality"), 0.3);
  std::size_t on_box = 0;
  for (const auto& set : layers.side_sets) on_box += set.element.size();
  EXPECT_EQ(hexes_of(layers), hexes_of(plain) + 2 * static_cast<std::int64_t>(on_box));
}

TEST_F(SameBits, PillowSmoothOff) {
  expect_same(grains(7, 6, 5), "pillow_smooth_off = true\ngen_sidesets = variable\n", kFew);
  expect_same(grains(7, 6, 5), "pillow = 100\n", kFew);
}

TEST_F(SameBits, StairsHaveNoPillows) {
  const RankMesh stairs = expect_same(grains(6, 5, 2), "stair = full\n", {2});
  EXPECT_EQ(first_console().find("WARNING"), std::string::npos);
  EXPECT_TRUE(expect_same(grains(6, 5, 2), "stair = full\npillow = 1\n", {2}) == stairs);
  EXPECT_NE(first_console().find("WARNING: stair keeps the cells as they are"), std::string::npos);
}

TEST_F(SameBits, MicroShave) { expect_same(grains(8, 40, 11), "micro_shave = true\n", kFew); }

TEST_F(SameBits, Defeature) {
  expect_same(grains(9, 60, 13), "defeature = 1\ndefeature_bbox = true\nmin_vol_cells = 8\n", kFew);
}

TEST_F(SameBits, FilterAndCollapse) { expect_same(grains(9, 60, 15), "defeature = 3\n", kFew); }

TEST_F(SameBits, KeptMaterialsWithoutReversals) {
  const RankMesh mesh = expect_same(grains(8, 60, 14),
                                    "defeature = 1\nmicro_shave = true\nkeep_materials = true\n"
                                    "resolve_reversals = true\n",
                                    kFew);
  write("raw.spn", spn_text(grains(8, 60, 14)));
  EXPECT_EQ(hexes_by_block(mesh).size(),
            hexes_by_block(this->mesh(spn_deck(grains(8, 60, 14), "raw.spn") + "stair = fast\n", 1)).size());
}

TEST_F(SameBits, Thickened) {
  expect_same(grains(9, 6, 5), "thicken_material = 2 0.4\nthicken_material = 4 0.3\ndefeature = 1\n", kFew);
  write("f.tec", smooth_fractions());
  expect_same("input_micro = f.tec\nthicken_material = 2 0.3\n", kFew);
}

TEST_F(SameBits, ThickenedToTheInputVolume) {
  write("v.spn", spn_text(grains(10, 6, 5)));
  expect_same(grains(10, 6, 5),
              "defeature = 1\nthicken_material = 2 auto\nthicken_material = 3 auto\ncompare_volume = true\n",
              kFew);
  std::istringstream console(first_console());
  int found = 0, right = 0;
  for (std::string line; std::getline(console, line);) {
    found += line.find("(found by auto)") != std::string::npos;
    std::istringstream row(line);
    double material, input, meshed, error;  // of the table of compare_volume
    if (row >> material >> input >> meshed >> error && (material == 2 || material == 3))
      right += std::fabs(error) < 0.1 && input > 20;
  }
  EXPECT_EQ(found, 2);
  EXPECT_EQ(right, 2);
}

TEST_F(SameBits, SeparatedByVoid) {
  expect_same(grains(9, 5, 6), "thicken_void = 0.4\nthicken_material = 2 auto\n", kFew);
  const RankMesh mesh =
      expect_same(grains(9, 5, 6), "thicken_void = 1\nmesh_void = true\nvoid_mat = 77\n", kFew);
  EXPECT_EQ(hexes_by_block(mesh).count(77), 1U);
}

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
