// Hex meshes from whole files and from parts: all ranks together hold what the file says, and fail with one
// message.
#include "sculpt/input/input_mesh.hpp"

#include <fmt/core.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <tuple>

#include "../../unit/input/input_fixture.hpp"
#include "sculpt/exo/write_rank_file.hpp"
#include "sculpt/geom/hex.hpp"
#include "sculpt/mesh/node_directory.hpp"
#include "support/exodus_mesh.hpp"

namespace sculpt {
namespace {

using test::ExodusMesh;

// A folder that rank 0 makes, and removes at the end; collective.
class SharedFolder {
 public:
  SharedFolder() {
    static int count = 0;
    const std::string name = fmt::format("sculpt_mesh_{}_{}", ::getpid(), count++);
    path_ = comm_.broadcast((std::filesystem::temp_directory_path() / name).string(), 0);
    if (comm_.rank() == 0) std::filesystem::create_directory(path_);
    comm_.barrier();
  }
  ~SharedFolder() {
    comm_.barrier();
    std::error_code ignored;
    if (comm_.rank() == 0) std::filesystem::remove_all(path_, ignored);
  }
  SharedFolder(const SharedFolder&) = delete;
  SharedFolder& operator=(const SharedFolder&) = delete;
  [[nodiscard]] std::string file(const std::string& name) const { return path_ + "/" + name; }

