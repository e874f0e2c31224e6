// What a user can get wrong: one clear message, a status that is not 0, no hang, and no file that was not
// there before.
#include "bad_input.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>

#include "cases.hpp"
#include "sculpt/exo/read_exodus.hpp"
#include "support/surfaces.hpp"

namespace sculpt::cli {
namespace {

std::vector<Mistake> deck_mistakes() {
  return {
      {"MissingDeck", [](BadInput&) {}, {"deck.i", "No such file"}},
      {"MissingInput",
       [](BadInput& t) {
         t.write_deck();
         std::filesystem::remove(t.path("v.spn"));
       },
       {"input_spn", "v.spn", "No such file"}},
      {"InputIsAFolder",
       [](BadInput& t) {
         t.write_deck();
         std::filesystem::remove(t.path("v.spn"));
         std::filesystem::create_directory(t.path("v.spn"));
       },
       {"v.spn"}},
      {"DeckWithoutBegin", [](BadInput& t) { t.write("deck.i", "nelx = 3\n"); }, {"deck.i", "BEGIN SCULPT"}},
      {"DeckWithoutEnd",
       [](BadInput& t) { t.write("deck.i", "BEGIN SCULPT\nnelx = 3\n"); },
       {"deck.i", "END SCULPT"}},
      {"MisspeltOption",
       [](BadInput& t) { t.write_deck("smoth = 1\n"); },
       {"deck.i", "6", "'smoth'", "'smooth'"}},
      {"ValueOutOfRange",
       [](BadInput& t) { t.write_deck("opt_threshold = 7\n"); },
       {"deck.i", "6", "opt_threshold", "7", "1"}},
      {"UnknownName",
       [](BadInput& t) { t.write_deck("smooth = sometimes\n"); },
       {"deck.i", "6", "smooth", "'sometimes'", "fixed_bbox"}},
      {"NotANumber",
       [](BadInput& t) { t.write_deck("laplacian_iters = ten\n"); },
       {"deck.i", "6", "laplacian_iters", "'ten'"}},
      {"Unsupported",
       [](BadInput& t) { t.write_deck("trimesh = true\n"); },
       {"trimesh", "line 6 of deck.i", "not supported yet"}},
      {"TwoSources",
       [](BadInput& t) { t.write_deck("diatom_file = s.diatom\n"); },
       {"only one input geometry", "input_spn", "diatom_file", "line 6 of deck.i"}},
      {"ThickenUnknownMaterial",
       [](BadInput& t) { t.write_deck("thicken_material = 9 0.3\n"); },
       {"thicken_material", "line 6 of deck.i", "id 9", "2 materials: 1 2"}},
      {"ThickenTwoAutos",
       [](BadInput& t) { t.write_deck("thicken_material = 1 auto\nthicken_material = 1 auto\n"); },
       {"thicken_material", "line 7 of deck.i", "material 1", "more than one automatic"}},
      {"NoSource",
       [](BadInput& t) { t.write("deck.i", "BEGIN SCULPT\nnelx = 3\nEND SCULPT\n"); },
       {"no input geometry", "input_spn"}},
      {"NoGridCounts",
       [](BadInput& t) { t.write("deck.i", "BEGIN SCULPT\ninput_spn = v.spn\nnely = 3\nEND SCULPT\n"); },
       {"nelx", "nelz", "line 3 of deck.i"}},
      {"ZeroCells", [](BadInput& t) { t.write_deck("nelx = 0\n"); }, {"deck.i", "nelx", "0", "1"}},
      {"TooManyCells",
       [](BadInput& t) { t.write_deck("nelx = 1000000000\nnely = 1000000000\nnelz = 1000000000\n"); },
       {"more cells", "nelx = 1000000000 (line 6 of deck.i)", "nely", "nelz"}},
      {"CellsBeyond64Bits",
       [](BadInput& t) { t.write_deck("nelx = 99999999999999999999\n"); },
       {"deck.i", "nelx", "99999999999999999999"}},
      {"WrongSegments",
       [](BadInput& t) { t.write_deck("iproc = 3\njproc = 3\nkproc = 1\n"); },
       {"iproc", "jproc", "kproc", "number of processes"}},
  };
}

std::vector<Mistake> input_mistakes() {
  return {
      {"SpnTooFew",
       [](BadInput& t) { t.write_spn("1 2 3\n4 5\n"); },
       {"v.spn", "found 5 integers", "3 x 5 x 4 = 60"}},
      {"SpnOneTooFew",
       [](BadInput& t) {
         t.write_spn("1" + spn_text(Voxels{59, 1, 1, [](int, int, int) { return 7; }}).substr(1));
       },
       {"v.spn", "found 59 integers", "60"}},
      {"SpnTooMany",
       [](BadInput& t) { t.write_spn(spn_text(letter_f()) + "1\n"); },
       {"v.spn", "found 61 integers", "60"}},
      {"SpnEmpty", [](BadInput& t) { t.write_spn(""); }, {"v.spn", "is empty"}},
      {"SpnLetter",
       [](BadInput& t) { t.write_spn("1 2\n3 x4 5\n" + spn_text(letter_f())); },
       {"v.spn", "line 2", "x4", "integer"}},
      {"SpnFraction",
       [](BadInput& t) { t.write_spn("1 2\n3 4.5\n" + spn_text(letter_f())); },
       {"v.spn", "line 2", "4.5", "integer"}},
      {"SpnNegative",
       [](BadInput& t) { t.write_spn("1 2\n3 4\n-5 6\n" + spn_text(letter_f())); },
       {"v.spn", "line 3", "-5"}},
      {"SpnHuge",
       [](BadInput& t) { t.write_spn("1 99999999999\n" + spn_text(letter_f())); },
       {"v.spn", "line 1", "99999999999"}},
      {"TecSum",
       [](BadInput& t) { t.write_tec("0 0 0 1 0\n1 0 0 0.5 0.25\n0 0 1 1 0\n1 0 1 1 0\n"); },
       {"f.tec", "line 4", "0.75", "1"}},
      {"TecNan",
       [](BadInput& t) { t.write_tec("0 0 0 1 0\n1 0 0 1 0\n0 0 1 nan 0\n1 0 1 1 0\n"); },
       {"f.tec", "line 5", "nan"}},
      {"TecNegative",
       [](BadInput& t) { t.write_tec("0 0 0 1 0\n1 0 0 1.5 -0.5\n0 0 1 1 0\n1 0 1 1 0\n"); },
       {"f.tec", "line 4"}},
      {"TecTooFewRows",
       [](BadInput& t) { t.write_tec("0 0 0 1 0\n1 0 0 1 0\n0 0 1 1 0\n"); },
       {"f.tec", "3 rows", "2 x 1 x 2 = 4 rows"}},
      {"TecCellTwice",
       [](BadInput& t) { t.write_tec("0 0 0 1 0\n1 0 0 1 0\n0 0 1 1 0\n0 0 1 1 0\n"); },
       {"f.tec"}},
      {"TecNoZone",
       [](BadInput& t) {
         t.write_tec("");
         t.write("f.tec", "VARIABLES = x y z a b\n");
       },
       {"f.tec", "ZONE"}},
      {"DiatomNotClosed",
       [](BadInput& t) {
         t.write_diatom("");
         t.write("s.diatom", "diatom\npackage 'a'\nmaterial 1\ninsert sphere\ncenter 0 0 0\nradius 4\n");
       },
       {"s.diatom", "line 4", "'insert' is not closed", "'endinsert'"}},
      {"DiatomZeroRadius",
       [](BadInput& t) { t.write_diatom("insert sphere\ncenter 0 0 0\nradius 0\nendinsert\n"); },
       {"s.diatom", "line 6", "radius 0", "> 0"}},
      {"DiatomNoCenter",
       [](BadInput& t) { t.write_diatom("insert sphere\nradius 1\nendinsert\n"); },
       {"s.diatom", "line 4", "center"}},
      {"DiatomUnknownShape",
       [](BadInput& t) { t.write_diatom("insert banana\nendinsert\n"); },
       {"s.diatom", "line 4", "'banana'"}},
      {"StlCutOff",
       [](BadInput& t) {
         t.write_stl(test::binary_stl(test::box_facets({0, 0, 0}, {1, 1, 1})).substr(0, 300));
       },
       {"s.stl", "300 bytes", "12 facets", "684 bytes"}},
      {"StlNotANumber",
       [](BadInput& t) { t.write_stl("solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 inf\n"); },
       {"s.stl", "line 4", "'inf'", "finite"}},
      {"StlOfNoFacets", [](BadInput& t) { t.write_stl("solid s\nendsolid s\n"); }, {"s.stl", "no facets"}},
      {"DiatomStlsMissing",
       [](BadInput& t) {
         t.write_diatom("insert stl\nfile = 'a.stl'\nendinsert\ninsert stl\nfile = 'b.stl'\nendinsert\n");
       },
       {"s.diatom", "line 4", "2 of 2", "'a.stl', 'b.stl'"}},
      {"ExodusTruncated",
       [](BadInput& t) {
         t.write_cart_exo([](RankMesh&) {});
         std::filesystem::resize_file(t.path("grid.e"), std::filesystem::file_size(t.path("grid.e")) / 2);
       },
       {"grid.e"}},
      {"ExodusText",
       [](BadInput& t) {
         t.write_cart_exo([](RankMesh&) {});
         t.write("grid.e", "no Exodus\n");
       },
       {"grid.e"}},
      {"ExodusNoGrid",
       [](BadInput& t) { t.write_cart_exo([](RankMesh& m) { m.x[60] += 0.25; }); },
       {"grid.e", "grid"}},
      {"ExodusNoHexes",
       [](BadInput& t) {
         t.write_cart_exo([](RankMesh& m) {
           m.blocks[0].type = "TETRA4";
           m.blocks[0].nodes_per_element = 4;
           std::vector<std::int32_t> nodes;
           for (std::size_t n = 0; n < m.blocks[0].nodes.size(); n += 8)
             nodes.insert(nodes.end(), m.blocks[0].nodes.begin() + static_cast<std::ptrdiff_t>(n),
                          m.blocks[0].nodes.begin() + static_cast<std::ptrdiff_t>(n) + 4);
           m.blocks[0].nodes = nodes;
         });
       },
       {"grid.e", "block 1", "TETRA4", "HEX"}},
  };
}

TEST_P(Refused, WithOneMessage) { expect_refused_once(); }

INSTANTIATE_TEST_SUITE_P(Deck, Refused,
                         ::testing::Combine(::testing::ValuesIn(deck_mistakes()), ::testing::Values(1, 4)),
                         mistake_name);
INSTANTIATE_TEST_SUITE_P(Input, Refused,
                         ::testing::Combine(::testing::ValuesIn(input_mistakes()), ::testing::Values(1, 4)),
                         mistake_name);

class Output : public BadInput, public ::testing::WithParamInterface<int> {};

TEST_P(Output, FolderMissing) {
  write_deck();
  expect_refused(GetParam(), {"exodus_file", "nowhere"}, {}, "nowhere/out");
}

TEST_P(Output, FolderIsAFile) {
  write_deck();
  expect_refused(GetParam(), {"exodus_file", "v.spn"}, {}, "v.spn/out");
}

// Where even root may not write.
TEST_P(Output, FolderNotWritable) {
  write_deck();
  expect_refused(GetParam(), {"exodus_file", "/proc/out"}, {}, "/proc/out");
}

TEST_P(Output, NameIsAFolder) {
  write_deck();
  std::filesystem::create_directory(path(fmt::format("dir.e.{}.0", GetParam())));
  expect_refused(GetParam(), {"exodus_file", "dir.e."}, {}, "dir");
}

// A file may not grow beyond the limit: as with a full disk, writing fails halfway. The settings keep Open
// MPI from making large files of its own for messages.
TEST_P(Output, FileSizeLimit) {
  const Voxels voxels = grains(20, 3, 1);
  write("v.spn", spn_text(voxels));
  write("deck.i", "BEGIN SCULPT\n" + spn_deck(voxels, "v.spn") + "stair = fast\nEND SCULPT\n");
  RunOptions options;
  options.largest_file = 65536;
  options.environment = {{"OMPI_MCA_btl", "self,tcp"}, {"PMIX_MCA_gds", "hash"}};
  expect_refused(GetParam(), {"'out.e.", "File too large"}, options);
}

TEST_P(Output, DiskFull) {
  write_deck();
  std::filesystem::create_directory(path("small"));
  RunOptions options;
  options.environment = {{"LD_PRELOAD", FULL_DISK_LIBRARY},
                         {"FULL_DISK", path("small")},
                         {"ASAN_OPTIONS", "verify_asan_link_order=0"}};
  expect_refused(GetParam(), {"'small/out.e.", "No space left"}, options, "small/out");
}

TEST_P(Output, EarlierResultIsReplacedWhenAllIsWell) {
  write_deck();
  const std::string n = std::to_string(GetParam());
  write("out.e." + n + ".0", "an earlier result\n");
  succeed({"sculpt", "-i", "deck.i", "-j", n, "-e", "out"});
  EXPECT_EQ(read_exodus(path("out.e." + n + ".0")).ranks, GetParam());
  EXPECT_EQ(static_cast<int>(snapshot().size()), 2 + GetParam()) << "something was left behind";
}

INSTANTIATE_TEST_SUITE_P(, Output, ::testing::Values(1, 4),
                         [](const auto& ranks) { return fmt::format("j{}", ranks.param); });

class BadCommandLine : public BadInput {
 protected:
  void expect_error(const Words& words, const Words& expected) {
    SCOPED_TRACE(fmt::format("{}", words.back()));
    Words all{"sculpt"};
    all.insert(all.end(), words.begin(), words.end());
    const auto before = snapshot();
    const RunResult result = run(all);
    expect_message(result, expected);
    EXPECT_TRUE(snapshot() == before);
  }
};

TEST_F(BadCommandLine, IsRefusedWithOneMessage) {
  write_deck();
  for (const std::string ranks : {"1", "4"}) {
    expect_error({"-i", "deck.i", "-j", ranks, "--nelxx", "3"}, {"command line", "'--nelxx'", "'--nelx'"});
    expect_error({"-i", "deck.i", "-j", ranks, "-nope"}, {"command line", "'-nope'"});
    expect_error({"-i", "deck.i", "-j", ranks, "-OT", "2"}, {"command line", "-OT", "2"});
    expect_error({"-i", "deck.i", "-j", ranks, "-x"}, {"command line", "-x"});
    expect_error({"-j", ranks, "deck.i"}, {"command line", "'deck.i'", "-i"});
  }
  expect_error({"-i", "deck.i", "-j", "0"}, {"-j", "0"});
  expect_error({"-i", "deck.i", "-j", "many"}, {"-j", "'many'"});
  expect_error({"-h", "nosuch"}, {"nosuch"});
}

TEST_F(BadCommandLine, MpiexecMustExist) {
  write_deck();
  expect_error({"-i", "deck.i", "-j", "2", "-mpi", "/no/mpiexec"}, {"'-mpi'", "'/no/mpiexec'"});
  expect_error({"-i", "deck.i", "-j", "2", "-mpi", "v.spn"}, {"'-mpi'", "'v.spn'"});
}

// A launcher that fails in silence must not make the run fail in silence.
TEST_F(BadCommandLine, MpiexecThatDoesNothing) {
  write_deck();
  expect_error({"-i", "deck.i", "-j", "2", "-mpi", "/bin/false"}, {"'/bin/false' ended with status 1"});
}

TEST_F(BadCommandLine, RanksMustBeAsManyAsTheLauncherStarted) {
  write_deck();
  const Words environment{"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM",
                          "OMPI_MCA_rmaps_base_oversubscribe"};
  RunOptions options;
  for (const std::string& name : environment) options.environment.emplace_back(name, "1");
  const auto before = snapshot();
  const RunResult result = run({"mpiexec", "-n", "3", PSCULPT_PROGRAM, "-j", "4", "-i", "deck.i"}, options);
  EXPECT_FALSE(result.timed_out);
  EXPECT_NE(result.status, 0);
  const Words lines = lines_of(result.error);
  EXPECT_EQ(std::count_if(lines.begin(), lines.end(),
                          [](const auto& l) { return l.starts_with("sculpt: error: "); }),
            1);
  EXPECT_NE(result.error.find("num_procs is 4 (command line), but the MPI launcher started 3 processes"),
            std::string::npos)
      << result.error;
  EXPECT_TRUE(snapshot() == before);
}

}  // namespace
}  // namespace sculpt::cli
