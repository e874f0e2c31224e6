#include "sculpt/exo/read_exodus.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "row_of_cubes.hpp"
#include "sculpt/base/error.hpp"

namespace sculpt {
namespace {

using test::row_of_cubes;
using test::TemporaryFolder;

std::string error_of_reading(const std::string& path) {
  try {
    (void)read_exodus(path);
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(ReadExodus, NamesAMissingFile) {
  const TemporaryFolder folder;
  const std::string text = error_of_reading(folder.file("gone.e"));
  EXPECT_NE(text.find("cannot open '" + folder.file("gone.e") + "': No such file or directory"),
            std::string::npos)
      << text;
}

TEST(ReadExodus, RefusesAFolder) {
  const TemporaryFolder folder;
  EXPECT_NE(error_of_reading(folder.file("")).find("it is a folder"), std::string::npos);
}

TEST(ReadExodus, RefusesWhatIsNotNetcdf) {
  const TemporaryFolder folder;
  std::ofstream(folder.file("a.e")) << "solid cube\n";
  std::ofstream(folder.file("empty.e"));
  EXPECT_NE(error_of_reading(folder.file("a.e")).find("is not an Exodus file"), std::string::npos);
  EXPECT_NE(error_of_reading(folder.file("empty.e")).find("is not an Exodus file"), std::string::npos);
}

TEST(ReadExodus, RefusesANetcdfFileOfAnotherKind) {
  const TemporaryFolder folder;
  std::ofstream file(folder.file("a.nc"), std::ios::binary);
  const char empty[32] = {'C', 'D', 'F', 1};  // no dimension, no attribute, no variable
  file.write(empty, sizeof empty);
  file.close();
  EXPECT_NE(error_of_reading(folder.file("a.nc")).find("cannot be read as an Exodus file"),
            std::string::npos);
}

// netCDF itself would deliver zeros for the part that is missing.
TEST(ReadExodus, NoticesAClassicFileCutAnywhere) {
  const TemporaryFolder folder;
  write_rank_file(folder.file("m"), row_of_cubes({{1, 0}, {2, 0}}, 0, 1));
  const std::string whole = bytes_of(folder.file("m"));
  for (const std::size_t length :
       {whole.size() - 4, whole.size() - 100, whole.size() / 2, std::size_t{200}, std::size_t{5}}) {
    std::ofstream(folder.file("cut"), std::ios::binary) << whole.substr(0, length);
    const std::string text = error_of_reading(folder.file("cut"));
    EXPECT_TRUE(text.find("is cut short") != std::string::npos ||
                text.find("is not a complete netCDF file") != std::string::npos)
        << length << ": " << text;
  }
}

TEST(ReadExodus, NoticesANetcdf4FileThatWasCut) {
  const TemporaryFolder folder;
  RankMesh mesh = row_of_cubes({{1, 0}, {2, 0}}, 0, 1);
  mesh.large = true;
  write_rank_file(folder.file("m"), mesh);
  const std::string whole = bytes_of(folder.file("m"));
  ASSERT_EQ(whole.substr(1, 3), "HDF");
  std::ofstream(folder.file("cut"), std::ios::binary) << whole.substr(0, whole.size() / 2);
  const std::string text = error_of_reading(folder.file("cut"));
  EXPECT_NE(text.find("is cut short"), std::string::npos) << text;
}

TEST(ReadExodus, NamesAnElementWithANodeThatDoesNotExist) {
  const TemporaryFolder folder;
  RankMesh mesh = row_of_cubes({{1, 0}, {4, 0}}, 0, 1);
  write_rank_file(folder.file("m"), mesh);
  std::string bytes = bytes_of(folder.file("m"));
  std::string nodes;  // of the second cube, as they stand in the file: big-endian
  for (const std::int32_t n : mesh.blocks[1].nodes) nodes += std::string(3, '\0') + static_cast<char>(n);
  const std::size_t at = bytes.rfind(nodes);
  ASSERT_NE(at, std::string::npos);
  bytes[at + 3] = 99;
  std::ofstream(folder.file("bad"), std::ios::binary) << bytes;
  EXPECT_NE(
      error_of_reading(folder.file("bad")).find("block 4, entry 1: node 99 does not exist, expected 1 to 12"),
      std::string::npos)
      << error_of_reading(folder.file("bad"));
}

TEST(ReadExodus, CountsTheElementsOfTheBlocks) {
  const TemporaryFolder folder;
  write_rank_file(folder.file("m"), row_of_cubes({{1, 0}, {1, 0}, {1, 0}}, 0, 1));
  std::string bytes = bytes_of(folder.file("m"));
  const std::string name("\0\0\0\010num_elem", 12);
  const std::size_t at = bytes.find(name);
  ASSERT_NE(at, std::string::npos);
  bytes[at + name.size() + 3] = 2;
  std::ofstream(folder.file("bad"), std::ios::binary) << bytes;
  EXPECT_NE(error_of_reading(folder.file("bad")).find("elements"), std::string::npos);
}

TEST(ExodusReader, DeliversPieces) {
  const TemporaryFolder folder;
  write_rank_file(folder.file("m"), row_of_cubes({{1, 0}, {4, 1}}, 1, 2));
  ExodusReader reader(folder.file("m"));
  const ExodusReader::Header& header = reader.header();
  EXPECT_TRUE(header.nemesis);
  EXPECT_EQ(header.ranks, 2);
  EXPECT_EQ(header.global_elements, 2);
  ASSERT_EQ(header.blocks.size(), 2U);
  EXPECT_EQ(header.blocks[0].count, 0);
  EXPECT_EQ(header.blocks[0].global_count, 1);
  EXPECT_EQ(header.blocks[1].name, "material 4");
  EXPECT_TRUE(reader.connectivity(0).empty());
  EXPECT_EQ(reader.connectivity(1).size(), 8U);
  EXPECT_EQ(reader.element_ids(), std::vector<std::int64_t>{2});
}

template <class T>
std::vector<T> piece(const std::vector<T>& list, ExodusRange range, std::size_t per_item = 1) {
  const auto begin = list.begin() + range.first * static_cast<std::ptrdiff_t>(per_item);
  return {begin, begin + range.count * static_cast<std::ptrdiff_t>(per_item)};
}

// Five cubes in two blocks, values at two steps, one variable in the second block only.
RankMesh row_with_values() {
  RankMesh mesh = row_of_cubes({{1, 0}, {7, 0}, {7, 0}, {1, 0}, {7, 0}}, 0, 1);
  mesh.times = {0, 0.5};
  mesh.element_variables = {{"grain", {1, 1}}, {"phase", {0, 1}}};
  mesh.element_values = {{1, 2, 3, 4, 5}, {0, 0, 6, 7, 8}, {9, 10, 11, 12, 13}, {0, 0, 14, 15, 16}};
  mesh.side_sets[0].global_count = 4;
  mesh.side_sets[0].element = {1, 2, 4, 5};
  mesh.side_sets[0].side = {4, 6, 1, 2};
  mesh.node_id = {30, 2, 17, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 3, 18, 19, 20, 21, 22, 23, 24};
  mesh.hex_id = {5, 3, 1, 2, 4};
  return mesh;
}

void expect_pieces_of_the_whole(const std::string& path) {
  const RankMesh whole = read_exodus(path);
  ExodusReader reader(path);
  for (const ExodusRange range : {ExodusRange{0, 1}, {0, 2}, {1, 1}, {1, 0}, {2, 0}, {0, 0}}) {
    EXPECT_EQ(reader.connectivity(0, range), piece(whole.blocks[0].nodes, range, 8));
    const std::vector<double> grain(whole.element_values[2].begin(), whole.element_values[2].begin() + 2);
    EXPECT_EQ(reader.block_values(1, 0, 0, range), piece(grain, range));
    EXPECT_EQ(reader.block_values(1, 1, 0, range), std::vector<double>(piece(grain, range).size(), 0));
  }
  for (const ExodusRange range : {ExodusRange{0, 3}, {1, 2}, {2, 1}, {3, 0}}) {
    EXPECT_EQ(reader.connectivity(1, range), piece(whole.blocks[1].nodes, range, 8));
    const std::vector<double> phase(whole.element_values[3].begin() + 2, whole.element_values[3].end());
    EXPECT_EQ(reader.block_values(1, 1, 1, range), piece(phase, range));
  }
  for (const ExodusRange range : {ExodusRange{0, 4}, {1, 2}, {3, 1}, {4, 0}}) {
    std::vector<std::int32_t> element, side;
    reader.side_set(0, element, side, range);
    EXPECT_EQ(element, piece(whole.side_sets[0].element, range));
    EXPECT_EQ(side, piece(whole.side_sets[0].side, range));
    EXPECT_EQ(reader.node_set(0, range), piece(whole.node_sets[0].node, range));
    EXPECT_EQ(reader.element_ids(range), piece(whole.hex_id, range));
  }
  for (const ExodusRange range : {ExodusRange{0, 24}, {5, 7}, {23, 1}, {24, 0}}) {
    std::vector<double> x, y, z;
    reader.coordinates(x, y, z, range);
    EXPECT_EQ(x, piece(whole.x, range));
    EXPECT_EQ(y, piece(whole.y, range));
    EXPECT_EQ(z, piece(whole.z, range));
    EXPECT_EQ(reader.node_ids(range), piece(whole.node_id, range));
  }
  EXPECT_EQ(reader.node_set(0, {3, ExodusRange::kToTheEnd}), piece(whole.node_sets[0].node, {3, 9}));
  EXPECT_THROW((void)reader.node_set(0, {3, 10}), BrokenPromise);
}

TEST(ExodusReader, DeliversRangesOfItsLists) {
  const TemporaryFolder folder;
  RankMesh mesh = row_with_values();
  write_rank_file(folder.file("m"), mesh);
  const RankMesh read = read_exodus(folder.file("m"));
  EXPECT_EQ(read.element_values, mesh.element_values);
  EXPECT_EQ(read.node_id, mesh.node_id);
  EXPECT_EQ(read.hex_id, mesh.hex_id);
  EXPECT_EQ(read.side_sets, mesh.side_sets);
  expect_pieces_of_the_whole(folder.file("m"));
  mesh.large = true;  // 64-bit integers
  write_rank_file(folder.file("large"), mesh);
  expect_pieces_of_the_whole(folder.file("large"));
}

// The 32-bit numbers of a classic file, as they stand there: big-endian.
std::string big_endian(const std::vector<std::int32_t>& numbers) {
  std::string bytes;
  for (const std::int32_t n : numbers) bytes += std::string(3, '\0') + static_cast<char>(n);
  return bytes;
}

void replace_everywhere(const std::string& path, const std::vector<std::int32_t>& old,
                        const std::vector<std::int32_t>& by) {
  std::string bytes = bytes_of(path);
  const std::string from = big_endian(old), to = big_endian(by);
  ASSERT_NE(bytes.find(from), std::string::npos);
  for (std::size_t at = bytes.find(from); at != std::string::npos; at = bytes.find(from, at + 1))
    bytes.replace(at, from.size(), to);
  std::ofstream(path, std::ios::binary) << bytes;
}

TEST(ExodusReader, CountsEntriesFromTheBeginningOfTheList) {
  const TemporaryFolder folder;
  const RankMesh mesh = row_of_cubes({{1, 0}, {1, 0}, {1, 0}}, 0, 1);
  write_rank_file(folder.file("m"), mesh);
  replace_everywhere(folder.file("m"), {3, 4, 8, 7}, {3, 99, 8, 7});        // of the third cube
  replace_everywhere(folder.file("m"), {4, 5, 6, 7, 8}, {4, 5, 77, 7, 8});  // of the set
  ExodusReader reader(folder.file("m"));
  const auto error_of = [](const auto& work) -> std::string {
    try {
      work();
    } catch (const Error& e) {
      return e.what();
    }
    return "no error";
  };
  EXPECT_NE(error_of([&] {
              (void)reader.connectivity(0, {1, 2});
            }).find("block 1, entry 3: node 99"),
            std::string::npos);
  EXPECT_EQ(error_of([&] { (void)reader.connectivity(0, {0, 2}); }), "no error");
  EXPECT_NE(error_of([&] {
              (void)reader.node_set(0, {4, 2});
            }).find("node set 5, entry 6: node 77"),
            std::string::npos);
}

// Entities are read by their id: the second of two would be the first once more.
TEST(ReadExodus, RefusesTwoBlocksWithOneId) {
  const TemporaryFolder folder;
  write_rank_file(folder.file("m"), row_of_cubes({{0x11, 0}, {0x77, 0}}, 0, 1));
  replace_everywhere(folder.file("m"), {0x11, 0x77}, {0x11, 0x11});
  const std::string text = error_of_reading(folder.file("m"));
  EXPECT_NE(text.find("two blocks have the id 17"), std::string::npos) << text;
}

}  // namespace
}  // namespace sculpt