 private:
  Comm comm_ = Comm::world();
  std::string path_;
};

// 3 x 3 x 4 cells, slightly bent, in four blocks: of a layer each, the third without any, the ids in no
// order. Nodes are numbered with x slowest.
ExodusMesh bent_mesh() {
  const std::int64_t nx = 3, ny = 3, nz = 4;
  ExodusMesh m;
  for (std::int64_t i = 0; i <= nx; ++i)
    for (std::int64_t j = 0; j <= ny; ++j)
      for (std::int64_t k = 0; k <= nz; ++k) {
        const auto u = static_cast<double>(i), v = static_cast<double>(j), w = static_cast<double>(k);
        m.x.push_back(u + 0.1 * std::sin(v + w));
        m.y.push_back(v + 0.1 * std::sin(2 * w + u));
        m.z.push_back(w + 0.1 * std::sin(u + 3 * v) - 7);
      }
  m.blocks.resize(5);
  const std::int64_t ids[] = {20, 3, 500, 4, 1};
  for (std::size_t b = 0; b < 5; ++b) m.blocks[b].id = ids[b];
  m.blocks[1].name = std::string(255, 'n');
  m.blocks[2].type = "NULL";
  m.blocks[2].nodes_per_element = 0;
  m.blocks[4].type = "hex";
  for (std::int64_t k = 0; k < nz; ++k)
    for (std::int64_t j = 0; j < ny; ++j)
      for (std::int64_t i = 0; i < nx; ++i)
        for (const auto& [a, b, c] : kCornerOffset)
          m.blocks[static_cast<std::size_t>(k < 2 ? k : k + 1)].nodes.push_back(
              1 + (k + c) + (nz + 1) * ((j + b) + (ny + 1) * (i + a)));
  m.side_sets = {{7, "left", {}, {}}, {9, "empty", {}, {}}, {2, "mixed", {36, 1, 1, 17}, {6, 5, 1, 2}}};
  for (std::int64_t e = 1; e <= 36; e += 3) {
    m.side_sets[0].element.push_back(e);
    m.side_sets[0].side.push_back(4);
  }
  m.node_sets = {{7, "end", {80, 1, 33}}, {8, "all", {}}};
  for (std::int64_t n = 80; n >= 1; --n) m.node_sets[1].node.push_back(n);
  m.steps = 2;
  m.variables = {{"grain", {1, 1, 1, 1, 1}, {}}, {"phase", {0, 1, 0, 0, 1}, {}}};
  for (std::size_t v = 0; v < 2; ++v)
    for (int s = 0; s < 2; ++s) {
      auto& values = m.variables[v].steps.emplace_back();
      for (int e = 0; e < 36; ++e) values.push_back(1000 * (v == 0 ? 1 : 2) + 100 * s + 0.5 * e);
    }
  return m;
}

void write_whole(const std::string& path, const ExodusMesh& mesh) {
  if (Comm::world().rank() == 0) test::write_exodus_mesh(path, mesh);
  Comm::world().barrier();
}

// Elements dealt out unevenly: the last rank has none of the first two layers, and few in all.
int rank_of(int element, int ranks) {
  const int r = (element * 7 + element / 5) % ranks;
  return r == ranks - 1 && element < 18 ? 0 : r;
}

ExodusMesh my_part(const ExodusMesh& mesh) {
  const Comm comm = Comm::world();
  std::vector<int> ranks;
  for (int e = 0; e < static_cast<int>(mesh.elements()); ++e) ranks.push_back(rank_of(e, comm.size()));
  return test::part_of(mesh, ranks, comm.size(), comm.rank());
}

// Every rank writes its own part; collective.
void write_my_part(const std::string& path, const ExodusMesh& part) {
  const Comm comm = Comm::world();
  test::write_exodus_mesh(part_file_name(path, comm.size(), comm.rank()), part);
  comm.barrier();
}

struct Element {
  GlobalId number;
  std::array<GlobalId, 8> corner;
  std::int32_t block;
  std::array<double, 2> value;
  auto operator<=>(const Element&) const = default;
};
struct Node {
  GlobalId number;
  double x, y, z;
  auto operator<=>(const Node&) const = default;
};
using Side = std::array<GlobalId, 2>;

template <class T>
std::vector<T> sorted(std::vector<T> list) {
  std::sort(list.begin(), list.end());
  return list;
}
template <class T>
std::vector<T> sorted_once(std::vector<T> list) {
  list = sorted(std::move(list));
  list.erase(std::unique(list.begin(), list.end()), list.end());
  return list;
}

std::vector<Element> elements_of(const InputMesh& mesh) {
  std::vector<Element> list;
  const ElementShare& share = mesh.share;
  const auto values = static_cast<std::size_t>(share.values_per_element);
  for (std::size_t e = 0; e < share.element.size(); ++e) {
    Element& element = list.emplace_back(Element{share.element[e], share.corner[e], share.block[e], {}});
    for (std::size_t v = 0; v < values; ++v) element.value[v] = share.value[e * values + v];
  }
  return list;
}

// All ranks together against the file, entity by entity.
void expect_mesh(const InputMesh& mesh, const ExodusMesh& file, double tolerance = 0) {
  const Comm comm = Comm::world();
  const ElementShare& share = mesh.share;
  EXPECT_TRUE(std::is_sorted(share.element.begin(), share.element.end()));
  EXPECT_TRUE(std::is_sorted(share.node.begin(), share.node.end()));
  EXPECT_EQ(share.elements, 36);
  EXPECT_EQ(share.nodes, 80);
  EXPECT_EQ(share.values_per_element, 2);
  EXPECT_EQ(mesh.variables, (std::vector<std::string>{"grain", "phase"}));

  std::vector<Element> elements;
  for (std::size_t b = 0; b < file.blocks.size(); ++b) {
    EXPECT_EQ(mesh.blocks[b], (InputMesh::Block{file.blocks[b].id, file.blocks[b].name}));
    for (std::int64_t e = 0; e < file.blocks[b].count(); ++e) {
      const std::size_t number = elements.size();
      Element& element =
          elements.emplace_back(Element{static_cast<GlobalId>(number), {}, static_cast<std::int32_t>(b), {}});
      for (std::size_t c = 0; c < 8; ++c)
        element.corner[c] = file.blocks[b].nodes[static_cast<std::size_t>(8 * e) + c] - 1;
      for (std::size_t v = 0; v < 2; ++v)
        if (file.variables[v].in_block[b] != 0) element.value[v] = file.variables[v].steps.back()[number];
    }
  }
  EXPECT_EQ(sorted(comm.concatenate(elements_of(mesh))), elements);

  std::vector<Node> mine;
  for (std::size_t n = 0; n < share.node.size(); ++n) {
    const Vec3& p = share.position[n];
    mine.push_back({share.node[n], p.x, p.y, p.z});
  }
  const std::vector<Node> nodes = sorted_once(comm.concatenate(mine));
  ASSERT_EQ(nodes.size(), file.x.size());
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    EXPECT_EQ(nodes[n].number, static_cast<GlobalId>(n));
    EXPECT_NEAR(nodes[n].x, file.x[n], tolerance);
    EXPECT_NEAR(nodes[n].y, file.y[n], tolerance);
    EXPECT_NEAR(nodes[n].z, file.z[n], tolerance);
  }

