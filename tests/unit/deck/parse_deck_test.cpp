#include <gtest/gtest.h>

#include "message.hpp"
#include "sculpt/deck/parse.hpp"

namespace sculpt {
namespace {

// One line inside an otherwise empty deck; it is line 2 of "deck.i".
Deck one_line(const std::string& line) {
  return parse_deck("BEGIN SCULPT\n" + line + "\nEND SCULPT\n", "deck.i");
}
std::string complaint(const std::string& line) {
  return message_of([&] { (void)one_line(line); });
}
std::string refusal(const std::string& text) {
  return message_of([&] { (void)parse_deck(text, "deck.i"); });
}

TEST(ParseDeck, ReadsEveryTypeOfValue) {
  const Deck deck = parse_deck(R"($ a comment before the block

begin Sculpt
  nelx = 64
  xmin = -1.5e-3
  smooth = fixed_bbox
  gen_sidesets = 2
  pillow_surfaces = true
  input_mesh_blocks = 2 4
  exodus_file = out/mesh.e
  thicken_material = 3 0.2
  thicken_material = 1 0.33
  material_name = 7 'hard phase'
  sideset = 5 0 0 0 1 1 0.5
  adapt_material = 10000 2 0.0001 0     0 $ crack
End SCULPT
)",
                               "deck.i");
  EXPECT_EQ(deck.nelx, 64);
  EXPECT_EQ(deck.xmin, -1.5e-3);
  EXPECT_EQ(deck.smooth, kSmoothFixedBbox);
  EXPECT_EQ(deck.gen_sidesets, kSidesetsVariable);
  EXPECT_TRUE(deck.pillow_surfaces);
  EXPECT_EQ(deck.input_mesh_blocks, (std::vector<std::int64_t>{2, 4}));
  EXPECT_EQ(deck.exodus_file, "out/mesh.e");
  EXPECT_EQ(deck.thicken_material, (std::vector<MaterialValue>{{3, 0.2}, {1, 0.33}}));
  EXPECT_EQ(deck.material_name, (std::vector<IdName>{{7, "hard phase"}}));
  EXPECT_EQ(deck.sideset, (std::vector<IdBox>{{5, {0, 0, 0, 1, 1, 0.5}}}));
  EXPECT_EQ(deck.adapt_material, (std::vector<NumberRecord>{{{10000, 2, 0.0001, 0, 0}}}));
  EXPECT_TRUE(deck.given("nelx"));
  EXPECT_FALSE(deck.given("nely"));
  EXPECT_EQ(deck.given_options.place("xmin"), "line 5 of deck.i");
}

TEST(ParseDeck, ToleratesTheLayoutsOfRealDecks) {
  const Deck expected = one_line("nelx = 3");
  EXPECT_EQ(one_line("nelx 3"), expected);
  EXPECT_EQ(one_line("NELX=3"), expected);
  EXPECT_EQ(one_line("\tNelX\t=\t+3 \t# three"), expected);
  EXPECT_EQ(one_line("nelx = 3$three"), expected);
  EXPECT_EQ(parse_deck("BEGIN SCULPT\r\n  nelx = 3\r\nEND SCULPT\r\n", "deck.i"), expected);
  EXPECT_EQ(
      parse_deck("\xEF\xBB\xBF# top\n\n begin sculpt $ open\nnelx=3\n end sculpt # close\n\n$ after", "d"),
      expected);
  EXPECT_EQ(parse_deck("BEGIN SCULPT\nnelx = 3\nEND SCULPT", "deck.i"), expected);
}

TEST(ParseDeck, LastLineOfAScalarWins) {
  const Deck deck = one_line("nelx = 3\nnelx = 5\ninput_mesh_blocks = 1 2\ninput_mesh_blocks = 7");
  EXPECT_EQ(deck.nelx, 5);
  EXPECT_EQ(deck.input_mesh_blocks, (std::vector<std::int64_t>{7}));
  EXPECT_EQ(deck.given_options.place("nelx"), "line 3 of deck.i");
}

TEST(ParseDeck, QuotesKeepBlanksAndCommentSigns) {
  EXPECT_EQ(one_line("input_spn = 'my $ file #1.spn' # c").input_spn, "my $ file #1.spn");
  EXPECT_EQ(one_line("input_spn = \"it's.spn\"").input_spn, "it's.spn");
  EXPECT_EQ(one_line("input_spn=a=b.spn").input_spn, "a=b.spn");
  EXPECT_EQ(complaint("input_spn = 'open.spn"), "deck.i:2: the quote ' is not closed on this line");
  EXPECT_EQ(
      complaint("input_spn = my file.spn"),
      "deck.i:2: option 'input_spn' needs one file name (in quotes if it has blanks), found 'my file.spn'");
  EXPECT_EQ(complaint("input_spn = ''"), "deck.i:2: option 'input_spn' needs a file name");
}

TEST(ParseDeck, BooleansHaveManySpellings) {
  for (const char* yes : {"true", "on", "YES", "1", ""})
    EXPECT_TRUE(one_line(std::string("compare_volume = ") + yes).compare_volume) << yes;
  for (const char* no : {"False", "off", "no", "0"}) {
    const Deck deck = one_line(std::string("check_periodic = ") + no);
    EXPECT_FALSE(deck.check_periodic) << no;
    EXPECT_TRUE(deck.given("check_periodic"));
  }
  EXPECT_TRUE(one_line("micro_shave").micro_shave);
  EXPECT_EQ(complaint("micro_shave = 2"), "deck.i:2: option 'micro_shave' needs true or false, found '2'");
  EXPECT_EQ(complaint("micro_shave = true false"),
            "deck.i:2: option 'micro_shave' needs true or false, found 'true false'");
}

TEST(ParseDeck, EnumerationsTakeNamesAliasesAndNumbers) {
  EXPECT_EQ(one_line("stair = none").stair, kStairOff);
  EXPECT_EQ(one_line("stair = on").stair, kStairFull);
  EXPECT_EQ(one_line("stair = FULL").stair, kStairFull);
  EXPECT_EQ(one_line("stair = 2").stair, kStairInterior);
  EXPECT_EQ(one_line("stair = fast").stair, kStairFast);
  EXPECT_EQ(one_line("smooth = to_geom").smooth, kSmoothToGeometry);
  EXPECT_EQ(one_line("smooth = geometry_smoothing").smooth, kSmoothGeoSmooth);
  EXPECT_EQ(one_line("smooth = no_surface_projections").smooth, kSmoothNoSurfaceProjections);
  EXPECT_EQ(one_line("smooth = 9").smooth, kSmoothNoSurfaceProjections);
  EXPECT_EQ(one_line("smooth = 8").smooth, kSmoothOn);
  EXPECT_EQ(one_line("csmooth = neighbor_surface_normal").csmooth, kCsmoothNeighborSurfaceNormal);
  EXPECT_EQ(one_line("spn_xyz_order = zyx").spn_xyz_order, kSpnZyx);
  EXPECT_EQ(one_line("spn_xyz_order = 5").spn_xyz_order, 5);
  EXPECT_EQ(one_line("gen_sidesets = rve").gen_sidesets, kSidesetsRve);
  EXPECT_EQ(one_line("pillow = 212").pillow, 212);
  EXPECT_EQ(
      complaint("spn_xyz_order = yyx"),
      "deck.i:2: option 'spn_xyz_order' needs one of xyz (0); xzy (1); yxz (2); yzx (3); zxy (4); zyx (5), "
      "found 'yyx'");
  EXPECT_EQ(complaint("stair = 4"),
            "deck.i:2: option 'stair' needs one of off, none, false (0); full, on, true (1); interior (2); "
            "fast (3), "
            "found '4'");
}

TEST(ParseDeck, RefusesWhatIsNoNumber) {
  EXPECT_EQ(complaint("nelx = 0"),
            "deck.i:2: option 'nelx' needs an integer from 1 to 1000000000, found '0'");
  for (const char* word : {"1e3", "3.0", "3x", "x", "99999999999999999999", "-4", "nan", "0x10", "+-3"})
    EXPECT_NE(complaint(std::string("nelx = ") + word).find("needs an integer"), std::string::npos) << word;
  for (const char* word : {"nan", "inf", "-inf", "1.0.0", "1e", "1e999", "2,5", "--1", "1f"})
    EXPECT_EQ(complaint(std::string("xmin = ") + word),
              std::string("deck.i:2: option 'xmin' needs a number, found '") + word + "'");
  EXPECT_EQ(complaint("opt_threshold = 1.5"),
            "deck.i:2: option 'opt_threshold' needs a number from -1 to 1, found '1.5'");
  EXPECT_EQ(complaint("cell_size = -2"),
            "deck.i:2: option 'cell_size' needs a number of at least 0, found '-2'");
  EXPECT_EQ(complaint("nelx ="), "deck.i:2: option 'nelx' needs an integer from 1 to 1000000000");
  EXPECT_EQ(complaint("nelx = 3 4"),
            "deck.i:2: option 'nelx' needs an integer from 1 to 1000000000, found '3 4'");
  EXPECT_EQ(one_line("xmin = .5").xmin, 0.5);
  EXPECT_EQ(one_line("xmin = 1E+2").xmin, 100);
}

TEST(ParseDeck, RefusesBrokenRecords) {
  EXPECT_EQ(complaint("thicken_material = 3"),
            "deck.i:2: option 'thicken_material' needs an id and a value, found '3'");
  EXPECT_EQ(complaint("thicken_material = 3 1.5"),
            "deck.i:2: option 'thicken_material' needs a number from 0 to 1, found '3 1.5'");
  EXPECT_EQ(one_line("thicken_material = 3 auto").thicken_material,
            (std::vector<MaterialValue>{{3, MaterialValue::kAuto}}));
  EXPECT_EQ(complaint("thicken_material = 3 much"),
            "deck.i:2: option 'thicken_material' needs a number from 0 to 1, found '3 much'");
  EXPECT_EQ(complaint("material_name = x copper"),
            "deck.i:2: option 'material_name' needs an integer from 0 to 2147483647, found 'x copper'");
  EXPECT_EQ(complaint("sideset = 1 0 0 0"),
            "deck.i:2: option 'sideset' needs an id and xmin ymin zmin xmax ymax zmax, found '1 0 0 0'");
  EXPECT_EQ(complaint("input_mesh_blocks ="),
            "deck.i:2: option 'input_mesh_blocks' needs integers separated by blanks");
}

TEST(ParseDeck, NamesUnknownOptionsAndTheNearestKnownOne) {
  EXPECT_EQ(complaint("nelxx = 3"), "deck.i:2: unknown option 'nelxx'; did you mean 'nelx'?");
  EXPECT_EQ(complaint("--nelx = 3"), "deck.i:2: unknown option '--nelx'; did you mean 'nelx'?");
  EXPECT_EQ(complaint("flux_capacitor = 3"), "deck.i:2: unknown option 'flux_capacitor'");
}

TEST(ParseDeck, RefusesOptionsOfTheCommandLine) {
  EXPECT_EQ(complaint("help"), "deck.i:2: option 'help' belongs on the command line, not into a deck");
  EXPECT_EQ(complaint("Version = true"),
            "deck.i:2: option 'version' belongs on the command line, not into a deck");
  EXPECT_EQ(complaint("input_file = a.i"),
            "deck.i:2: option 'input_file' belongs on the command line, not into a deck");
}

TEST(ParseDeck, NeedsItsBeginAndEnd) {
  EXPECT_EQ(refusal(""), "deck.i:0: the file has no 'BEGIN SCULPT'");
  EXPECT_EQ(refusal("$ nothing\n\n"), "deck.i:2: the file has no 'BEGIN SCULPT'");
  EXPECT_EQ(refusal("\nnelx = 3\n"), "deck.i:2: expected 'BEGIN SCULPT', found 'nelx 3'");
  EXPECT_EQ(refusal("BEGIN MESH\n"), "deck.i:1: expected 'BEGIN SCULPT', found 'BEGIN MESH'");
  EXPECT_EQ(refusal("BEGIN SCULPT\nnelx = 3\n"), "deck.i:2: the file ends without 'END SCULPT'");
  EXPECT_EQ(refusal("BEGIN SCULPT\nEND\n"), "deck.i:2: expected 'END SCULPT', found 'END'");
  EXPECT_EQ(refusal("BEGIN SCULPT\nBEGIN SCULPT\n"), "deck.i:2: a second 'BEGIN SCULPT' before 'END SCULPT'");
  EXPECT_EQ(refusal("BEGIN SCULPT\nEND SCULPT\nnelx = 3\n"), "deck.i:3: text after 'END SCULPT': 'nelx 3'");
  EXPECT_EQ(refusal(std::string(500, 'x')),
            "deck.i:1: expected 'BEGIN SCULPT', found '" + std::string(60, 'x') + "...'");
}

TEST(ParseDeck, RefusesBoundaryLayerBlocks) {
  EXPECT_EQ(complaint("begin blayer\n material = 1\nend blayer"),
            "deck.i:2: option 'begin blayer' is not supported yet");
  EXPECT_EQ(complaint("thickness = 0.1"), "deck.i:2: option 'thickness' is not supported yet");
}

TEST(ParseDeck, ReadsTheCrackDeckOfAUser) {
  const Deck deck = parse_deck(R"($ Input file created: Wed Jul 10 15:01:55 2024


BEGIN SCULPT
  diatom_file = sculpt_parallel.diatom

  xmin = -0.7215
  zmax = 0.416

  $ if you use cell_size, may not respect xmin xmax etc.
  adapt_type = material
  adapt_material = 10000 2 0.0001 0     0 $ crack
  adapt_material = 20000 3 0.0001 0.008 0 $ crack tip

  smooth = no_surface_projections $ same as fixed_bbox, but more internal smoothing.
  csmooth = neighbor_surface_normal
  opt_threshold = 0.6    $ smooth cells with jacobian less than this
  $pillow_surfaces = true
  defeature_iters = 20 $ recommend more than 10, will stop early if complete
$  max_gq_iters = 100
  defeature_bbox = false
  exodus_file = sculpt_parallel.diatom_result

END SCULPT

)",
                               "sculpt_parallel.i");
  EXPECT_EQ(deck.diatom_file, "sculpt_parallel.diatom");
  EXPECT_EQ(deck.zmax, 0.416);
  EXPECT_EQ(deck.adapt_type, kAdaptMaterial);
  ASSERT_EQ(deck.adapt_material.size(), 2u);
  EXPECT_EQ(deck.adapt_material[1].numbers, (std::vector<double>{20000, 3, 0.0001, 0.008, 0}));
  EXPECT_EQ(deck.csmooth, kCsmoothNeighborSurfaceNormal);
  EXPECT_FALSE(deck.given("pillow_surfaces"));
  EXPECT_FALSE(deck.given("max_gq_iters"));
  EXPECT_EQ(deck.exodus_file, "sculpt_parallel.diatom_result");
}

TEST(ParseDeck, ReadsTheVoxelDeckOfAUser) {
  const Deck deck = parse_deck(R"(
    BEGIN SCULPT

        # Dimensions
        nelx = 16
        nely = 16
        nelz = 16

        # Fixed mesh improvement
        smooth = 2
        pillow_curves = true
        micro_shave = true
        # scale = 2

        # Output files
        remove_bad = 0.0
        input_spn = ./results/230501224031_16/rve.spn
        exodus_file = ./results/230501224031_16/mesh.e

    END SCULPT
    )",
                               "rve.i");
  EXPECT_EQ(deck.nelz, 16);
  EXPECT_EQ(deck.smooth, kSmoothFixedBbox);
  EXPECT_TRUE(deck.pillow_curves);
  EXPECT_EQ(deck.scale, 1);
  EXPECT_EQ(deck.remove_bad, 0);
  EXPECT_EQ(deck.input_spn, "./results/230501224031_16/rve.spn");
  EXPECT_EQ(deck.given_options.place("pillow_curves"), "line 11 of rve.i");
}

}  // namespace
}  // namespace sculpt
