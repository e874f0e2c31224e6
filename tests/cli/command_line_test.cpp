// How users call the program, and what it prints.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "cases.hpp"
#include "scratch.hpp"
#include "sculpt/exo/read_exodus.hpp"

namespace sculpt::cli {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

class CommandLine : public Scratch {
 protected:
  // The letter F in deck.i, with more lines.
  void write_deck(const std::string& more = "", const std::string& name = "deck.i") const {
    write("v.spn", spn_text(letter_f()));
    write(name, "BEGIN SCULPT\n" + spn_deck(letter_f(), "v.spn") + more + "END SCULPT\n");
  }
  std::string help(const Words& words) const {
    Words all{"sculpt"};
    all.insert(all.end(), words.begin(), words.end());
    return succeed(all).out;
  }
  [[nodiscard]] RankMesh read_mesh(const std::string& name) const { return read_exodus(path(name)); }
};

TEST_F(CommandLine, HelpOfEverything) {
  const std::string listing = help({"-h"});
  for (const char* word :
       {"Usage: sculpt", "--input_spn", "-isp", "--pillow_surfaces", "--adapt_type", "Mesh Transformation"})
    EXPECT_TRUE(has(listing, word)) << word;
  EXPECT_EQ(help({}), listing) << "no arguments ask for help";
  EXPECT_EQ(help({"--help"}), listing);
  EXPECT_GT(lines_of(help({"-h", "all"})).size(), 500U);
}

TEST_F(CommandLine, HelpOfOneOption) {
  const std::string text = help({"-h", "pillow_surfaces"});
  for (const char* word :
       {"SCULPT HELP", "Command: pillow_surfaces", "Input file command:   pillow_surfaces <arg>", "-ps",
        "Argument Type:", "Command Description:"})
    EXPECT_TRUE(has(text, word)) << word;
  EXPECT_EQ(help({"--help", "--pillow_surfaces"}), text);
  EXPECT_EQ(help({"-h", "-ps"}), text);
  EXPECT_TRUE(has(help({"-h", "-smo"}), "Command: csmooth")) << "a group";
}

TEST_F(CommandLine, Version) {
  EXPECT_EQ(help({"-vs"}), "sculpt " SCULPT_VERSION "\n");
  EXPECT_EQ(help({"--version"}), "sculpt " SCULPT_VERSION "\n");
  EXPECT_EQ(succeed({"psculpt", "-vs"}).out, "sculpt " SCULPT_VERSION "\n");
  EXPECT_EQ(succeed({"eputool", "-version"}).out, "eputool " SCULPT_VERSION "\n");
}

// What print_input prints is a deck that makes the same mesh.
TEST_F(CommandLine, PrintInputGoesRound) {
  write_deck("smooth = fixed_bbox\nmaterial_name = 2 \"two words\"\nopt_threshold = 0.45\n");
  const Words more{"-LI", "3", "-e", "first"};
  Words print{"sculpt", "-i", "deck.i", "--print_input"},
      print_again{"sculpt", "-i", "again.i", "-print_input"};
  print.insert(print.end(), more.begin(), more.end());
  const std::string printed = succeed(print).out;
  EXPECT_TRUE(has(printed, "smooth = fixed_bbox") && has(printed, "laplacian_iters = 3")) << printed;
  EXPECT_EQ(snapshot().size(), 2U) << "it stops there";
  write("again.i", printed);
  EXPECT_EQ(succeed(print_again).out, printed);
  succeed({"sculpt", "-i", "deck.i", "-LI", "3", "-e", "first"});
  succeed({"sculpt", "-i", "again.i", "-e", "second"});
  EXPECT_TRUE(read_mesh("first.e.1.0") == read_mesh("second.e.1.0"));
}

TEST_F(CommandLine, QuietPrintsNothing) {
  write_deck();
  EXPECT_EQ(succeed({"sculpt", "-i", "deck.i", "-qt"}).out, "");
  EXPECT_EQ(succeed({"sculpt", "-j", "3", "--quiet", "-i", "deck.i"}).out, "");
  write_deck("quiet = true\n");
  EXPECT_EQ(succeed({"sculpt", "-j", "2", "-i", "deck.i"}).out, "");
}

TEST_F(CommandLine, ShortAndLongFormsMixWithTheDeck) {
  write_deck("smooth = 1\nlaplacian_iters = 1\nexodus_file = deck_name\n");
  const std::string out = succeed({"sculpt", "--smooth", "fixed_bbox", "-i", "deck.i", "-LI=4",
                                   "--csmooth=hermite", "-OT", "0.5", "--exodus_file", "words"})
                              .out;
  for (const char* line : {"--smooth                   -S    2", "--csmooth                  -CS   2",
                           "--laplacian_iters          -LI   4", "--opt_threshold            -OT   0.500000",
                           "--exodus_file              -e    words"})
    EXPECT_TRUE(has(out, line)) << line;
  EXPECT_TRUE(exists("words.e.1.0"));
  EXPECT_FALSE(exists("deck_name.e.1.0"));
}

TEST_F(CommandLine, NoDeckAtAll) {
  write("v.spn", spn_text(letter_f()));
  write_deck();
  succeed({"sculpt", "-isp", "v.spn", "-x", "3", "-y", "5", "-z", "4", "-e", "words"});
  succeed({"sculpt", "-i", "deck.i", "-e", "lines"});
  EXPECT_TRUE(read_mesh("words.e.1.0") == read_mesh("lines.e.1.0"));
}

TEST_F(CommandLine, DecksOfOtherSystems) {
  write("v.spn", spn_text(letter_f()));
  write("deck.i",
        "$ comment\r\n# comment\r\n\r\nBegin Sculpt\r\n  INPUT_SPN v.spn   $ no equals "
        "sign\r\n\tnelx=3\r\nnely = 5 # five\r\n"
        "nelz 4\r\nexodus_file = \"my mesh\"\r\nEnd Sculpt\r\n");
  succeed({"sculpt", "-i", "deck.i"});
  EXPECT_TRUE(exists("my mesh.e.1.0"));
}

TEST_F(CommandLine, OutputIsNamedAfterTheDeckOrTheInput) {
  write_deck("", "my_case.i");
  succeed({"sculpt", "-i", "my_case.i"});
  EXPECT_TRUE(exists("my_case.e.1.0"));
  succeed({"sculpt", "-isp", "v.spn", "-x", "3", "-y", "5", "-z", "4"});
  EXPECT_TRUE(exists("v.e.1.0"));
}

TEST_F(CommandLine, RanksInFileNamesArePadded) {
  write_deck("stair = fast\n");
  succeed({"sculpt", "-i", "deck.i", "-j", "10", "-e", "out"});
  for (int r = 0; r < 10; ++r) EXPECT_TRUE(exists(fmt::format("out.e.10.0{}", r))) << r;
}

TEST_F(CommandLine, RanksOfAnMpiLauncher) {
  write_deck();
  RunOptions options;
  for (const char* name :
       {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "OMPI_MCA_rmaps_base_oversubscribe"})
    options.environment.emplace_back(name, "1");
  const std::string out =
      succeed({"mpiexec", "-n", "3", PSCULPT_PROGRAM, "-j", "3", "-i", "deck.i", "-e", "three"}, options).out;
  EXPECT_EQ(summary(out, "Num Procs"), 3);
  EXPECT_FALSE(has(out, "Initializing MPI on")) << "ranks start no ranks";
  EXPECT_TRUE(exists("three.e.3.2"));
  succeed({"mpiexec", "-n", "2", SCULPT_PROGRAM, "-i", "deck.i", "-e", "two"}, options);
  EXPECT_TRUE(exists("two.e.2.1")) << "the launcher's number counts";
  succeed({"psculpt", "-i", "deck.i", "-e", "one"});
  EXPECT_TRUE(exists("one.e.1.0"));
}

TEST_F(CommandLine, LauncherSaysWhatItStarts) {
  write_deck();
  const Words lines = lines_of(succeed({"sculpt", "-j", "2", "-i", "deck.i"}).out);
  ASSERT_GT(lines.size(), 5U);
  EXPECT_TRUE(lines[0].starts_with("SCULPT Running on host name: "));
  EXPECT_TRUE(lines[1].starts_with("At time: "));
  EXPECT_TRUE(lines[3].starts_with("Initializing MPI on 2 Processors: mpiexec = /")) << lines[3];
}

TEST_F(CommandLine, MpiexecByPath) {
  write_deck();
  const std::string out = succeed({"sculpt", "-j", "2", "-mpi", MPIEXEC_PROGRAM, "-i", "deck.i"}).out;
  EXPECT_TRUE(has(out, "mpiexec = " MPIEXEC_PROGRAM "\n"));
}

class Extent {
 public:
  explicit Extent(const std::vector<double>& x)
      : lo_(*std::min_element(x.begin(), x.end())), hi_(*std::max_element(x.begin(), x.end())) {}
  void expect(double lo, double hi) const {
    EXPECT_DOUBLE_EQ(lo_, lo);
    EXPECT_DOUBLE_EQ(hi_, hi);
  }