  ASSERT_EQ(mesh.side_sets.size(), file.side_sets.size());
  for (std::size_t s = 0; s < mesh.side_sets.size(); ++s) {
    EXPECT_EQ(mesh.side_sets[s].id, file.side_sets[s].id);
    EXPECT_EQ(mesh.side_sets[s].name, file.side_sets[s].name);
    std::vector<Side> sides, expected;
    for (std::size_t n = 0; n < mesh.side_sets[s].element.size(); ++n)
      sides.push_back({mesh.side_sets[s].element[n], mesh.side_sets[s].face[n]});
    for (std::size_t n = 0; n < file.side_sets[s].element.size(); ++n)
      expected.push_back({file.side_sets[s].element[n] - 1, file.side_sets[s].side[n] - 1});
    EXPECT_EQ(sorted(comm.concatenate(sides)), sorted(expected));
  }
  ASSERT_EQ(mesh.node_sets.size(), file.node_sets.size());
  for (std::size_t s = 0; s < mesh.node_sets.size(); ++s) {
    EXPECT_EQ(mesh.node_sets[s].id, file.node_sets[s].id);
    EXPECT_EQ(mesh.node_sets[s].name, file.node_sets[s].name);
    std::vector<GlobalId> expected = file.node_sets[s].node;
    for (GlobalId& n : expected) --n;
    EXPECT_EQ(sorted_once(comm.concatenate(mesh.node_sets[s].node)), sorted(expected));
  }
}

testing::AssertionResult says(const std::string& text, const std::string& part) {
  if (contains(text, part)) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "'" << part << "' is not part of '" << text << "'";
}

InputMesh read(const std::string& path) { return read_input_mesh(Comm::world(), path, Log()); }

TEST(InputMesh, OfAWholeFile) {
  const SharedFolder folder;
  const std::string path = folder.file("mesh.g");
  ExodusMesh mesh = bent_mesh();
  mesh.node_map.resize(80);  // ids of its own: numbers are positions all the same
  mesh.element_map.resize(36);
  for (std::size_t n = 0; n < 80; ++n) mesh.node_map[n] = 5000 - static_cast<std::int64_t>(n);
  for (std::size_t e = 0; e < 36; ++e) mesh.element_map[e] = 1000 + static_cast<std::int64_t>(2 * e);
  write_whole(path, mesh);
  const InputMesh found = read(path);
  EXPECT_FALSE(found.decomposed);
  expect_mesh(found, mesh);
  const Comm comm = Comm::world();
  EXPECT_EQ(found.share.element.size(),
            static_cast<std::size_t>(36 * (comm.rank() + 1) / comm.size() - 36 * comm.rank() / comm.size()));
}

TEST(InputMesh, OfParts) {
  const SharedFolder folder;
  const std::string path = folder.file("mesh.g");
  const ExodusMesh mesh = bent_mesh();
  write_my_part(path, my_part(mesh));
  const InputMesh found = read(path);
  EXPECT_EQ(found.decomposed, Comm::world().size() > 1);
  if (Comm::world().size() > 1) expect_mesh(found, mesh);
}

TEST(InputMesh, OfFilesOfAllFormats) {
  const SharedFolder folder;
  int number = 0;
  for (const int mode : {EX_LARGE_MODEL, EX_NETCDF4, EX_ALL_INT64_DB | EX_NETCDF4})
    for (const int word : {8, 4}) {
      ExodusMesh mesh = bent_mesh();
      mesh.mode = mode;
      mesh.word = word;
      const double tolerance = word == 8 ? 0 : 1e-6;
      const std::string path = folder.file(fmt::format("mesh{}", number++));
      write_whole(path, mesh);
      expect_mesh(read(path), mesh, tolerance);
      if (Comm::world().size() == 1) continue;
      write_my_part(path, my_part(mesh));
      const InputMesh found = read(path);
      EXPECT_TRUE(found.decomposed);
      expect_mesh(found, mesh, tolerance);
    }
}

TEST(InputMesh, OfASolePart) {
  if (Comm::world().size() > 1) return;
  const SharedFolder folder;
  const ExodusMesh mesh = bent_mesh();
  write_whole(folder.file("mesh.g.1.0"), mesh);
  const InputMesh found = read(folder.file("mesh.g"));
  EXPECT_FALSE(found.decomposed);
  expect_mesh(found, mesh);
}

TEST(InputMesh, WithFewerElementsThanRanksAndNothingElse) {
  const SharedFolder folder;
  ExodusMesh mesh;
  mesh.x = {0, 1, 1, 0, 0, 1, 1, 0};
  mesh.y = {0, 0, 1, 1, 0, 0, 1, 1};
  mesh.z = {0, 0, 0, 0, 1, 1, 1, 1};
  mesh.blocks = {{6, "", {1, 2, 3, 4, 5, 6, 7, 8}}};
  mesh.variables = {{"unused", {1}, {}}};  // no step: no values
  write_whole(folder.file("cube"), mesh);
  const InputMesh found = read(folder.file("cube"));
  const Comm comm = Comm::world();
  EXPECT_EQ(comm.sum(static_cast<std::int64_t>(found.share.element.size())), 1);
  EXPECT_EQ(comm.sum(static_cast<std::int64_t>(found.share.node.size())), 8);
  EXPECT_TRUE(found.variables.empty());
  EXPECT_TRUE(found.share.value.empty());
}

TEST(PositionsOf, NodesInAnyOrder) {
  const SharedFolder folder;
  const ExodusMesh mesh = bent_mesh();
  write_whole(folder.file("mesh.g"), mesh);
  const InputMesh found = read(folder.file("mesh.g"));
  std::vector<GlobalId> nodes;
  for (GlobalId n = 0; n < 40; ++n) nodes.push_back((n * 37 + Comm::world().rank()) % 80);
  nodes.push_back(nodes.front());
  if (Comm::world().rank() == 1) nodes.clear();
  const std::vector<Vec3> positions = positions_of(Comm::world(), found.share, nodes);
  ASSERT_EQ(positions.size(), nodes.size());
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const auto at = static_cast<std::size_t>(nodes[n]);
    EXPECT_EQ(positions[n], (Vec3{mesh.x[at], mesh.y[at], mesh.z[at]}));
  }
}

