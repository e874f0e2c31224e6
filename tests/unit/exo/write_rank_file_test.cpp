#include "sculpt/exo/write_rank_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <functional>

#include "row_of_cubes.hpp"
#include "sculpt/base/error.hpp"
#include "sculpt/exo/read_exodus.hpp"

namespace sculpt {
namespace {

using test::Cell;
using test::row_of_cubes;
using test::TemporaryFolder;

std::string error_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

// Write then read is the identity, but for the rank, which the file does not hold.
void expect_identity(RankMesh mesh) {
  const TemporaryFolder folder;
  write_rank_file(folder.file("m"), mesh);
  mesh.rank = 0;
  const RankMesh back = read_exodus(folder.file("m"));
  EXPECT_TRUE(back == mesh);
  EXPECT_EQ(back.title, mesh.title);
  EXPECT_EQ(back.node_id, mesh.node_id);
  EXPECT_EQ(back.hex_id, mesh.hex_id);
  EXPECT_EQ(back.node_maps.size(), mesh.node_maps.size());
  EXPECT_EQ(back.element_maps.size(), mesh.element_maps.size());
}

TEST(RankFileName, PadsTheRankToTheDigitsOfTheNumberOfRanks) {
  EXPECT_EQ(rank_file_name("m", 1, 0), "m.e.1.0");
  EXPECT_EQ(rank_file_name("m", 9, 8), "m.e.9.8");
  EXPECT_EQ(rank_file_name("a/m.e", 10, 7), "a/m.e.e.10.07");
  EXPECT_EQ(rank_file_name("m", 100, 99), "m.e.100.099");
  EXPECT_EQ(rank_file_name("m", 4, 1, "g"), "m.g.4.1");
}

TEST(TemporaryName, StaysInTheFolder) {
  EXPECT_EQ(temporary_name("m.e.1.0"), ".m.e.1.0.part");
  EXPECT_EQ(temporary_name("some.where/m.e.1.0"), "some.where/.m.e.1.0.part");
  for (const std::string name : {"m.e.1.0", "some.where/m.e.1.0", "/.hidden", "a.part"}) {
    EXPECT_EQ(shown_name(temporary_name(name)), name);
    EXPECT_EQ(shown_name(name), name);
  }
}

TEST(WriteRankFile, ReadsBackASerialMesh) { expect_identity(row_of_cubes({{1, 0}, {1, 0}, {7, 0}}, 0, 1)); }

TEST(WriteRankFile, ReadsBackEveryRankOfThree) {
  for (int rank = 0; rank < 3; ++rank)  // blocks 1 and 3 are absent on some ranks
    expect_identity(row_of_cubes({{3, 0}, {3, 0}, {1, 1}, {2, 1}, {1, 2}}, rank, 3));
}

TEST(WriteRankFile, ReadsBackARankWithoutElements) { expect_identity(row_of_cubes({{3, 0}, {4, 1}}, 2, 3)); }

TEST(WriteRankFile, ReadsBackABlockWithTheIdZeroAndAnAwkwardName) {
  RankMesh mesh = row_of_cubes({{0, 0}, {1, 0}}, 0, 1);
  mesh.blocks[0].name = std::string(kLongestExodusName, 'v');
  mesh.blocks[1].name = "";
  expect_identity(mesh);
}

TEST(WriteRankFile, ReadsBack64BitIds) {
  RankMesh mesh = row_of_cubes({{1, 0}}, 0, 1);
  for (auto& id : mesh.node_id) id += std::int64_t{5} << 32;
  mesh.hex_id[0] = std::int64_t{7} << 33;
  mesh.global_hexes = std::int64_t{1} << 40;
  mesh.large = true;  // what the writer chooses by itself for such ids
  expect_identity(mesh);
  const TemporaryFolder folder;
  mesh.large = false;
  write_rank_file(folder.file("m"), mesh);
  EXPECT_TRUE(read_exodus(folder.file("m")).large);
}

TEST(WriteRankFile, ReadsBackThousandsOfBlocksAndSets) {
  RankMesh mesh = row_of_cubes({{1, 0}}, 0, 1);
  const RankMesh::Block cube = mesh.blocks[0];
  mesh.blocks.clear();
  mesh.hex_id.clear();
  for (int b = 0; b < 2000; ++b) {
    mesh.blocks.push_back(cube);
    mesh.blocks.back().id = b + 1;
    mesh.hex_id.push_back(b + 1);
    mesh.side_sets.push_back({100 + b, "side " + std::to_string(b), 1, {b + 1}, {b % 6 + 1}});
    mesh.node_sets.push_back({100 + b, "", 1, {b % 8 + 1}});
  }
  mesh.global_hexes = 2000;
  expect_identity(mesh);
}

// Two variables at two times; the second one has no values in block 7.
RankMesh with_variables(const std::vector<Cell>& cells, int rank, int ranks) {
  RankMesh mesh = row_of_cubes(cells, rank, ranks);
  mesh.times = {0, 2.5};
  mesh.element_variables = {{"quality", {1, 1}}, {std::string(40, 'v'), {1, 0}}};
  for (const double step : {100.0, 200.0})
    for (int v = 0; v < 2; ++v) {
      auto& values = mesh.element_values.emplace_back();
      for (const std::int64_t id : mesh.hex_id)
        values.push_back(v == 0 || id < 3 ? step + 10.0 * v + static_cast<double>(id) : 0);
    }
  return mesh;
}

TEST(WriteRankFile, ReadsBackElementVariables) {
  expect_identity(with_variables({{1, 0}, {7, 0}, {1, 0}}, 0, 1));
  expect_identity(with_variables({{1, 0}, {7, 1}, {1, 0}, {7, 0}}, 0, 2));
}

TEST(WriteRankFile, RefusesVariablesWithoutValues) {
  const TemporaryFolder folder;
  RankMesh mesh = with_variables({{1, 0}, {7, 0}, {1, 0}}, 0, 1);
  mesh.element_values.back().pop_back();
  EXPECT_THROW(write_rank_file(folder.file("m"), mesh), BrokenPromise);
  mesh.element_values.pop_back();
  EXPECT_THROW(write_rank_file(folder.file("m"), mesh), BrokenPromise);
  mesh = with_variables({{1, 0}, {7, 0}, {1, 0}}, 0, 1);
  mesh.element_variables[1].in_block.pop_back();
  EXPECT_THROW(write_rank_file(folder.file("m"), mesh), BrokenPromise);
  EXPECT_TRUE(folder.files().empty());
}

TEST(WriteRankFile, CutsALongTitle) {
  const TemporaryFolder folder;
  RankMesh mesh = row_of_cubes({{1, 0}}, 0, 1);
  mesh.title = std::string(500, 't');
  write_rank_file(folder.file("m"), mesh);
  EXPECT_EQ(read_exodus(folder.file("m")).title, std::string(80, 't'));
}

TEST(WriteRankFile, RefusesANameThatExodusCannotHold) {
  const TemporaryFolder folder;
  RankMesh mesh = row_of_cubes({{3, 0}}, 0, 1);
  mesh.blocks[0].name = std::string(300, 'n');
  const std::string text = error_of([&] { write_rank_file(folder.file("m"), mesh); });
  EXPECT_NE(text.find("block 3 has 300 characters, Exodus allows 255"), std::string::npos) << text;
  EXPECT_TRUE(folder.files().empty());
}

TEST(WriteRankFile, RefusesAMeshThatContradictsItself) {
  const TemporaryFolder folder;
  RankMesh mesh = row_of_cubes({{3, 0}, {3, 1}}, 0, 2);
  mesh.blocks[0].nodes[5] = 9;
  EXPECT_THROW(write_rank_file(folder.file("m"), mesh), BrokenPromise);
  mesh = row_of_cubes({{3, 0}, {3, 1}}, 0, 2);
  mesh.border_elements.clear();
  EXPECT_THROW(write_rank_file(folder.file("m"), mesh), BrokenPromise);
  EXPECT_TRUE(folder.files().empty());
}

TEST(WriteRankFile, NamesAFolderThatDoesNotExist) {
  const TemporaryFolder folder;
  const std::string path = folder.file("no/such/m");
  const std::string text = error_of([&] { write_rank_file(path, row_of_cubes({{1, 0}}, 0, 1)); });
  EXPECT_NE(text.find(path), std::string::npos) << text;
  EXPECT_NE(text.find("No such file or directory"), std::string::npos) << text;
}

// A limit on the size of files stands in for a full disk: the library gets the same kind of refusal.
TEST(WriteRankFile, LeavesNothingBehindWhenTheDiskRefuses) {
  const TemporaryFolder folder;
  RankMesh mesh = row_of_cubes({{1, 0}}, 0, 1);
  for (int copy = 0; copy < 16; ++copy)
    mesh.blocks[0].nodes.insert(mesh.blocks[0].nodes.end(), mesh.blocks[0].nodes.begin(),
                                mesh.blocks[0].nodes.end());
  for (std::int64_t id = 2; id <= 65536; ++id) mesh.hex_id.push_back(id);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit tight{100000, before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &tight);
  const std::string text = error_of([&] { write_rank_file(folder.file("m"), mesh); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_NE(text.find(folder.file("m")), std::string::npos) << text;
  EXPECT_NE(text.find("File too large"), std::string::npos) << text;
  EXPECT_TRUE(folder.files().empty());
}

TEST(Publish, ReplacesAnEarlierFileAndDiscardTakesAwayTheTemporaryOne) {
  const TemporaryFolder folder;
  std::ofstream(folder.file("m")) << "old";
  write_rank_file(folder.file("new"), row_of_cubes({{1, 0}}, 0, 1));
  publish(folder.file("new"), folder.file("m"));
  EXPECT_EQ(folder.files(), std::vector<std::string>{"m"});
  EXPECT_EQ(read_exodus(folder.file("m")).hex_id.size(), 1U);
  EXPECT_NE(error_of([&] { publish(folder.file("gone"), folder.file("m")); }).find("cannot put"),
            std::string::npos);
  EXPECT_EQ(folder.files(), std::vector<std::string>{"m"});
  discard(folder.file("m"));
  discard(folder.file("m"));
  EXPECT_TRUE(folder.files().empty());
}

}  // namespace
}  // namespace sculpt