 private:
  double lo_, hi_;
};

TEST_F(CommandLine, ScalesAndThenTranslates) {
  write_deck("xscale = 2\nxtranslate = 1\nyscale = 0.5\nztranslate = -4\n");
  succeed({"sculpt", "-i", "deck.i"});
  const RankMesh mesh = read_mesh("deck.e.1.0");
  Extent(mesh.x).expect(1, 7);
  Extent(mesh.y).expect(0, 2.5);
  Extent(mesh.z).expect(-4, 0);
}

TEST_F(CommandLine, DeprecatedScaleStillWorks) {
  write_deck("scale = 3\nytranslate = 1\n");
  succeed({"sculpt", "-i", "deck.i"});
  const RankMesh mesh = read_mesh("deck.e.1.0");
  Extent(mesh.x).expect(0, 9);
  Extent(mesh.y).expect(1, 16);
}

TEST_F(CommandLine, NamesOfBlocks) {
  write_deck("material_name = 2 ink\n");
  const RankMesh named = mesh(spn_deck(letter_f(), "v.spn") + "material_name = 2 ink\n", 2);
  ASSERT_EQ(named.blocks.size(), 2U);
  EXPECT_EQ(named.blocks[0].name, "");
  EXPECT_EQ(named.blocks[1].name, "ink");
}

TEST_F(CommandLine, StepsAppearInOrder) {
  write_deck();
  const std::string out = succeed({"sculpt", "-i", "deck.i"}).out;
  std::size_t at = 0;
  for (const char* step :
       {"Decomposing Cartesian grid for parallel...", "begin SCULPT meshing...", "(1/9) computing normals...",
        "(2/9) classifying materials...", "(3/9) resolving non-manifolds...",
        "(4/9) computing dual edge intersections...", "(5/9) computing material interfaces...",
        "(6/9) generating geometry...", "(7/9) generating buffer hexes...",
        "(8/9) generating interior hexes...", "(9/9) begin smoothing...", "Begin smoothing hexes using:",
        "building exodus mesh...", "MESH SUMMARY", "Job Completed", "Elapsed Time", "Done!"}) {
    const std::size_t next = out.find(step, at);
    ASSERT_NE(next, std::string::npos) << step;
    at = next;
  }
}

TEST_F(CommandLine, MeshSummaryTellsWhatTheFileHolds) {
  write_deck();
  const std::string out = succeed({"sculpt", "-i", "deck.i"}).out;
  const RankMesh written = read_mesh("deck.e.1.0");
  EXPECT_TRUE(has(out, "  Base Filename         deck\n"));
  EXPECT_EQ(summary(out, "Num Procs"), 1);
  EXPECT_EQ(summary(out, "Num Nodes"), static_cast<double>(written.x.size()));
  EXPECT_EQ(summary(out, "Num Elements"), static_cast<double>(hexes_of(written)));
  EXPECT_EQ(summary(out, "Num Blocks"), 2);
  EXPECT_EQ(summary(out, "Num Nodesets"), 0);
  EXPECT_EQ(summary(out, "Num Sidesets"), 0);
  EXPECT_EQ(summary(out, "Num Bad Qual (SJ<0)"), 0);
  EXPECT_EQ(summary(out, "Num Poor Qual (SJ<0.2)"), 0);
  const double least = summary(out, "Min Quality"), average = summary(out, "Avg Quality");
  EXPECT_TRUE(0.2 < least && least < average && average < 1) << least << ' ' << average;
  const double edge = summary(out, "Min Edge Len");
  EXPECT_TRUE(0 < edge && edge < 1) << edge;
  EXPECT_EQ(summary(out, "Min Qual Rank"), 0);
}

TEST_F(CommandLine, StairMeshIsPerfect) {
  write_deck("stair = fast\n");
  const std::string out = succeed({"sculpt", "-i", "deck.i"}).out;
  EXPECT_EQ(summary(out, "Num Elements"), 60);
  EXPECT_EQ(summary(out, "Num Nodes"), 120);
  EXPECT_EQ(summary(out, "Min Quality"), 1);
  EXPECT_EQ(summary(out, "Min Edge Len"), 1);
  EXPECT_FALSE(has(out, "Begin smoothing hexes using:"));
}

TEST_F(CommandLine, CompareVolumeAddsUp) {
  write_deck("compare_volume = true\n");
  const Words lines = lines_of(succeed({"sculpt", "-i", "deck.i", "-j", "2"}).out);
  const auto table = std::find(lines.begin(), lines.end(), "VOLUME COMPARISON");
  ASSERT_NE(table, lines.end());
  double input = 0, meshed = 0;
  for (const int id : {1, 2}) {
    std::istringstream row(*(table + 1 + id));
    int material = 0;
    double before = 0, after = 0, error = 0;
    row >> material >> before >> after >> error;
    EXPECT_EQ(material, id);
    EXPECT_NEAR(error, 100 * (after - before) / before, 1e-3);
    input += before;
    meshed += after;
  }
  EXPECT_NEAR(input, 60, 1e-5);
  EXPECT_NEAR(meshed, 60, 1e-5) << "the mesh fills the box";
}

}  // namespace
}  // namespace sculpt::cli