TEST(PositionsOf, NamesTheFirstNodeThatNobodyHolds) {
  const Comm comm = Comm::world();
  ElementShare share;
  share.nodes = 10;
  for (GlobalId n = 0; n < 10; ++n)
    if (n != 4 && n != 8) {
      share.node.push_back(n);
      share.position.push_back({1.0 * static_cast<double>(n), 0, 0});
    }
  const std::vector<GlobalId> unknown{9, 8, 4}, known{9, 0, 9};
  EXPECT_EQ(positions_of(comm, share, known)[2], (Vec3{9, 0, 0}));
  const std::string error = error_of([&] { (void)positions_of(comm, share, unknown); });
  EXPECT_TRUE(says(error, "node 5 has no position: it is used, but no rank holds it"));
}

// The error of reading, the same on all ranks.
std::string agreed(const std::string& path) {
  const std::string mine = error_of([&] { (void)read(path); });
  EXPECT_EQ(Comm::world().broadcast(mine, 0), mine);
  return mine;
}
// Of a whole file: the same on one rank and on all.
std::string error_of_whole(const ExodusMesh& mesh) {
  const SharedFolder folder;
  const std::string path = folder.file("bad.g");
  write_whole(path, mesh);
  const std::string together = agreed(path);
  EXPECT_EQ(error_of([&] { (void)read_input_mesh(Comm::self(), path, Log()); }), together);
  return together;
}

