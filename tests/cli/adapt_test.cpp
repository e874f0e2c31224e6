// Refined, coarsened and resampled grids, from the deck to the joined mesh: the same bits for any number of
// ranks, and one message for what cannot be done.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bad_input.hpp"
#include "same_bits.hpp"
#include "sculpt/exo/read_exodus.hpp"

namespace sculpt::cli {
namespace {

const Ranks kPair{3, 8};

// 13 x 10 x 9 voxels, no multiple of 4 along any axis.
Voxels odd_grains() {
  Voxels voxels = grains(13, 6, 7);
  voxels.ny = 10;
  voxels.nz = 9;
  return voxels;
}

// Blocks that a run refined, as the console has it; 0 when it refined none.
double refined_blocks(const std::string& console) {
  const std::string words = "adapting the grid: ";
  const std::size_t found = console.find(words);
  return found == std::string::npos ? 0 : std::stod(console.substr(found + words.size()));
}

double width(const std::vector<double>& x) {
  return *std::max_element(x.begin(), x.end()) - *std::min_element(x.begin(), x.end());
}

class Adapt : public SameBits {
 protected:
  // The two spheres on a quarter of the cells per axis.
  std::string spheres() {
    write("spheres.diatom", two_spheres());
    return two_spheres_deck("spheres.diatom") + "nelx = 8\nnely = 8\nnelz = 8\n";
  }
  // Refined everywhere that it should be, and good.
  RankMesh expect_refined(const std::string& deck, const Ranks& ranks) {
    RankMesh mesh = expect_same(deck, ranks);
    EXPECT_GT(refined_blocks(first_console()), 0);
    EXPECT_GE(summary(first_console(), "Min Quality"), 0.3);
    return mesh;
  }
  RankMesh expect_refined(const Voxels& voxels, const std::string& more, const Ranks& ranks) {
    write("v.spn", spn_text(voxels));
    return expect_refined(spn_deck(voxels, "v.spn") + more, ranks);
  }
};

TEST_F(Adapt, FractionsOnSpheres) {
  const std::string deck = spheres() + "adapt_type = vfrac_average\n";
  const std::int64_t coarse = hexes_of(mesh(spheres(), 1)),
                     once = hexes_of(expect_refined(deck + "adapt_levels = 1\n", {2, 3, 5, 8})),
                     twice = hexes_of(expect_refined(deck + "adapt_levels = 2\n", {2, 3, 5, 8}));
  EXPECT_GT(once, 3 * coarse);
  EXPECT_GT(twice, 3 * once);
  EXPECT_EQ(hexes_of(mesh(deck + "adapt_levels = 0\n", 1)), coarse);
  EXPECT_NE(console().find("adapt_levels = 0 leaves the grid as it is"), std::string::npos);
}

// A large threshold refines less.
TEST_F(Adapt, ThresholdOfFractions) {
  const std::string deck = spheres() + "mesh_void = true\nadapt_type = vfrac_average\nadapt_threshold = ";
  const std::int64_t fine = hexes_of(mesh(deck + "0\n", 1)),
                     less = hexes_of(expect_refined(deck + "0.4\n", {3}));
  EXPECT_LT(less, fine);
  (void)mesh(deck + "1\n", 1);
  EXPECT_EQ(refined_blocks(console()), 0);
}

TEST_F(Adapt, Distances) {
  for (const std::string type : {"facet_to_surface", "surface_to_facet", "surface_to_surface"}) {
    SCOPED_TRACE(type);
    const std::string deck = spheres() + "mesh_void = true\nadapt_type = " + type + "\nadapt_threshold = ";
    expect_refined(deck + "0.05\n", {5});
    const double fine = refined_blocks(first_console());
    (void)mesh(deck + "0.4\n", 1);
    EXPECT_LT(refined_blocks(console()), fine);
    (void)mesh(deck + "3\n", 1);
    EXPECT_EQ(refined_blocks(console()), 0);
  }
}

TEST_F(Adapt, Materials) {
  const std::string deck = spheres() + "mesh_void = true\nadapt_type = material\n";
  const std::int64_t inner = hexes_of(expect_refined(deck + "adapt_material = 1\n", kPair));
  const std::int64_t both =
      hexes_of(expect_refined(deck + "adapt_material = 1 2 0.01 1.5\nadapt_material = 2 1\n", kPair));
  EXPECT_GT(both, inner);
  // A record may go deeper than the default of adapt_levels, but not than what is given.
  (void)mesh(deck + "adapt_material = 1 3\n", 1);
  EXPECT_NE(console().find("  level 3: "), std::string::npos);
  (void)mesh(deck + "adapt_material = 1 3\nadapt_levels = 1\n", 1);
  EXPECT_EQ(console().find("  level 2: "), std::string::npos);
  (void)mesh(deck, 1);
  EXPECT_EQ(refined_blocks(console()), 0);
  EXPECT_NE(console().find("WARNING: adapt_type = material without adapt_material"), std::string::npos);
}

// Pillows on all surfaces and at the box, where refinement reaches it.
TEST_F(Adapt, Pillowed) {
  expect_refined(spheres() +
                     "zmax = 0\nnelz = 4\nmesh_void = true\nadapt_type = vfrac_average\n"
                     "adapt_levels = 1\npillow_surfaces = true\npillow_boundaries = true\n",
                 {2, 3, 8});
}

TEST_F(Adapt, BalancedByNumbersOfCells) {
  const std::string deck = spheres() + "adapt_type = vfrac_average\n";
  const RankMesh plain = mesh(deck, 1);
  for (const int ranks : {2, 5, 8})
    EXPECT_TRUE(mesh(deck + "adapt_load_balance = true\n", ranks) == plain) << ranks;
}

TEST_F(Adapt, CoarsenedVoxels) {
  const Voxels voxels = odd_grains();
  write("v.spn", spn_text(voxels));
  const std::int64_t dense = hexes_of(mesh(spn_deck(voxels, "v.spn"), 1));
  const RankMesh dropped = expect_refined(voxels, "adapt_type = coarsen\n", {2, 3, 5, 8});
  EXPECT_NE(first_console().find("WARNING: coarsen: the grid is not a multiple of 4 cells; dropped"),
            std::string::npos);
  EXPECT_LT(hexes_of(dropped), dense);
  EXPECT_EQ(width(dropped.x), 12);
  EXPECT_EQ(width(dropped.y), 8);
  EXPECT_EQ(width(dropped.z), 8);
  const RankMesh kept = expect_refined(voxels, "adapt_type = coarsen\nadapt_remainder = keep\n", kPair);
  EXPECT_NE(first_console().find("kept at the high sides"), std::string::npos);
  EXPECT_EQ(width(kept.x), 13);
  EXPECT_EQ(width(kept.y), 10);
  EXPECT_EQ(width(kept.z), 9);
}

// An interface through transitions at the box: hexes there touch the box in an edge, and the layers of buffer
// hexes close over it.
TEST_F(Adapt, InterfacesThroughTransitionsAtTheBox) {
  const Voxels waves{48, 16, 16, [](int i, int j, int k) {
                       const double w = std::sin(0.31 * i + 0.2 * j) + std::sin(0.27 * j - 0.11 * k) +
                                        std::sin(0.23 * k + 0.1 * i);
                       return w > 0.2 ? 1 : 2;
                     }};
  for (const char* threshold : {"0.6", "0.7"}) {
    expect_same(waves,
                std::string("adapt_type = coarsen\nadapt_levels = 2\nadapt_threshold = ") + threshold + "\n",
                {3});
    EXPECT_GE(summary(first_console(), "Min Quality"), 0.3) << threshold;
  }
}

// Where a cell of three voxels is all that differs, a threshold lets it go.
TEST_F(Adapt, CoarsenedWithAThreshold) {
  const Voxels speck{16, 16, 16, [](int i, int j, int k) {
                       const bool dot = i == 4 && j == 5 && k == 6;
                       return dot ? 3 : i + j > 17 ? 2 : 1;
                     }};
  const RankMesh all = expect_refined(speck, "adapt_type = coarsen\nadapt_threshold = 0\n", kPair);
  const double blocks = refined_blocks(first_console());
  const RankMesh fewer = expect_refined(speck, "adapt_type = coarsen\nadapt_threshold = 0.2\n", kPair);
  EXPECT_LT(refined_blocks(first_console()), blocks);
  EXPECT_EQ(hexes_by_block(all).size(), 3U);
  EXPECT_EQ(hexes_by_block(fewer).size(), 2U);
}

TEST_F(Adapt, ResampledVoxels) {
  const RankMesh mesh =
      expect_same(odd_grains(), "adapt_type = resample\nadapt_levels = 1\nstair = fast\n", {2, 3, 5, 8});
  EXPECT_EQ(hexes_of(mesh), 6 * 5 * 4);
  EXPECT_EQ(width(mesh.x), 12);
  expect_same(odd_grains(), "adapt_type = resample\nadapt_levels = 1\nadapt_remainder = keep\n", kPair);
}

TEST_F(Adapt, NonManifoldPlaces) {
  const Voxels checkers{8, 8, 8, [](int i, int j, int k) { return i / 4 + j / 4 == 1 && k > 2 ? 2 : 1; }};
  const std::string deck = "adapt_type = vfrac_average\nadapt_threshold = 1\nadapt_levels = 1\n";
  const RankMesh plain = expect_same(checkers, deck, {3});
  EXPECT_EQ(refined_blocks(first_console()), 0);
  const RankMesh refined = expect_refined(checkers, deck + "adapt_non_manifold = true\n", kPair);
  EXPECT_GT(hexes_of(refined), hexes_of(plain));
}

TEST_F(Adapt, Stairs) {
  const std::string deck = spheres() + "mesh_void = true\nadapt_type = vfrac_average\nadapt_levels = 1\n";
  const RankMesh fast = expect_same(deck + "stair = fast\n", kPair);
  // All cells of the refined grid; 8 more per refined block of 8 and those of transitions.
  EXPECT_GT(hexes_of(fast), 8 * 8 * 8 + static_cast<std::int64_t>(56 * refined_blocks(first_console())));
  EXPECT_GE(summary(first_console(), "Min Quality"), 0.3);
  EXPECT_EQ(width(fast.x), 32);
  EXPECT_EQ(hexes_of(expect_refined(deck + "stair = full\n", kPair)), hexes_of(fast));
  expect_refined(odd_grains(), "adapt_type = coarsen\nadapt_levels = 1\nstair = full\n", {3});
}

TEST_F(Adapt, VolumeFractions) {
  write("f.tec", smooth_fractions());
  const std::string deck = "input_micro = f.tec\nadapt_type = vfrac_average\nadapt_levels = 1\n";
  expect_refined(deck, {2, 3, 8});
  const double blocks = refined_blocks(first_console());
  expect_refined(deck + "micro_expand = 1\nadapt_threshold = 0.5\n", {3});
  EXPECT_LT(refined_blocks(first_console()), blocks + 30);
  expect_refined("input_micro = f.tec\nadapt_type = coarsen\nadapt_levels = 1\n", kPair);
}

// Data have no surface finer than their cells.
TEST_F(Adapt, NoDistancesInData) {
  write("f.tec", smooth_fractions());
  const std::string deck = "input_micro = f.tec\n";
  const std::int64_t plain = hexes_of(mesh(deck, 1));
  EXPECT_EQ(hexes_of(mesh(deck + "adapt_type = surface_to_surface\nadapt_threshold = 0\n", 1)), plain);
  EXPECT_NE(console().find("WARNING: surface_to_surface"), std::string::npos);
}

TEST_F(Adapt, ExodusGrids) {
  const Voxels voxels = grains(6, 4, 2);
  write("v.spn", spn_text(voxels));
  write("grid.i",
        "BEGIN SCULPT\n" + spn_deck(voxels, "v.spn") + "stair = fast\nexodus_file = grid\nEND SCULPT\n");
  succeed({"sculpt", "-i", "grid.i"});
  succeed({"eputool", "-p", "1", "grid"});
  const std::string more = "adapt_type = vfrac_average\nadapt_levels = 1\n";
  const RankMesh from_exodus = expect_refined("input_cart_exo = grid.e\n" + more, kPair);
  EXPECT_EQ(hexes_of(from_exodus), hexes_of(mesh(spn_deck(voxels, "v.spn") + more, 1)));
}

TEST_F(Adapt, OneCellThick) {
  expect_refined(one_layer(), "adapt_type = vfrac_average\nadapt_levels = 1\n", {2, 3, 5, 8});
  expect_refined(one_layer(), "adapt_type = coarsen\nadapt_levels = 1\nadapt_remainder = keep\n", kPair);
}

TEST_F(Adapt, PeriodicGrids) {
  const std::string deck =
      spheres() +
      "xmax = 12\nymax = 12\nzmax = 12\nxmin = -12\nymin = -12\nzmin = -12\nmesh_void = true\n"
      "periodic = true\nadapt_type = vfrac_average\nadapt_levels = 1\nadapt_threshold = 0.2\n";
  expect_refined(deck, kPair);
  expect_refined(deck + "adapt_load_balance = true\n", {3});
  expect_refined(grains(12, 5, 3), "periodic = true\nadapt_type = coarsen\nadapt_levels = 1\n", kPair);
}

TEST_F(Adapt, MoreRanksThanBlocks) {
  const Voxels two{2, 1, 1, [](int i, int, int) { return i + 1; }};
  EXPECT_EQ(hexes_of(expect_refined(two, "adapt_type = vfrac_average\nadapt_levels = 1\n", {3, 6})), 24);
}

// adapt_export writes the grid, conforming and the same for any number of ranks, beside the mesh.
TEST_F(Adapt, ExportedGrid) {
  const std::string deck = spheres() + "mesh_void = true\nadapt_type = vfrac_average\nadapt_export = true\n";
  RankMesh first;
  for (const int ranks : {1, 3}) {
    const std::string n = std::to_string(ranks), base = "mesh" + n + "_adapt";
    const RankMesh whole = mesh(deck, ranks);
    succeed({"eputool", "-p", n, base});
    const RankMesh grid = read_exodus(path(base + ".e"));
    EXPECT_EQ(width(grid.x), 32);
    EXPECT_LT(hexes_of(grid), hexes_of(whole)) << "no buffer hexes yet";
    EXPECT_TRUE(ranks == 1 || grid == first);
    first = grid;
    // Every level is told, and together they are the grid.
    std::int64_t told = 0;
    for (const std::string& line : lines_of(console())) {
      int level = 0;
      long long cubes = 0, transition = 0;
      if (std::sscanf(line.c_str(), "  level %d: %lld cubes, %lld hexes", &level, &cubes, &transition) > 1)
        told += cubes + transition;
    }
    EXPECT_EQ(told, hexes_of(grid));
  }
}

// Options without effect are taken and told.
TEST_F(Adapt, IdleOptionsAreTold) {
  const std::string deck = spheres();
  const RankMesh plain = mesh(deck, 1);
  const RankMesh idle = mesh(deck + "adapt_levels = 3\nadapt_threshold = 0.01\nadapt_material = 1\n", 1);
  EXPECT_TRUE(idle == plain);
  EXPECT_NE(console().find("WARNING: adapt_type is off; no effect: adapt_threshold, adapt_levels, "
                           "adapt_material"),
            std::string::npos);
}

std::vector<Mistake> adapt_mistakes() {
  const auto voxels = [](const std::string& more) { return [more](BadInput& t) { t.write_deck(more); }; };
  const auto spheres = [](const std::string& more) {
    return [more](BadInput& t) {
      t.write("s.diatom", two_spheres());
      t.write("deck.i", "BEGIN SCULPT\n" + two_spheres_deck("s.diatom") + more + "END SCULPT\n");
    };
  };
  return {
      {"TooManyDoublings",
       voxels("adapt_type = coarsen\nadapt_levels = 3\n"),
       {"adapt_levels", "line 7 of deck.i", "3 cells along x cannot be halved 3 times", "keep"}},
      {"DefaultLevelsDoNotFit",
       voxels("adapt_type = resample\n"),
       {"'adapt_levels' (not given)", "3 cells along x cannot be halved 2 times"}},
      {"AbsurdLevels",
       spheres("adapt_type = vfrac_average\nadapt_levels = 20\n"),
       {"adapt_levels", "line 13 of deck.i", "16 x 16 x 16 cells", "20 times"}},
      {"LevelsOutOfRange",
       spheres("adapt_type = vfrac_average\nadapt_levels = 21\n"),
       {"adapt_levels", "13", "21", "20"}},
      {"FacetsOfVoxels",
       voxels("adapt_type = facet_to_surface\n"),
       {"adapt_type", "line 6 of deck.i", "facet_to_surface", "vfrac_average"}},
      {"UnknownMaterial",
       voxels("adapt_type = material\nadapt_material = 9 1\n"),
       {"adapt_material", "line 7 of deck.i", "no material with id 9"}},
      {"RecordWithoutSense",
       voxels("adapt_type = material\nadapt_material = 1 1.5\n"),
       {"adapt_material", "line 7 of deck.i", "levels", "1.5"}},
      {"CoarsenedShapes",
       spheres("adapt_type = coarsen\n"),
       {"adapt_type", "line 12 of deck.i", "dense grid"}},
      {"CoarsenedExpansion",
       voxels("adapt_type = coarsen\nmicro_expand = 1\n"),
       {"micro_expand", "line 7 of deck.i", "coarsen"}},
      {"OddPeriod",
       voxels("adapt_type = vfrac_average\nperiodic = true\n"),
       {"periodic", "even number of cells along x, found 3"}},
      {"TooSmallMargins",
       voxels("adapt_type = material\nadapt_material = 1 1 0 -3\n"),
       {"adapt_material", "distance", "-3"}},
  };
}

class AdaptRefused : public Refused {};

TEST_P(AdaptRefused, WithOneMessage) { expect_refused_once(); }

INSTANTIATE_TEST_SUITE_P(, AdaptRefused,
                         ::testing::Combine(::testing::ValuesIn(adapt_mistakes()), ::testing::Values(1, 3)),
                         mistake_name);

}  // namespace
}  // namespace sculpt::cli
