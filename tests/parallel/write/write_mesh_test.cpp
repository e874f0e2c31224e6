// What the rank files say together: every hex and node once, tables between ranks that fit, the same joined
// file for any number of ranks.
#include "sculpt/write/write_mesh.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "sculpt/exo/merge_files.hpp"
#include "sculpt/exo/read_exodus.hpp"
#include "sculpt/exo/write_rank_file.hpp"
#include "sculpt/write/quality_file.hpp"
#include "support/stages.hpp"

namespace sculpt::test {
namespace {

namespace fs = std::filesystem;

// A folder that all ranks know and rank 0 makes and removes; collective.
class SharedFolder {
 public:
  SharedFolder() : comm_(Comm::world()) {
    std::string name = (fs::temp_directory_path() / "sculpt-write-XXXXXX").string();
    if (comm_.rank() == 0 && ::mkdtemp(name.data()) == nullptr) name.clear();
    path_ = comm_.broadcast(name, 0);
  }
  ~SharedFolder() {
    comm_.barrier();
    std::error_code ignored;
    if (comm_.rank() == 0) fs::remove_all(path_, ignored);
  }
  SharedFolder(const SharedFolder&) = delete;
  SharedFolder& operator=(const SharedFolder&) = delete;
  [[nodiscard]] std::string file(const std::string& name) const { return path_ + "/" + name; }
  [[nodiscard]] std::set<std::string> files() const {
    comm_.barrier();
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(path_)) names.insert(entry.path().filename().string());
    comm_.barrier();
    return names;
  }