TEST(RefusesInputMesh, OfOtherElements) {
  ExodusMesh mesh = bent_mesh();
  mesh.blocks[3].type = "WEDGE";
  EXPECT_TRUE(says(error_of_whole(mesh),
                   "bad.g', block 4, element 19: found WEDGE with 8 nodes, expected HEX8 with 8 nodes"));
  mesh = bent_mesh();
  mesh.blocks[4] = {1, "", ExodusMesh::Ints(20, 1), "HEX20", 20};
  mesh.side_sets.clear();
  mesh.variables.clear();
  EXPECT_TRUE(says(error_of_whole(mesh),
                   "block 1, element 28: found HEX20 with 20 nodes, expected HEX8 with 8 nodes"));
}

TEST(RefusesInputMesh, WithoutElements) {
  ExodusMesh mesh;
  mesh.x = mesh.y = mesh.z = {0, 1};
  EXPECT_TRUE(says(error_of_whole(mesh), "bad.g' has no elements"));
}

TEST(RefusesInputMesh, WithANodeThatDoesNotExist) {
  ExodusMesh mesh = bent_mesh();
  mesh.blocks[1].nodes[9] = 81;
  mesh.blocks[4].nodes[71] = 0;
  EXPECT_TRUE(says(error_of_whole(mesh), "block 3, entry 2: node 81 does not exist, expected 1 to 80"));
}

TEST(RefusesInputMesh, WithANodeAtTwoCorners) {
  ExodusMesh mesh = bent_mesh();
  mesh.blocks[4].nodes[3] = mesh.blocks[4].nodes[0];
  mesh.blocks[1].nodes[8 * 4 + 7] = mesh.blocks[1].nodes[8 * 4 + 2];
  EXPECT_TRUE(
      contains(error_of_whole(mesh),
               fmt::format("element 14 of block 3 has node {} at two corners, expected eight different",
                           mesh.blocks[1].nodes[8 * 4 + 2])));
}

TEST(RefusesInputMesh, WithANodeAtNoPlace) {
  ExodusMesh mesh = bent_mesh();
  mesh.y[77] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(says(error_of_whole(mesh), "node 78 is at ("));
  mesh.x[50] = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(says(error_of_whole(mesh), "node 51 is at (inf, "));
}

TEST(RefusesInputMesh, WithBadHexes) {
  ExodusMesh mesh = bent_mesh();
  for (const std::size_t hex : {0U, 8U}) {  // of the last block
    auto& nodes = mesh.blocks[4].nodes;
    for (std::size_t c = 0; c < 4; ++c) std::swap(nodes[8 * hex + c], nodes[8 * hex + c + 4]);
  }
  const std::string inverted = error_of_whole(mesh);
  EXPECT_TRUE(says(inverted, "2 inverted or degenerate hexes, the first: element 28 of block 1 at ("));
  EXPECT_TRUE(says(inverted, ") has a corner with the determinant -"));
  mesh = bent_mesh();
  const auto at = static_cast<std::size_t>(mesh.blocks[1].nodes[0] - 1);  // shared by hexes of two blocks
  const auto to = static_cast<std::size_t>(mesh.blocks[1].nodes[6] - 1);
  mesh.x[at] = mesh.x[to];
  mesh.y[at] = mesh.y[to];
  mesh.z[at] = mesh.z[to];
  EXPECT_TRUE(says(error_of_whole(mesh), "inverted or degenerate hexes, the first: element "));
}

