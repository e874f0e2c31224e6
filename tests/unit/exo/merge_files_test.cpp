#include "sculpt/exo/merge_files.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <numeric>

#include "row_of_cubes.hpp"
#include "sculpt/base/error.hpp"
#include "sculpt/exo/read_exodus.hpp"

namespace sculpt {
namespace {

using test::Cell;
using test::row_of_cubes;
using test::TemporaryFolder;
using test::write_row;

std::string error_of_merging(const std::string& base, int ranks) {
  try {
    merge_files(base, ranks);
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

TEST(MergeFiles, JoinsTwoCubes) {
  const TemporaryFolder folder;
  write_row(folder.file("m"), {{2, 1}, {1, 0}}, 2);
  const MergeResult result = merge_files(folder.file("m"), 2);
  EXPECT_EQ(result.path, folder.file("m.e"));
  const RankMesh mesh = read_exodus(folder.file("m.e"));
  EXPECT_EQ(mesh.title, "row of cubes");
  EXPECT_EQ(mesh.ranks, 1);
  EXPECT_EQ(mesh.x, (std::vector<double>{0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2}));
  EXPECT_EQ(mesh.y, (std::vector<double>{0, 0, 0, 1, 1, 1, 0, 0, 0, 1, 1, 1}));
  EXPECT_EQ(mesh.z, (std::vector<double>{0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1}));
  ASSERT_EQ(mesh.blocks.size(), 2U);
  EXPECT_EQ(mesh.blocks[0].id, 1);
  EXPECT_EQ(mesh.blocks[0].type, "HEX8");
  EXPECT_EQ(mesh.blocks[0].name, "material 1");
  EXPECT_EQ(mesh.blocks[0].nodes, (std::vector<std::int32_t>{2, 3, 6, 5, 8, 9, 12, 11}));
  EXPECT_EQ(mesh.blocks[1].id, 2);
  EXPECT_EQ(mesh.blocks[1].nodes, (std::vector<std::int32_t>{1, 2, 5, 4, 7, 8, 11, 10}));
  ASSERT_EQ(mesh.side_sets.size(), 2U);  // the cube at x = 0 is element 2, as block 1 comes first
  EXPECT_EQ(mesh.side_sets[0].element, std::vector<std::int32_t>{2});
  EXPECT_EQ(mesh.side_sets[0].side, std::vector<std::int32_t>{4});
  EXPECT_EQ(mesh.side_sets[1].element, std::vector<std::int32_t>{1});
  EXPECT_EQ(mesh.side_sets[1].side, std::vector<std::int32_t>{2});
  EXPECT_EQ(mesh.side_sets[1].name, "far");
  ASSERT_EQ(mesh.node_sets.size(), 1U);
  EXPECT_EQ(mesh.node_sets[0].node, (std::vector<std::int32_t>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(folder.files(), (std::vector<std::string>{"m.e", "m.e.2.0", "m.e.2.1"}));
}

TEST(MergeFiles, GivesTheSameMeshForAnyNumberOfRanks) {
  const TemporaryFolder folder;
  std::vector<Cell> cells;
  for (int c = 0; c < 12; ++c) cells.push_back({c % 3 == 0 ? 9 : c % 2, 0});
  write_row(folder.file("alone"), cells, 1);
  merge_files(folder.file("alone"), 1);
  const RankMesh alone = read_exodus(folder.file("alone.e"));
  EXPECT_EQ(alone.hex_id.size(), 12U);
  for (const int ranks : {2, 3, 5, 11, 14}) {  // with 14 two ranks own nothing
    for (std::size_t c = 0; c < cells.size(); ++c)
      cells[c].rank = static_cast<int>(c * 7) % std::min(ranks, 12);
    write_row(folder.file("m"), cells, ranks);
    merge_files(folder.file("m"), ranks);
    EXPECT_TRUE(read_exodus(folder.file("m.e")) == alone) << ranks;
  }
}

// Variable "a" is 10 step + element, "b" is only in block 2.
RankMesh with_variables(const std::vector<Cell>& cells, int rank, int ranks) {
  RankMesh mesh = row_of_cubes(cells, rank, ranks);
  mesh.times = {0, 0.5, 1.5};
  mesh.element_variables = {{"a", {1, 1}}, {"b", {0, 1}}};
  for (std::size_t step = 0; step < 3; ++step) {
    std::vector<double> a, b;
    for (const std::int64_t id : mesh.hex_id) {
      a.push_back(10.0 * static_cast<double>(step) + static_cast<double>(id));
      b.push_back(id > 2 ? -static_cast<double>(id) : 0);
    }
    mesh.element_values.push_back(a);
    mesh.element_values.push_back(b);
  }
  return mesh;
}

TEST(MergeFiles, JoinsElementVariablesAtAllTimes) {
  const TemporaryFolder folder;
  // Elements 1 and 2 are in block 1, elements 3 and 4 in block 2, which rank 0 does not have; rank 2 is
  // empty.
  const std::vector<Cell> cells{{2, 1}, {1, 0}, {2, 1}, {1, 1}};
  for (int r = 0; r < 3; ++r)
    write_rank_file(rank_file_name(folder.file("m"), 3, r), with_variables(cells, r, 3));
  const MergeResult result = merge_files(folder.file("m"), 3);
  EXPECT_EQ(result.element_variables, 2U);
  EXPECT_EQ(result.time_steps, 3U);
  EXPECT_EQ(result.dropped_variables, 0);
  const RankMesh mesh = read_exodus(folder.file("m.e"));
  EXPECT_EQ(mesh.times, (std::vector<double>{0, 0.5, 1.5}));
  ASSERT_EQ(mesh.element_variables.size(), 2U);
  EXPECT_EQ(mesh.element_variables[0].name, "a");
  EXPECT_EQ(mesh.element_variables[0].in_block, (std::vector<std::uint8_t>{1, 1}));
  EXPECT_EQ(mesh.element_variables[1].in_block, (std::vector<std::uint8_t>{0, 1}));
  ASSERT_EQ(mesh.element_values.size(), 6U);
  EXPECT_EQ(mesh.element_values[0], (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(mesh.element_values[4], (std::vector<double>{21, 22, 23, 24}));
  EXPECT_EQ(mesh.element_values[5], (std::vector<double>{0, 0, -3, -4}));
}

TEST(MergeFiles, KeepsIdsThatAreNotConsecutive) {
  const TemporaryFolder folder;
  for (int r = 0; r < 2; ++r) {
    RankMesh mesh = row_of_cubes({{1, 0}, {1, 1}}, r, 2);
    for (auto& id : mesh.node_id) id = 10 * id;
    for (auto& id : mesh.hex_id) id = 100 - id;
    write_rank_file(rank_file_name(folder.file("m"), 2, r), mesh);
  }
  merge_files(folder.file("m"), 2);
  const RankMesh mesh = read_exodus(folder.file("m.e"));
  EXPECT_EQ(mesh.hex_id, (std::vector<std::int64_t>{98, 99}));
  EXPECT_EQ(mesh.node_id.front(), 10);
  EXPECT_EQ(mesh.node_id.back(), 120);
  EXPECT_EQ(mesh.blocks[0].nodes,
            (std::vector<std::int32_t>{2, 3, 6, 5, 8, 9, 12, 11, 1, 2, 5, 4, 7, 8, 11, 10}));
  EXPECT_EQ(mesh.side_sets[0].element, std::vector<std::int32_t>{2});
}

TEST(MergeFiles, TakesOtherExtensionsAndNames) {
  const TemporaryFolder folder;
  write_rank_file(folder.file("m.g.1.0"), row_of_cubes({{1, 0}}, 0, 1));
  EXPECT_EQ(merge_files(folder.file("m"), 1, {"g", "", ""}).path, folder.file("m.g"));
  EXPECT_EQ(merge_files(folder.file("m"), 1, {"g", "exo", ""}).path, folder.file("m.exo"));
  EXPECT_EQ(merge_files(folder.file("m"), 1, {"g", "exo", folder.file("joined")}).path,
            folder.file("joined"));
  EXPECT_EQ(folder.files(), (std::vector<std::string>{"joined", "m.exo", "m.g", "m.g.1.0"}));
}

class FailedMerge : public testing::Test {
 protected:
  FailedMerge() {
    write_row(folder_.file("m"), {{1, 0}, {1, 1}, {2, 2}}, 3);
    std::ofstream(folder_.file("m.e")) << "earlier result";
  }
  void replace_rank(int rank, const RankMesh& mesh) {
    write_rank_file(rank_file_name(folder_.file("m"), 3, rank), mesh);
  }
  // The merge must fail with these words, and leave the earlier file and nothing else.
  void expect_refusal(const std::string& words) {
    const auto before = folder_.files();
    const std::string text = error_of_merging(folder_.file("m"), 3);
    EXPECT_NE(text.find(words), std::string::npos) << text;
    std::ifstream file(folder_.file("m.e"));
    std::string line;
    std::getline(file, line);
    EXPECT_EQ(line, "earlier result");
    EXPECT_EQ(folder_.files(), before);
  }
  std::vector<Cell> cells_{{1, 0}, {1, 1}, {2, 2}};
  TemporaryFolder folder_;
};

TEST_F(FailedMerge, NamesAMissingFile) {
  std::filesystem::remove(folder_.file("m.e.3.1"));
  expect_refusal("m.e.3.1' does not exist; expected 3 rank files");
}

TEST_F(FailedMerge, NoticesATruncatedFile) {
  std::filesystem::resize_file(folder_.file("m.e.3.2"),
                               std::filesystem::file_size(folder_.file("m.e.3.2")) - 8);
  expect_refusal("m.e.3.2' is cut short");
}

TEST_F(FailedMerge, NoticesAFileOfAnotherNumberOfRanks) {
  RankMesh mesh = row_of_cubes(cells_, 1, 3);
  mesh.ranks = 4;
  replace_rank(1, mesh);
  expect_refusal("m.e.3.1' was written by a run of 4 ranks, expected 3");
}

TEST_F(FailedMerge, NoticesASharedNodeInTwoPlaces) {
  RankMesh mesh = row_of_cubes(cells_, 1, 3);
  const auto shared = static_cast<std::size_t>(mesh.node_maps[0].nodes[0] - 1);
  mesh.y[shared] = 1e-9;
  replace_rank(1, mesh);
  expect_refusal("m.e.3.1': node 2 lies at (1, 1e-09, 0), but at (1, 0, 0)");
}

TEST_F(FailedMerge, NoticesAnElementThatIsThereTwice) {
  RankMesh mesh = row_of_cubes(cells_, 2, 3);
  mesh.hex_id[0] = 1;
  replace_rank(2, mesh);
  expect_refusal("have element 1 twice");
}

TEST_F(FailedMerge, NoticesANodeIdThatOneFileHasTwice) {
  RankMesh mesh = row_of_cubes(cells_, 0, 3);
  mesh.node_id[0] = mesh.node_id[1] = 13;
  mesh.global_nodes = 14;
  replace_rank(0, mesh);
  for (int r : {1, 2}) {
    RankMesh other = row_of_cubes(cells_, r, 3);
    other.global_nodes = 14;
    replace_rank(r, other);
  }
  expect_refusal("m.e.3.0' has node 13 twice");
}

TEST_F(FailedMerge, NoticesFilesOfAnotherMesh) {
  RankMesh mesh = row_of_cubes(cells_, 1, 3);
  mesh.global_hexes = 4;
  replace_rank(1, mesh);
  expect_refusal("the files come from different runs");
}

TEST_F(FailedMerge, NoticesAnotherOrderOfTheBlocks) {
  RankMesh mesh = row_of_cubes(cells_, 1, 3);
  std::swap(mesh.blocks[0], mesh.blocks[1]);
  replace_rank(1, mesh);
  expect_refusal("m.e.3.1': the blocks are in another order");
}

TEST_F(FailedMerge, NoticesABlockThatIsLeftOut) {
  RankMesh mesh = row_of_cubes(cells_, 1, 3);
  mesh.blocks.pop_back();
  replace_rank(1, mesh);
  expect_refusal("m.e.3.1' has 1 blocks, expected 2");
}

TEST_F(FailedMerge, NoticesOtherTimesAndVariables) {
  for (int r = 0; r < 3; ++r) replace_rank(r, with_variables(cells_, r, 3));
  RankMesh mesh = with_variables(cells_, 1, 3);
  mesh.times[2] = 7;
  replace_rank(1, mesh);
  expect_refusal("m.e.3.1' has 3 time steps");
  mesh = with_variables(cells_, 1, 3);
  mesh.element_variables[1].name = "c";
  replace_rank(1, mesh);
  expect_refusal("m.e.3.1' has other element variables than");
}

}  // namespace
}  // namespace sculpt
