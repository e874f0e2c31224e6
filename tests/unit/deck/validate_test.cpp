#include <gtest/gtest.h>

#include "message.hpp"
#include "sculpt/deck/options.hpp"
#include "sculpt/deck/parse.hpp"

namespace sculpt {
namespace {

Deck deck_of(const std::string& lines) {
  return parse_deck("BEGIN SCULPT\n" + lines + "\nEND SCULPT\n", "deck.i");
}
std::string verdict(const std::string& lines) {
  return message_of([&] { validate(deck_of(lines)); });
}
const std::string kSpn = "input_spn = a.spn\nnelx = 3\nnely = 4\nnelz = 5\n";  // lines 2 to 5

TEST(Validate, AcceptsEverySupportedOption) {
  EXPECT_EQ(verdict(kSpn + R"(num_procs = 6
iproc = 3
jproc = 1
kproc = 2
quiet = true
spn_xyz_order = zyx
compress_spn_ids = true
exodus_file = out
large_exodus = true
compare_volume = true
xmin = 0
xmax = 1
stair = fast
mesh_void = true
void_mat = 7
material_name = 1 iron
gen_sidesets = rve
smooth = 3
csmooth = linear
laplacian_iters = 3
max_opt_iters = 50
opt_threshold = 0.7
curve_opt_thresh = -1
max_pcol_iters = 0
pcol_threshold = 0.2
max_gq_iters = 5
gq_threshold = 0.4
geo_smooth_max_deviation = 0.1
surface_projection = quadric
opt_method = jacobi
opt_damping = false
opt_metric = shape_and_size
pillow_surfaces = true
pillow = 1
micro_expand = 2
micro_shave = true
xtranslate = -1
yscale = 2
scale = 40)"),
            "no error");
  EXPECT_EQ(verdict("input_micro = a.tec"), "no error");
  EXPECT_EQ(verdict("input_cart_exo = a.g\ngen_sidesets = fixed"), "no error");
  EXPECT_EQ(
      verdict("diatom_file = a\nnelx=1\nnely=1\nnelz=1\nxmin=0\nymin=0\nzmin=0\nxmax=1\nymax=1\nzmax=1"),
      "no error");
}

TEST(Validate, RefusesUnsupportedOptionsWithTheirPlace) {
  EXPECT_EQ(verdict(kSpn + "htet = 0.2"), "option 'htet' (line 6 of deck.i) is not supported yet");
  EXPECT_EQ(verdict("input_stitch = a.st"), "option 'input_stitch' (line 2 of deck.i) is not supported yet");
  EXPECT_EQ(verdict(kSpn + "periodic_axis = z"),
            "option 'periodic_axis' (line 6 of deck.i) is not supported yet");
  const CommandLine line = parse_command_line(std::vector<std::string>{"-dg", "0.5"}, read_deck_file);
  EXPECT_EQ(message_of([&] { validate(line.deck); }),
            "option 'deg_threshold' (command line) is not supported yet");
}

TEST(Validate, VolumeFractionsHaveNoGeometryAndFilesOfTheirOwn) {
  EXPECT_EQ(verdict(kSpn + "volfrac_file = v"), "no error");
  EXPECT_EQ(verdict("input_vfrac = v"), "no error");
  for (const char* line : {"smooth = to_geometry", "capture = 5"})
    EXPECT_TRUE(verdict(std::string("input_vfrac = v\n") + line)
                    .starts_with("smooth = to_geometry and capture need the geometry itself"));
  EXPECT_TRUE(
      verdict(kSpn + "volfrac_file = v\nexodus_file = v").starts_with("volfrac_file would write over"));
  EXPECT_TRUE(verdict("input_vfrac = v\nvolfrac_file = v").starts_with("volfrac_file would write over"));
  EXPECT_TRUE(verdict("input_vfrac = v\nexodus_file = v").starts_with("the mesh would be written over"));
}

TEST(Validate, CaptureMovesNodesWhichStairAndSmoothOffForbid) {
  const std::string capture = "stl_file = a\ncell_size = 0.1\ncapture = 5";
  EXPECT_EQ(verdict(capture), "no error");
  EXPECT_TRUE(verdict(capture + "\nstair = fast").starts_with("stair keeps the cells as they are"));
  EXPECT_TRUE(verdict(capture + "\nsmooth = off").starts_with("smooth = off leaves nodes where"));
}

TEST(Validate, ATurnedGridHasNoFilesOfVolumeFractions) {
  const std::string align = "stl_file = a\ncell_size = 0.1\nalign = true";
  EXPECT_EQ(verdict(align), "no error");
  EXPECT_TRUE(verdict(align + "\nvolfrac_file = v").starts_with("volume fractions of a turned grid"));
}

// Every unsupported switch may be written down as long as it stays off.
TEST(Validate, AcceptsUnsupportedOptionsThatAreOff) {
  for (const OptionSpec& option : option_table()) {
    if (option.supported || !std::holds_alternative<bool Deck::*>(option.slot)) continue;
    const std::string name(option.name);
    EXPECT_EQ(verdict(kSpn + name + " = false"), "no error") << name;
    EXPECT_EQ(verdict(kSpn + name + " = true"),
              "option '" + name + "' (line 6 of deck.i) is not supported yet");
  }
  EXPECT_EQ(verdict(kSpn + "defeature = off\nadapt_type = 0\nmin_vol_cells = 5\ncapture = 0"), "no error");
}

TEST(Validate, PillowNumbersAgreeWithTheLongOptions) {
  for (const char* number : {"0", "1", "2", "3", "100", "202", "205", "212", "215"})
    EXPECT_EQ(verdict(kSpn + "pillow = " + number), "no error") << number;
  EXPECT_EQ(verdict(kSpn + "pillow = 213\npillow_curve_layers = 3"), "no error");
  EXPECT_EQ(verdict(kSpn + "pillow = 2\npillow_curve_layers = 5"), "no error");
  EXPECT_EQ(verdict(kSpn + "pillow = 214\npillow_curve_layers = 3"),
            "pillow and pillow_curve_layers ask for different numbers of layers; given: pillow = "
            "curves_4_layers (line 6 of deck.i), pillow_curve_layers = 3 (line 7 of deck.i)");
}

TEST(Validate, NeedsExactlyOneGeometry) {
  EXPECT_EQ(verdict("nelx = 3"),
            "no input geometry; give one of stl_file, diatom_file, input_vfrac, input_micro, input_cart_exo, "
            "input_spn or input_stitch");
  EXPECT_EQ(verdict(kSpn + "diatom_file = b.diatom"),
            "only one input geometry is allowed; given: diatom_file = b.diatom (line 6 of deck.i), input_spn "
            "= a.spn "
            "(line 2 of deck.i)");
}

TEST(Validate, AMeshIsTheGridOfSomeSources) {
  EXPECT_EQ(verdict("input_mesh = m.g"), "no error");
  EXPECT_EQ(verdict("input_mesh = m.g\ninput_mesh_blocks = 2 4\ndiatom_file = a.diatom"), "no error");
  EXPECT_EQ(verdict("input_mesh_pamgen = m.p\ndiatom_file = a.diatom"), "no error");
  EXPECT_EQ(verdict(kSpn + "input_mesh = m.g"), "no error");
  EXPECT_EQ(verdict("input_mesh = m.g\ninput_spn = a.spn\nnelx = 3"),
            "input_spn needs the number of cells nelx, nely and nelz; given: nelx = 3 (line 4 of deck.i); "
            "not given: nely, nelz");
  for (const char* source : {"input_micro", "input_cart_exo"})
    EXPECT_EQ(
        verdict(std::string("input_mesh = m.g\n") + source + " = a"),
        std::string("input_mesh takes its materials from its element variables, stl_file, diatom_file or "
                    "input_spn; given: input_mesh = m.g (line 2 of deck.i), ") +
            source + " = a (line 3 of deck.i)");
  EXPECT_EQ(verdict("input_mesh = m.g\ninput_mesh_pamgen = m.p"),
            "only one mesh can be the overlay grid; given: input_mesh = m.g (line 2 of deck.i), "
            "input_mesh_pamgen = m.p (line 3 of deck.i)");
  EXPECT_EQ(
      verdict("input_mesh_pamgen = m.p"),
      "input_mesh_pamgen has no element variables; give one of stl_file, diatom_file or input_spn; given: "
      "input_mesh_pamgen = m.p (line 2 of deck.i)");
  EXPECT_EQ(
      verdict(kSpn + "input_mesh_blocks = 2"),
      "input_mesh_blocks needs input_mesh or input_mesh_pamgen; given: input_mesh_blocks = 2 (line 6 of "
      "deck.i)");
  EXPECT_EQ(
      verdict(kSpn + "gen_sidesets = input_mesh"),
      "gen_sidesets = input_mesh, input_mesh_and_stl and input_mesh_and_free_surfaces carry the sets of an "
      "input mesh over; give input_mesh or input_mesh_pamgen; given: gen_sidesets = input_mesh (line 6 "
      "of deck.i)");
  EXPECT_NE(verdict(kSpn + "gen_sidesets = 7"), "no error");
  EXPECT_EQ(verdict(kSpn + "input_mesh_pamgen = m.p\ngen_sidesets = input_mesh"), "no error");
  EXPECT_EQ(verdict("input_mesh = m.g\ndiatom_file = a\ninput_spn = b"),
            "only one input geometry is allowed; given: diatom_file = a (line 3 of deck.i), input_spn = b "
            "(line 4 of deck.i)");
}

TEST(Validate, SetsOfTheGeometryNeedOneWithSurfaces) {
  for (const char* value : {"geometric_surfaces", "geometric_sidesets"}) {
    const std::string line = std::string("gen_sidesets = ") + value;
    EXPECT_EQ(
        verdict(kSpn + line),
        "gen_sidesets = geometric_surfaces, geometric_sidesets and input_mesh_and_stl need a geometry that "
        "has surfaces, not fractions or voxels; give diatom_file or stl_file; given: " +
            line + " (line 6 of deck.i)");
    EXPECT_EQ(verdict("input_mesh = m.g\ndiatom_file = a\n" + line), "no error");
  }
  EXPECT_NE(verdict("input_mesh = m.g\ngen_sidesets = input_mesh_and_stl"), "no error");
}

TEST(Validate, NamesWhatAnInputLacks) {
  EXPECT_EQ(verdict("input_spn = a.spn\nnelx = 3"),
            "input_spn needs the number of cells nelx, nely and nelz; given: nelx = 3 (line 3 of deck.i); "
            "not given: nely, nelz");
  EXPECT_EQ(
      verdict("diatom_file = a\nnelx = 3\nnely = 3"),
      "diatom_file and stl_file need cell_size, or the number of cells nelx, nely and nelz; given: nelx = 3 "
      "(line 3 of deck.i), nely = 3 (line 4 of deck.i); not given: nelz");
  EXPECT_EQ(verdict("diatom_file = a\nnelx = 3\nnely = 3\nnelz = 3\nxmin = 0"), "no error");
  EXPECT_EQ(verdict("stl_file = a\ncell_size = 0.1"), "no error");
}

TEST(Validate, NeedsABoxWithAnInside) {
  EXPECT_EQ(
      verdict("input_micro = a\nxmin = 2\nxmax = 2"),
      "xmin must be smaller than xmax; given: xmin = 2 (line 3 of deck.i), xmax = 2 (line 4 of deck.i)");
  EXPECT_EQ(verdict("input_micro = a\nymin = 2\nymax = 1").find("ymin must be smaller than ymax"), 0u);
  EXPECT_EQ(verdict("input_micro = a\nzmin = 2\nzmax = 1").find("zmin must be smaller than zmax"), 0u);
}

TEST(Validate, LimitsTheNumberOfCells) {
  const std::string too_many = "input_spn = a\nnelx = 1000000000\nnely = 1000000000\nnelz = ";
  EXPECT_EQ(verdict(too_many + "4"), "no error");  // 4e18 < 2^62 = 4.61e18
  EXPECT_EQ(verdict(too_many + "5").find("the grid has more cells than can be numbered"), 0u);
  EXPECT_EQ(verdict(too_many + "1000000000").find("the grid has more cells than can be numbered"), 0u);
}

TEST(Validate, ComparesThePartsWithTheRanks) {
  EXPECT_EQ(
      verdict(kSpn + "num_procs = 4\niproc = 3\njproc = 1\nkproc = 1"),
      "iproc * jproc * kproc must be the number of processes; found: iproc = 3 (line 7 of deck.i), jproc = 1 "
      "(line 8 of deck.i), kproc = 1 (line 9 of deck.i), num_procs = 4 (line 6 of deck.i)");
  EXPECT_EQ(verdict(kSpn + "num_procs = 4\niproc = 1000000\njproc = 1000000\nkproc = 1000000")
                .find("iproc * jproc * kproc must be the number of processes"),
            0u);
  EXPECT_EQ(verdict(kSpn + "num_procs = 4\njproc = 3")
                .find("the product of the given ones of iproc, jproc and kproc must divide"),
            0u);
  EXPECT_EQ(verdict(kSpn + "num_procs = 4\njproc = 2"), "no error");
}

TEST(Validate, NeedsPositiveScales) {
  EXPECT_EQ(verdict(kSpn + "yscale = 0"),
            "scale factors must be positive; given: yscale = 0 (line 6 of deck.i)");
}

TEST(Validate, AdaptMaterialRecordsMakeSense) {
  const std::string type = kSpn + "adapt_type = material\nadapt_material = ";  // line 7
  for (const char* record : {"0", "10000 2 0.0001 0 0", "3 0 0 0", "3 20 1 1e6 -7", "2147483647"})
    EXPECT_EQ(verdict(type + record), "no error") << record;
  const std::string begin = "option 'adapt_material' (line 7 of deck.i): record 1 (";
  EXPECT_EQ(verdict(type + "-1"),
            begin + "-1): the id must be a whole number from 0 to 2147483647, found -1");
  EXPECT_EQ(verdict(type + "1.5 2"),
            begin + "1.5 2): the id must be a whole number from 0 to 2147483647, found 1.5");
  for (const char* levels : {"-1", "21", "1.5"})
    EXPECT_EQ(verdict(type + "3 " + levels),
              begin + "3 " + levels + "): the levels must be a whole number from 0 to 20, found " + levels);
  for (const char* fraction : {"-0.1", "1.1"})
    EXPECT_EQ(verdict(type + "3 2 " + fraction), begin + "3 2 " + fraction +
                                                     "): the volume fraction must be a number from 0 to 1, "
                                                     "found " +
                                                     fraction);
  EXPECT_EQ(verdict(type + "3 2 0 -1"),
            begin + "3 2 0 -1): the distance must be a length that is not negative, found -1");
  EXPECT_EQ(verdict(type + "3 2 0 1 0 9"),
            begin +
                "3 2 0 1 0 9) has 6 numbers; expected at most 5: id, levels, volume fraction, distance "
                "and one without effect");
  EXPECT_EQ(verdict(type + "3\nadapt_material = 4 77"),
            "option 'adapt_material' (line 8 of deck.i): record 2 (4 77): the levels must be a whole number "
            "from 0 to 20, found 77");
}

TEST(Validate, AdaptMaterialBelongsToItsType) {
  EXPECT_EQ(verdict(kSpn + "adapt_material = 1"), "no error");  // idle, which the console tells
  EXPECT_EQ(verdict(kSpn + "adapt_material = 1\nadapt_type = material"), "no error");
  EXPECT_EQ(verdict(kSpn + "adapt_material = 1\nadapt_type = vfrac_average"),
            "adapt_material needs adapt_type = material; given: adapt_material = 1 (line 6 of deck.i), "
            "adapt_type = vfrac_average (line 7 of deck.i)");
}

TEST(Validate, CoarseningNeedsDenseData) {
  const std::string shapes =
      "diatom_file = a\nnelx=1\nnely=1\nnelz=1\nxmin=0\nymin=0\nzmin=0\nxmax=1\nymax=1\nzmax=1\n";
  for (const char* type : {"coarsen", "resample"}) {
    const std::string line = std::string("adapt_type = ") + type;
    EXPECT_EQ(verdict(kSpn + line), "no error");
    EXPECT_EQ(verdict("input_micro = a\n" + line), "no error");
    EXPECT_EQ(verdict(shapes + line),
              "adapt_type = coarsen and resample need data on a dense grid; shapes are refined by "
              "vfrac_average; given: " +
                  line + " (line 12 of deck.i), diatom_file = a (line 2 of deck.i)");
    EXPECT_EQ(verdict(kSpn + line + "\nmicro_expand = 2"),
              "micro_expand adds layers to the grid as it was read; adapt_type must not be coarsen or "
              "resample; given: " +
                  line + " (line 6 of deck.i), micro_expand = 2 (line 7 of deck.i)");
    EXPECT_EQ(verdict(kSpn + line + "\nmicro_expand = 0"), "no error");
  }
  EXPECT_EQ(verdict(shapes + "adapt_type = vfrac_average"), "no error");
  EXPECT_EQ(verdict(kSpn + "adapt_type = vfrac_average\nmicro_expand = 2"), "no error");
}

TEST(Validate, AdaptThresholdMayBeZero) {
  EXPECT_EQ(verdict(kSpn + "adapt_type = vfrac_average\nadapt_threshold = 0"), "no error");
  EXPECT_NE(verdict(kSpn + "adapt_type = vfrac_average\nadapt_threshold = -1"), "no error");
}

TEST(InputDefaults, SmoothVoxelsWithoutProjection) {
  Deck deck = deck_of(kSpn);
  apply_input_defaults(deck);
  EXPECT_EQ(deck.smooth, kSmoothNoSurfaceProjections);
  EXPECT_EQ(deck.csmooth, kCsmoothHermite);
  EXPECT_EQ(deck.laplacian_iters, 10);
  EXPECT_FALSE(deck.given("smooth"));
  EXPECT_TRUE(deck.redefaulted.contains("smooth"));
  const Deck once = deck;
  apply_input_defaults(deck);
  EXPECT_EQ(deck, once);
}

TEST(InputDefaults, KeepWhatTheUserGave) {
  Deck deck = deck_of(kSpn + "smooth = 1\ncsmooth = vfrac\nlaplacian_iters = 0\nexodus_file = out");
  apply_input_defaults(deck);
  EXPECT_EQ(deck.smooth, kSmoothOn);
  EXPECT_EQ(deck.csmooth, kCsmoothVfrac);
  EXPECT_EQ(deck.laplacian_iters, 0);
  EXPECT_EQ(deck.exodus_file, "out");
  EXPECT_TRUE(deck.redefaulted.empty());
}

TEST(InputDefaults, OtherInputsKeepTheGeneralSmoothing) {
  for (const char* line : {"input_micro = a", "input_cart_exo = a", "diatom_file = a"}) {
    Deck deck = deck_of(line);
    apply_input_defaults(deck);
    EXPECT_EQ(deck.smooth, kSmoothOn) << line;
    EXPECT_EQ(deck.csmooth, kCsmoothVfrac) << line;
    EXPECT_EQ(deck.laplacian_iters, 2) << line;
  }
}

TEST(InputDefaults, NameTheMeshAfterTheDeckOrTheData) {
  Deck deck = deck_of("input_spn = in/grains.v2.spn");
  apply_input_defaults(deck);
  EXPECT_EQ(deck.exodus_file, "grains.v2");
  EXPECT_TRUE(deck.redefaulted.contains("exodus_file"));
  deck = deck_of("input_spn = in/grains.spn");
  deck.input_file = "runs/case7.i";
  apply_input_defaults(deck);
  EXPECT_EQ(deck.exodus_file, "case7");
  Deck nameless;
  apply_input_defaults(nameless);
  EXPECT_EQ(nameless.exodus_file, "sculpt");
}

}  // namespace
}  // namespace sculpt
