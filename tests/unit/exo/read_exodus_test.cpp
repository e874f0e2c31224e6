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

}  // namespace
}  // namespace sculpt
