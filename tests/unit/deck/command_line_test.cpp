#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "message.hpp"
#include "sculpt/deck/parse.hpp"

namespace sculpt {
namespace {

using Words = std::vector<std::string>;

const std::string kDeckText = "BEGIN SCULPT\nnelx = 4\nsmooth = 2\nmaterial_name = 1 iron\nEND SCULPT\n";

CommandLine parse(const Words& words) {
  return parse_command_line(words, [](const std::string&) { return kDeckText; });
}
std::string complaint(const Words& words) {
  return message_of([&] { (void)parse(words); });
}

TEST(ParseCommandLine, MixesShortAndLongForms) {
  const Deck deck =
      parse({"-x", "10",   "--nely", "24", "-z", "15", "-isp", "\"my file.spn\"",  "-p",
             "1",  "-str", "full",   "-S", "2",  "-s", "2.5",  "--gen_sidesets=5", "-print_input",
             "-t", "-0.5"})
          .deck;
  EXPECT_EQ(deck.nelx, 10);
  EXPECT_EQ(deck.nely, 24);
  EXPECT_EQ(deck.nelz, 15);
  EXPECT_EQ(deck.input_spn, "my file.spn");
  EXPECT_EQ(deck.pillow, kPillowSurfaces);
  EXPECT_EQ(deck.stair, kStairFull);
  EXPECT_EQ(deck.smooth, kSmoothFixedBbox);
  EXPECT_EQ(deck.zmax, 2.5);
  EXPECT_EQ(deck.gen_sidesets, kSidesetsRve);
  EXPECT_EQ(deck.xmin, -0.5);
  EXPECT_TRUE(deck.print_input);
  EXPECT_EQ(deck.given_options.place("nelx"), "command line");
}

TEST(ParseCommandLine, WinsOverTheDeckWhereverTheDeckIsNamed) {
  for (const Words& words : {Words{"-i", "a.i", "-x", "8", "-mn", "1", "copper"},
                             Words{"-mn", "1", "copper", "-x", "8", "-i", "a.i"}}) {
    const Deck deck = parse(words).deck;
    EXPECT_EQ(deck.nelx, 8);
    EXPECT_EQ(deck.smooth, 2);
    EXPECT_EQ(deck.material_name, (std::vector<IdName>{{1, "copper"}}));
    EXPECT_EQ(deck.input_file, "a.i");
    EXPECT_EQ(deck.given_options.place("smooth"), "line 3 of a.i");
  }
}

TEST(ParseCommandLine, ReadsTheLastNamedDeckOnce) {
  Words read;
  const Words words{"-i", "a.i", "--input_file", "b.i"};
  (void)parse_command_line(words, [&](const std::string& name) {
    read.push_back(name);
    return kDeckText;
  });
  EXPECT_EQ(read, Words{"b.i"});
}

TEST(ParseCommandLine, ChoosesTheAction) {
  EXPECT_EQ(parse({}).action, Action::kHelp);
  EXPECT_EQ(parse({"-h"}).action, Action::kHelp);
  EXPECT_EQ(parse({"-h"}).help_topic, "");
  EXPECT_EQ(parse({"--help", "--input_spn"}).help_topic, "--input_spn");
  EXPECT_EQ(parse({"-x", "3", "-h", "pillow_surfaces", "-x", "bad"}).help_topic, "pillow_surfaces");
  EXPECT_EQ(parse({"-vs"}).action, Action::kVersion);
  EXPECT_EQ(parse({"-i", "a.i", "--print_input"}).action, Action::kPrintInput);
  EXPECT_EQ(parse({"-i", "a.i", "-pi"}).action, Action::kPrintInput);
  EXPECT_EQ(parse({"-i", "a.i"}).action, Action::kRun);
}

TEST(ParseCommandLine, HelpAndVersionReadNoDeck) {
  const ReadText refuse = [](const std::string&) -> std::string { throw Error("read"); };
  EXPECT_EQ(parse_command_line(Words{"-i", "a.i", "-h"}, refuse).action, Action::kHelp);
  EXPECT_EQ(parse_command_line(Words{"-i", "a.i", "-vs"}, refuse).action, Action::kVersion);
}

TEST(ParseCommandLine, FlagsTakeATruthValueOnlyIfItIsOne) {
  EXPECT_TRUE(parse({"-ps", "-x", "3"}).deck.pillow_surfaces);
  EXPECT_TRUE(parse({"-ps", "true"}).deck.pillow_surfaces);
  EXPECT_FALSE(parse({"-ps", "OFF"}).deck.pillow_surfaces);
  EXPECT_TRUE(parse({"-ps", "off"}).deck.given("pillow_surfaces"));
  EXPECT_TRUE(parse({"-V"}).deck.mesh_void);
  EXPECT_TRUE(parse({"-V", "1"}).deck.mesh_void);
  EXPECT_FALSE(parse({"--compress_spn_ids", "false"}).deck.compress_spn_ids);
  EXPECT_EQ(complaint({"-ps", "1"}), "command line: '1' is not an option; a deck is given with '-i <file>'");
}

TEST(ParseCommandLine, ReadsListsAndRecords) {
  EXPECT_EQ(parse({"-imb", "2", "4", "-x", "3"}).deck.input_mesh_blocks, (std::vector<std::int64_t>{2, 4}));
  EXPECT_EQ(parse({"-imb", "2 4"}).deck.input_mesh_blocks, (std::vector<std::int64_t>{2, 4}));
  const Deck deck =
      parse({"-thm", "3", "0.2", "-thm", "1 0.33", "-sid", "5", "-1", "0", "0", "1", "1", "1"}).deck;
  EXPECT_EQ(deck.thicken_material, (std::vector<MaterialValue>{{3, 0.2}, {1, 0.33}}));
  EXPECT_EQ(deck.sideset, (std::vector<IdBox>{{5, {-1, 0, 0, 1, 1, 1}}}));
}

TEST(ParseCommandLine, JpIsJprocAndJoinParallelHasALongNameOnly) {
  EXPECT_EQ(parse({"-jp", "2"}).deck.jproc, 2);
  EXPECT_FALSE(parse({"-jp", "2"}).deck.join_parallel);
  EXPECT_TRUE(parse({"--join_parallel"}).deck.join_parallel);
}

TEST(ParseCommandLine, AcceptsTheHiddenFlagOfCubit) {
  EXPECT_TRUE(parse({"-j", "4", "--cubit_launch", "-i", "a.i"}).deck.cubit_launch);
}

TEST(ParseCommandLine, SaysWhatIsWrong) {
  EXPECT_EQ(complaint({"--nelxx", "3"}), "command line: unknown option '--nelxx'; did you mean '--nelx'?");
  EXPECT_EQ(complaint({"-nelxx", "3"}), "command line: unknown option '-nelxx'; did you mean '--nelx'?");
  EXPECT_EQ(complaint({"-ss", "2"}), "command line: unknown option '-ss'; did you mean '-SS'?");
  EXPECT_EQ(complaint({"deck.i"}),
            "command line: 'deck.i' is not an option; a deck is given with '-i <file>'");
  EXPECT_EQ(complaint({"-x", "-y", "3"}), "command line: option '-x' needs an integer from 1 to 1000000000");
  EXPECT_EQ(complaint({"-x", "3.5"}),
            "command line: option '-x' needs an integer from 1 to 1000000000, found '3.5'");
  EXPECT_EQ(complaint({"--nelx="}), "command line: option '--nelx' needs an integer from 1 to 1000000000");
  EXPECT_EQ(complaint({"-thm", "3", "-x", "3"}),
            "command line: option '-thm' needs an id and a value, found '3'");
  EXPECT_EQ(complaint({"-i"}), "command line: option '-i' needs one file name (in quotes if it has blanks)");
  EXPECT_EQ(complaint({"-beg", "blayer"}), "command line: option '-beg' is not supported yet");
  EXPECT_EQ(complaint({"-j", "0"}),
            "command line: option '-j' needs an integer from 1 to 1000000, found '0'");
}

TEST(ReadDeckFile, NamesTheFileItCannotOpen) {
  EXPECT_EQ(message_of([] { (void)read_deck_file("no/such/deck.i"); }),
            "deck 'no/such/deck.i': cannot open the file: No such file or directory");
  const std::string folder = std::filesystem::temp_directory_path().string();
  EXPECT_EQ(message_of([&] { (void)read_deck_file(folder); }),
            "deck '" + folder + "': this is a folder, not a file");
}

TEST(ReadDeckFile, GivesTheBytesOfTheFile) {
  const auto path = std::filesystem::temp_directory_path() / "sculpt_read_deck_file_test.i";
  std::ofstream(path, std::ios::binary) << "a\r\nb";
  EXPECT_EQ(read_deck_file(path.string()), "a\r\nb");
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace sculpt
