// Joining the files of a run.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "cases.hpp"
#include "scratch.hpp"
#include "sculpt/exo/read_exodus.hpp"

namespace sculpt::cli {
namespace {

class Eputool : public Scratch {
 protected:
  void make(int ranks, const std::string& base, const Voxels& voxels = letter_f()) const {
    write("v.spn", spn_text(voxels));
    write("deck.i", "BEGIN SCULPT\n" + spn_deck(voxels, "v.spn") + "stair = fast\nEND SCULPT\n");
    succeed({"sculpt", "-qt", "-j", std::to_string(ranks), "-i", "deck.i", "-e", base});
  }
  // One message with all these words, no file more or less.
  void expect_refused(const Words& words, const Words& expected) const {
    SCOPED_TRACE(fmt::format("eputool {}", words.back()));
    Words all{"eputool"};
    all.insert(all.end(), words.begin(), words.end());
    const auto before = snapshot();
    const RunResult result = run(all);
    EXPECT_FALSE(result.timed_out);
    EXPECT_GT(result.status, 0);
    EXPECT_EQ(lines_of(result.error).size(), 1U) << result.error;
    for (const std::string& part : expected)
      EXPECT_NE(result.error.find(part), std::string::npos)
          << "expected '" << part << "' in: " << result.error;
    EXPECT_TRUE(snapshot() == before);
  }
};

TEST_F(Eputool, JoinsOneFile) {
  make(1, "one");
  EXPECT_EQ(succeed({"eputool", "-p", "1", "one"}).out,
            "one.e: 120 nodes, 60 elements, 2 blocks, 0 side sets, 0 node sets from 1 file\n");
  EXPECT_EQ(hexes_of(read_exodus(path("one.e"))), 60);
}

TEST_F(Eputool, JoinsManyFilesToTheSameMesh) {
  make(1, "one");
  make(4, "four");
  succeed({"eputool", "-p", "1", "one"});
  succeed({"eputool", "-processor_count", "4", "four"});
  EXPECT_TRUE(read_exodus(path("one.e")) == read_exodus(path("four.e")));
}

TEST_F(Eputool, FindsTheNumberOfFilesByItself) {
  make(10, "ten");
  EXPECT_NE(succeed({"eputool", "-auto", "ten.e.10.07"}).out.find("60 elements"), std::string::npos);
  EXPECT_TRUE(exists("ten.e"));
}

TEST_F(Eputool, NamesTheOutput) {
  make(2, "m");
  succeed({"eputool", "-p", "2", "-output_extension", "g", "m"});
  EXPECT_TRUE(exists("m.g"));
  succeed({"eputool", "-p", "2", "-output", "whole name", "m"});
  EXPECT_TRUE(exists("whole name"));
  EXPECT_FALSE(exists("m.e"));
}

TEST_F(Eputool, WorksFromAnotherFolder) {
  std::filesystem::create_directory(path("results"));
  make(2, "results/m");
  succeed({"eputool", "-p", "2", "results/m"});
  EXPECT_TRUE(exists("results/m.e"));
}

TEST_F(Eputool, RefusesWrongWords) {
  make(2, "m");
  expect_refused({"m"}, {"number of files"});
  expect_refused({"-p", "2"}, {"base name"});
  expect_refused({"-p", "0", "m"}, {"-p", "'0'"});
  expect_refused({"-p", "two", "m"}, {"-p", "'two'"});
  expect_refused({"-p", "2", "m", "n"}, {"'n'", "'m'"});
  expect_refused({"-q", "m"}, {"'-q'"});
  expect_refused({"-auto", "m"}, {"-auto", "'m'"});
  expect_refused({"m", "-p"}, {"-p", "value"});
}

TEST_F(Eputool, RefusesFilesThatDoNotFit) {
  make(2, "m");
  expect_refused({"-p", "3", "m"}, {"m.e.3.0", "does not exist"});
  expect_refused({"-p", "2", "nosuch"}, {"nosuch.e.2.0", "does not exist"});
  succeed({"eputool", "-p", "2", "m"});
  const auto joined = read("m.e");

  make(2, "other", Voxels{4, 4, 4, [](int i, int, int) { return i + 1; }});
  std::filesystem::copy_file(path("other.e.2.1"), path("m.e.2.1"),
                             std::filesystem::copy_options::overwrite_existing);
  expect_refused({"-p", "2", "m"}, {"m.e.2.1"});

  std::filesystem::resize_file(path("m.e.2.1"), 1000);
  expect_refused({"-p", "2", "m"}, {"m.e.2.1"});
  write("m.e.2.1", "");
  expect_refused({"-p", "2", "m"}, {"m.e.2.1"});
  std::filesystem::remove(path("m.e.2.1"));
  expect_refused({"-p", "2", "m"}, {"m.e.2.1", "does not exist"});
  EXPECT_EQ(read("m.e"), joined) << "the earlier result stays";
}

TEST_F(Eputool, RefusesAnOutputThatCannotBeWritten) {
  make(2, "m");
  expect_refused({"-p", "2", "-output", "nowhere/m.e", "m"}, {"nowhere/"});
  expect_refused({"-p", "2", "-output", "/proc/m.e", "m"}, {"/proc/"});
  std::filesystem::create_directory(path("m.e"));
  expect_refused({"-p", "2", "m"}, {"m.e"});
}

TEST_F(Eputool, PrintsItsHelp) {
  const std::string text = succeed({"eputool", "-help"}).out;
  EXPECT_NE(text.find("Usage: eputool -p N"), std::string::npos);
  expect_refused({""}, {});
}

}  // namespace
}  // namespace sculpt::cli