TEST(RefusesInputMesh, WithBadSets) {
  ExodusMesh mesh = bent_mesh();
  mesh.side_sets[0].element[10] = 37;
  mesh.side_sets[2].side[0] = 7;
  EXPECT_TRUE(
      contains(error_of_whole(mesh), "side set 7, entry 11: element 37 does not exist, expected 1 to 36"));
  mesh = bent_mesh();
  mesh.side_sets[2].side[0] = 7;
  mesh.side_sets[2].element[3] = 99;
  EXPECT_TRUE(says(error_of_whole(mesh), "side set 2, entry 1: side 7 does not exist, expected 1 to 6"));
  mesh = bent_mesh();
  mesh.node_sets[1].node[70] = 81;
  EXPECT_TRUE(
      contains(error_of_whole(mesh), "node set 8, entry 71: node 81 does not exist, expected 1 to 80"));
}

TEST(RefusesInputMesh, CutShort) {
  const SharedFolder folder;
  const std::string path = folder.file("cut.g");
  write_whole(path, bent_mesh());
  if (Comm::world().rank() == 0) std::filesystem::resize_file(path, std::filesystem::file_size(path) - 100);
  Comm::world().barrier();
  EXPECT_TRUE(says(agreed(path), "cut.g' is cut short"));
}

TEST(RefusesInputMesh, ThatIsMissing) {
  const SharedFolder folder;
  const std::string path = folder.file("gone.g");
  const int ranks = Comm::world().size();
  const std::string error = agreed(path);
  EXPECT_TRUE(says(error, "cannot open '" + path + "': No such file or directory, and no parts of it"));
  if (ranks > 1) EXPECT_TRUE(says(error, fmt::format("decomp -p {} {}", ranks, path)));
  if (Comm::world().rank() == 0)
    for (const char* part : {".5.0", ".12.00", ".12.03", ".12.3", ".5.x", ".nem"}) std::ofstream(path + part);
  Comm::world().barrier();
  EXPECT_TRUE(says(agreed(path), "gone.g' does not exist; found parts of it for this many ranks: 5, 12"));
}

TEST(RefusesInputMesh, OfWhichAPartIsMissing) {
  const Comm comm = Comm::world();
  if (comm.size() == 1) return;
  const SharedFolder folder;
  const std::string path = folder.file("mesh.g");
  write_whole(path, bent_mesh());  // it does not help: someone meant to use the parts
  if (comm.rank() != comm.size() - 1)
    test::write_exodus_mesh(part_file_name(path, comm.size(), comm.rank()), my_part(bent_mesh()));
  comm.barrier();
  const std::string last = part_file_name(path, comm.size(), comm.size() - 1);
  EXPECT_TRUE(
      contains(agreed(path), fmt::format("found {} of the {} parts of '{}' for {} ranks: '{}' is missing",
                                         comm.size() - 1, comm.size(), path, comm.size(), last)));
  EXPECT_TRUE(says(agreed(path), fmt::format("made by: decomp -p {} {}", comm.size(), path)));
}

TEST(RefusesInputMesh, WhoseFileIsAPart) {
  const SharedFolder folder;
  ExodusMesh mesh = bent_mesh();
  mesh.tables = true;
  mesh.ranks = 4;
  mesh.global_nodes = 1000;
  mesh.global_elements = 500;
  const std::string path = folder.file("mesh.g.4.0");
  write_whole(path, mesh);
  EXPECT_TRUE(says(agreed(path), "mesh.g.4.0' is one of 4 parts of a mesh; expected the whole mesh"));
}

// What reading says when the last rank's part is changed.
std::string error_of_parts(const std::function<void(ExodusMesh&)>& change) {
  const Comm comm = Comm::world();
  const SharedFolder folder;
  ExodusMesh part = my_part(bent_mesh());
  if (comm.rank() == comm.size() - 1) change(part);
  write_my_part(folder.file("mesh.g"), part);
  return agreed(folder.file("mesh.g"));
}