 private:
  Comm comm_;
  std::string path_;
};

const Case& three_grains() {
  static const Case input = grains({6, 5, 4}, 6, 3, 3);
  return input;
}

WriteOptions options_for(const std::string& base) {
  WriteOptions w;
  w.base = base;
  w.block_id = {0, 7, 12};
  w.block_names[12] = "matrix";
  return w;
}

// The faces of owned hexes on the sides of the box: set 10 + number of the side.
std::vector<SideFace> box_faces(const HexMesh& mesh) {
  std::vector<SideFace> faces;
  for (LocalId h = 0; h < mesh.size(); ++h)
    for (std::int32_t f = 0; f < 6 && mesh.layer[static_cast<std::size_t>(h)] == 0; ++f)
      for (unsigned side = 0; side < 6; ++side)
        if (face_sides(mesh, h, f) >> side & 1U) faces.push_back({10 + side, h, f});
  return faces;
}

std::vector<RankMesh> all_files(const Comm& comm, const std::string& base) {
  comm.barrier();
  std::vector<RankMesh> files;
  for (int r = 0; r < comm.size(); ++r) files.push_back(read_exodus(rank_file_name(base, comm.size(), r)));
  return files;
}

struct Written {
  HexMesh mesh;
  WriteSummary summary;
  std::vector<RankMesh> files;  // read back, of all ranks
};

Written written(const SharedFolder& folder) {
  const Comm comm = Comm::world();
  Written w{run_stages(comm, three_grains()).mesh, {}, {}};
  w.summary = write_mesh(comm, w.mesh, box_faces(w.mesh), options_for(folder.file("grains")));
  w.files = all_files(comm, folder.file("grains"));
  return w;
}

TEST(WriteMesh, LeavesOneFilePerRankAndNothingElse) {
  const SharedFolder folder;
  const Written w = written(folder);
  std::set<std::string> expected;
  for (int r = 0; r < Comm::world().size(); ++r)
    expected.insert(fs::path(rank_file_name("grains", Comm::world().size(), r)).filename().string());
  EXPECT_EQ(folder.files(), expected);
}

TEST(WriteMesh, NumbersHexesAndNodesFromOneWithoutGaps) {
  const SharedFolder folder;
  const Written w = written(folder);
  std::vector<std::int64_t> hexes;
  std::map<std::int64_t, Vec3> nodes;
  for (const RankMesh& file : w.files) {
    hexes.insert(hexes.end(), file.hex_id.begin(), file.hex_id.end());
    for (std::size_t n = 0; n < file.node_id.size(); ++n) {
      const Vec3 p{file.x[n], file.y[n], file.z[n]};
      EXPECT_EQ(nodes.try_emplace(file.node_id[n], p).first->second, p) << "one node in two places";
    }
    EXPECT_EQ(file.global_hexes, w.summary.hexes);
    EXPECT_EQ(file.global_nodes, w.summary.nodes);
  }
  std::sort(hexes.begin(), hexes.end());
  ASSERT_EQ(static_cast<std::int64_t>(hexes.size()), w.summary.hexes);
  for (std::size_t h = 0; h < hexes.size(); ++h) ASSERT_EQ(hexes[h], static_cast<std::int64_t>(h) + 1);
  EXPECT_EQ(static_cast<std::int64_t>(nodes.size()), w.summary.nodes);
  EXPECT_EQ(nodes.begin()->first, 1);
  EXPECT_EQ(nodes.rbegin()->first, w.summary.nodes);
}

TEST(WriteMesh, GivesEveryRankTheSameBlocksAndSets) {
  const SharedFolder folder;
  const Written w = written(folder);
  EXPECT_EQ(w.summary.blocks, 3U);
  EXPECT_EQ(w.summary.side_sets, 6U);
  for (const RankMesh& file : w.files) {
    ASSERT_EQ(file.blocks.size(), 3U);
    ASSERT_EQ(file.side_sets.size(), 6U);
    for (std::size_t b = 0; b < 3; ++b) {
      EXPECT_EQ(file.blocks[b].id, options_for("").block_id[b]);
      EXPECT_EQ(file.blocks[b].global_count, w.files[0].blocks[b].global_count);
    }
    EXPECT_EQ(file.blocks[2].name, "matrix");
    for (std::size_t s = 0; s < 6; ++s) EXPECT_EQ(file.side_sets[s].id, static_cast<std::int64_t>(10 + s));
  }
  for (std::size_t s = 0; s < 6; ++s) {
    std::size_t count = 0;
    for (const RankMesh& file : w.files) count += file.side_sets[s].element.size();
    EXPECT_EQ(static_cast<std::int64_t>(count), w.files[0].side_sets[s].global_count);
  }
}

// Both ranks of a pair list the same shared nodes in the same order, and the same faces.
TEST(WriteMesh, MapsBetweenRanksFit) {
  const SharedFolder folder;
  const Written w = written(folder);
  std::map<std::pair<int, int>, std::vector<std::int64_t>> nodes;
  std::map<std::pair<int, int>, std::set<std::set<std::int64_t>>> faces;
  for (int r = 0; r < static_cast<int>(w.files.size()); ++r) {
    const RankMesh& file = w.files[static_cast<std::size_t>(r)];
    std::vector<std::int32_t> connectivity;
    for (const auto& block : file.blocks)
      connectivity.insert(connectivity.end(), block.nodes.begin(), block.nodes.end());
    for (const auto& map : file.node_maps)
      for (const std::int32_t n : map.nodes) {
        nodes[{r, map.rank}].push_back(file.node_id[static_cast<std::size_t>(n) - 1]);
        EXPECT_GT(n, file.internal_nodes);
      }
    for (const auto& map : file.element_maps)
      for (std::size_t i = 0; i < map.element.size(); ++i) {
        std::set<std::int64_t> face;
        for (const int c : kFaces[static_cast<std::size_t>(map.side[i] - 1)]) {
          const std::size_t at =
              8 * static_cast<std::size_t>(map.element[i] - 1) + static_cast<std::size_t>(c);
          face.insert(file.node_id[static_cast<std::size_t>(connectivity[at]) - 1]);
        }
        EXPECT_TRUE((faces[{r, map.rank}].insert(face).second));
      }
    if (w.files.size() > 1)
      EXPECT_EQ(file.internal_nodes + file.border_nodes, static_cast<std::int32_t>(file.node_id.size()));
  }
  for (const auto& [pair, list] : nodes) {
    EXPECT_EQ(list, (nodes[{pair.second, pair.first}])) << pair.first << " and " << pair.second;
    EXPECT_TRUE(std::is_sorted(list.begin(), list.end()));
  }
  for (const auto& [pair, set] : faces)
    EXPECT_EQ(set, (faces[{pair.second, pair.first}])) << pair.first << " and " << pair.second;
  // Any two files that have a node in common say so.
  for (std::size_t a = 0; a < w.files.size(); ++a)
    for (std::size_t b = a + 1; b < w.files.size(); ++b) {
      std::vector<std::int64_t> ia = w.files[a].node_id, ib = w.files[b].node_id, common;
      std::sort(ia.begin(), ia.end());
      std::sort(ib.begin(), ib.end());
      std::set_intersection(ia.begin(), ia.end(), ib.begin(), ib.end(), std::back_inserter(common));
      EXPECT_EQ(common, (nodes[{static_cast<int>(a), static_cast<int>(b)}]));
    }
}

TEST(WriteMesh, JoinsToTheFileOfOneRank) {
  const SharedFolder folder;
  const Comm comm = Comm::world();
  (void)written(folder);
  comm.barrier();
  if (comm.rank() == 0) {  // the same alone, written by rank 0
    const HexMesh alone = run_stages(Comm::self(), three_grains()).mesh;
    (void)write_mesh(Comm::self(), alone, box_faces(alone), options_for(folder.file("alone")));
    const MergeOptions together_out{
        .extension = "e", .output_extension = "", .output = folder.file("together.exo")};
    (void)merge_files(folder.file("grains"), comm.size(), together_out);
    const MergeOptions alone_out{
        .extension = "e", .output_extension = "", .output = folder.file("alone.exo")};
    (void)merge_files(folder.file("alone"), 1, alone_out);
    const RankMesh a = read_exodus(folder.file("together.exo")), b = read_exodus(folder.file("alone.exo"));
    EXPECT_TRUE(a == b);
    EXPECT_EQ(a.x, b.x);
    EXPECT_EQ(a.hex_id, b.hex_id);
    EXPECT_EQ(a.blocks, b.blocks);
    EXPECT_EQ(a.side_sets, b.side_sets);
  }
  comm.barrier();
}

TEST(WriteMesh, WritesAVariableOfEveryHex) {
  const SharedFolder folder;
  const Comm comm = Comm::world();
  const HexMesh mesh = run_stages(comm, three_grains()).mesh;
  WriteOptions options = options_for(folder.file("v"));
  const auto key = [&mesh](LocalId h) { return static_cast<double>(mesh.hex_id[at(h)]); };
  options.variables = {{"key", key}, {"twice", [&key](LocalId h) { return 2 * key(h); }}};
  (void)write_mesh(comm, mesh, {}, options);
  std::map<std::int64_t, double> by_element;
  for (const RankMesh& file : all_files(comm, folder.file("v"))) {
    EXPECT_EQ(file.times, std::vector<double>{0});
    ASSERT_EQ(file.element_variables.size(), 2U);
    EXPECT_EQ(file.element_variables[1].name, "twice");
    ASSERT_EQ(file.element_values.size(), 2U);
    for (std::size_t e = 0; e < file.hex_id.size(); ++e) {
      by_element[file.hex_id[e]] = file.element_values[0][e];
      EXPECT_EQ(file.element_values[1][e], 2 * file.element_values[0][e]);
    }
  }
  // Elements are numbered block by block, in each ascending in key: the values of a block ascend.
  std::set<double> distinct;
  int falls = 0;
  for (auto it = by_element.begin(); it != by_element.end(); ++it) {
    distinct.insert(it->second);
    if (it != by_element.begin()) falls += std::prev(it)->second > it->second;
  }
  EXPECT_EQ(distinct.size(), by_element.size());
  EXPECT_LE(falls, 2) << "three blocks";
}

TEST(WriteMesh, RanksWithoutHexesWriteTheirFileAsWell) {
  const SharedFolder folder;
  const Comm comm = Comm::world();
  const HexMesh mesh = overlay(comm, voxels({1, 1, 1}, {0})).cells;
  const WriteSummary summary = write_mesh(comm, mesh, {}, options_for(folder.file("one")));
  EXPECT_EQ(summary.hexes, 1);
  EXPECT_EQ(summary.nodes, 8);
  EXPECT_EQ(summary.blocks, 1U);
  const auto files = all_files(comm, folder.file("one"));
  for (std::size_t r = 0; r < files.size(); ++r) EXPECT_EQ(files[r].hex_id.size(), r == 0 ? 1U : 0U);
}

TEST(WriteMesh, LeavesNothingBehindWhenOneRankCannotWrite) {
  const SharedFolder folder;
  const Comm comm = Comm::world();
  const HexMesh mesh = overlay(comm, voxels({4, 4, 4}, std::vector<std::int32_t>(64, 0))).cells;
  WriteOptions options = options_for(folder.file("mesh"));
  if (comm.rank() == comm.size() - 1) options.base = folder.file("no/such/folder/mesh");
  EXPECT_THROW((void)write_mesh(comm, mesh, {}, options), AgreedError);
  EXPECT_EQ(folder.files(), std::set<std::string>{});
}

TEST(WriteQualityFile, IsCompleteOrNotThere) {
  const SharedFolder folder;
  const Comm comm = Comm::world();
  write_quality_file(comm, {}, "mesh", folder.file("q.json"));
  write_quality_file(comm, {}, "mesh", folder.file("q.csv"));
  EXPECT_EQ(folder.files(), (std::set<std::string>{"q.csv", "q.json"}));
  if (comm.rank() == 0) fs::create_directory(folder.file("taken"));
  EXPECT_THROW(write_quality_file(comm, {}, "mesh", folder.file("taken")), AgreedError);
  EXPECT_THROW(write_quality_file(comm, {}, "mesh", folder.file("absent/q.csv")), AgreedError);
  EXPECT_EQ(folder.files(), (std::set<std::string>{"q.csv", "q.json", "taken"}));
  EXPECT_EQ(fs::file_size(folder.file("q.json")), quality_json({}, "mesh").size());
}

TEST(CheckOutputFolder, SaysBeforeTheWorkWhatWouldFailAfterIt) {
  const SharedFolder folder;
  const Comm comm = Comm::world();
  EXPECT_NO_THROW(check_output_folder(comm, "exodus_file", folder.file("mesh")));
  EXPECT_EQ(folder.files(), std::set<std::string>{});
  try {
    check_output_folder(comm, "exodus_file", folder.file("absent/mesh"));
    ADD_FAILURE() << "nothing was thrown";
  } catch (const AgreedError& e) {
    EXPECT_NE(std::string(e.what()).find("absent does not exist"), std::string::npos) << e.what();
  }
  const std::string taken = rank_file_name(folder.file("taken"), comm.size(), comm.size() - 1);
  if (comm.rank() == 0) fs::create_directory(taken);  // the name of the last rank's file is a folder
  comm.barrier();
  EXPECT_THROW(check_output_folder(comm, "exodus_file", folder.file("taken")), AgreedError);
}

}  // namespace
}  // namespace sculpt::test