TEST(RefusesInputMesh, WhosePartsDoNotFit) {
  const Comm comm = Comm::world();
  if (comm.size() == 1) return;
  const int last = comm.size() - 1;
  const std::string name = part_file_name("mesh.g", comm.size(), last);
  EXPECT_EQ(error_of_parts([](ExodusMesh&) {}), "");
  EXPECT_TRUE(says(error_of_parts([](ExodusMesh& m) { m.tables = false; }),
                   name + "' does not say of what mesh it is a part (no Nemesis data); expected one of"));
  EXPECT_TRUE(
      says(error_of_parts([](ExodusMesh& m) { m.ranks = 12; }), name + "' says that it is one of 12 parts"));
  EXPECT_TRUE(says(error_of_parts([](ExodusMesh& m) { m.kind = 's'; }), "is a file of type 's'"));
  EXPECT_TRUE(says(error_of_parts([](ExodusMesh& m) { m.global_elements = 37; }),
                   "80 nodes and 37 elements in all, but the first part has 80 nodes and 36 elements"));
  EXPECT_TRUE(says(error_of_parts([](ExodusMesh& m) { m.blocks[2].id = 77; }),
                   "has blocks: 20 3 77 4 1, but the first part has blocks: 20 3 500 4 1"));
  EXPECT_TRUE(
      contains(error_of_parts([](ExodusMesh& m) { m.side_sets[0].id = 70; }), "has side sets: 70 9 2"));
  EXPECT_TRUE(says(error_of_parts([](ExodusMesh& m) { m.variables[0].name = "grey"; }),
                   "has element variables: grey phase, but the first part has element variables: grain"));
  EXPECT_TRUE(says(error_of_parts([](ExodusMesh& m) { m.steps = 1; }), "has 1 time steps, but"));
  EXPECT_TRUE(says(error_of_parts([](ExodusMesh& m) { m.element_map[0] = 37; }),
                   "its map of element numbers names 37, expected 1 to 36, the positions in the"));
  EXPECT_TRUE(says(error_of_parts([](ExodusMesh& m) { m.node_map[3] = 0; }),
                   "its map of node numbers names 0, expected 1 to 80"));
  EXPECT_TRUE(
      contains(error_of_parts([](ExodusMesh& m) { m.node_map[3] = m.node_map[0]; }), " twice, expected"));
  EXPECT_TRUE(says(error_of_parts([](ExodusMesh& m) {
                     m = my_part(bent_mesh());
                     m.element_map[0] = 1;
                   }),
                   fmt::format("element 1 is in the parts of rank 0 and rank {} of", last)));
  EXPECT_TRUE(
      says(error_of_parts([](ExodusMesh& m) { m.blocks.back().type = "TETRA8"; }), ", block 1, element "));
  EXPECT_TRUE(says(error_of_parts([](ExodusMesh& m) { m.z[0] -= 0.001; }), "expected one place"));
}

TEST(RefusesInputMesh, WhosePartsLackAnElement) {
  const Comm comm = Comm::world();
  if (comm.size() == 1) return;
  const SharedFolder folder;
  std::vector<int> ranks;
  for (int e = 0; e < 36; ++e) ranks.push_back(e == 22 ? -1 : rank_of(e, comm.size()));
  write_my_part(folder.file("mesh.g"), test::part_of(bent_mesh(), ranks, comm.size(), comm.rank()));
  EXPECT_TRUE(says(agreed(folder.file("mesh.g")), "element 23 of 36 is in none of the parts"));
}

TEST(RefusesInputMesh, WhosePartsHaveBadHexes) {
  const SharedFolder folder;
  ExodusMesh mesh = bent_mesh();
  for (const std::size_t hex : {3U, 8U})
    for (std::size_t c = 0; c < 4; ++c)
      std::swap(mesh.blocks[1].nodes[8 * hex + c], mesh.blocks[1].nodes[8 * hex + c + 4]);
  write_whole(folder.file("mesh.g"), mesh);
  const std::string whole = agreed(folder.file("mesh.g"));
  EXPECT_TRUE(says(whole, "2 inverted or degenerate hexes, the first: element 13 of block 3 at ("));
  write_my_part(folder.file("mesh.g"), my_part(mesh));
  EXPECT_EQ(agreed(folder.file("mesh.g")), whole);
}

}  // namespace
}  // namespace sculpt
