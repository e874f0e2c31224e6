// Meshes as overlay grids through the whole program: the same bits on any number of ranks, from parts and by
// any partition, and those of the grid where the mesh is one; sets, names and blocks that are kept.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "input_meshes.hpp"
#include "same_bits.hpp"
#include "sculpt/geom/hex.hpp"

namespace sculpt::cli {
namespace {

using test::ExodusMesh;

const std::string kMesh = "input_mesh = m.g\n";
const char* const kPartitions[] = {"rcb", "rib", "hsfc", "graph"};

class InputMeshes : public SameBits {
 protected:
  void write_mesh(const ExodusMesh& m) const { test::write_exodus_mesh(path("m.g"), m); }
  void expect_equal(const RankMesh& found, const RankMesh& expected) const {
    EXPECT_TRUE(same_bits(found.x, expected.x) && same_bits(found.y, expected.y) &&
                same_bits(found.z, expected.z));
    EXPECT_TRUE(found == expected) << "blocks, connectivity or sets differ";
  }
  void expect_no_partition_matters(const std::string& deck, const RankMesh& expected, const Ranks& ranks) {
    for (const int n : ranks)
      for (const char* partition : kPartitions) {
        SCOPED_TRACE(fmt::format("{} on {} ranks", partition, n));
        expect_equal(mesh(deck + "input_mesh_partition = " + partition + "\n", n), expected);
      }
  }
  void expect_told(const std::string& words) const {
    EXPECT_NE(console().find(words), std::string::npos) << words;
  }
};

// Appendix N of the report, with fewer cells. Spheres of two materials stand for its voxels of balls.
Voxels two_balls() {
  return {13, 13, 13, [](int i, int j, int k) {
            const auto in = [&](double x, double y, double z, double r) {
              return std::hypot(i + 0.5 - x, j + 0.5 - y, k + 0.5 - z) < r;
            };
            return in(4, 5, 6, 3) || in(9, 8, 10.5, 2.5) ? 2 : 1;
          }};
}
ExodusMesh nested() {  // to the size of the voxels, 13
  ExodusMesh m = exodus_mesh("nested", {"--n", "2", "m.g"});
  for (auto* coordinates : {&m.x, &m.y, &m.z})
    for (double& x : *coordinates) x *= 0.5;
  return m;
}
const std::string kAppendixN =
    kMesh +
    "input_mesh_blocks = 2 4\nmesh_void = true\nlaplacian_iters = 2\nsmooth = 3\ncsmooth = 4\n"
    "defeature = 1\ngen_sidesets = variable\n";

TEST_F(InputMeshes, AppendixN) {
  const ExodusMesh m = nested();
  write_mesh(m);
  const std::string deck = kAppendixN + spn_deck(two_balls(), "v.spn");
  const RankMesh alone = expect_same(two_balls(), kAppendixN, {2, 3, 4, 5, 8});
  EXPECT_GT(summary(first_console(), "Min Quality"), 0.2);
  expect_no_partition_matters(deck, alone, {4});
  // From parts for 4 ranks; other numbers of ranks take the whole.
  const auto elements = static_cast<int>(m.elements());
  const std::pair<const char*, std::function<int(int)>> ways[] = {
      {"in a row", [=](int e) { return 4 * e / elements; }},
      {"scattered", [](int e) { return (e * 7 + e / 5) % 4; }},
      {"none on one rank", [=](int e) { return e < elements / 2 ? 3 : e % 2; }}};
  for (const auto& [way, rank_of] : ways) {
    SCOPED_TRACE(way);
    write_parts(path("m.g"), m, 4, rank_of);
    expect_equal(mesh(deck, 4), alone);
    expect_told("Found 'm.g' and its parts for 4 ranks: the parts are used");
  }
  std::filesystem::remove(path("m.g"));
  expect_equal(mesh(deck, 4), alone);
}

TEST_F(InputMeshes, CylinderOfGrains) {
  write_mesh(exodus_mesh("cylinder", {"--n", "4", "--layers", "8", "--grains", "6", "m.g"}));
  const RankMesh alone = expect_same(kMesh, {2, 3, 4, 5, 8});
  EXPECT_EQ(hexes_by_block(alone).size(), 6U);
  expect_no_partition_matters(kMesh, alone, {2, 5});
  write_mesh(exodus_mesh("bar", {"--nx", "8", "--ny", "5", "--nz", "4", "--grains", "5", "m.g"}));
  expect_same(kMesh + "exterior_sliding = surface\n", {3, 8});
}

TEST_F(InputMeshes, Pamgen) {
  write("c.pamgen",
        "mesh\n  radial trisection\n    trisection blocks, 4\n    numz 1\n      zblock 1 20.0 interval 8\n"
        "    numr 2\n      rblock 1 6.0 interval 3\n      rblock 2 9.0 interval 4\n    numa 1\n"
        "      ablock 1 360.0 interval 24\n  end\n  set assign\n    sideset, ihi, 1\n    nodeset, klo, 7\n"
        "  end\nend\n");
  write("s.diatom", two_spheres());
  const std::string deck =
      "input_mesh_pamgen = c.pamgen\ndiatom_file = s.diatom\nmesh_void = true\ngen_sidesets = input_mesh\n";
  const RankMesh alone = expect_same(deck, {2, 3, 4, 5, 8});
  EXPECT_EQ(hexes_by_block(alone).size(), 3U);
  EXPECT_EQ(alone.side_sets.size(), 1U);
  EXPECT_EQ(alone.node_sets.size(), 1U);
  expect_no_partition_matters(deck, alone, {3});
}

// A mesh that is a Cartesian grid gives the mesh of the grid, whatever the order of its hexes and nodes.
TEST_F(InputMeshes, CartesianMeshOfVoxels) {
  const Voxels voxels = grains(7, 6, 5);
  write("v.spn", spn_text(voxels));
  const std::string deck = spn_deck(voxels, "v.spn") + "gen_sidesets = rve\n";
  const RankMesh grid = mesh(deck, 1);
  for (const Words& order : {Words{}, Words{"--permute", "3"}}) {
    Words options{"--nx", "7", "--ny", "7", "--nz", "7", "m.g"};
    options.insert(options.end(), order.begin(), order.end());
    write_mesh(exodus_mesh("box", options));
    for (const int ranks : {1, 4}) {
      expect_equal(mesh(kMesh + deck, ranks), grid);
      expect_told("The input mesh is a Cartesian grid of 7 x 7 x 7 cells");
    }
  }
}

TEST_F(InputMeshes, CartesianMeshOfShapes) {
  write("s.diatom", two_spheres());
  const std::string grid = two_spheres_deck("s.diatom"), shapes = "diatom_file = s.diatom\n";
  for (const std::string& more :
       {std::string("mesh_void = true\n"), std::string("adapt_type = vfrac_average\nadapt_levels = 1\n")}) {
    SCOPED_TRACE(more);
    const RankMesh expected = mesh(grid + more, 1);
    for (const char* seed : {"", "4"}) {
      Words options{"--nx", "16",  "--ny", "16", "--nz", "16", "--x0", "-16", "--y0", "-16",
                    "--z0", "-16", "--lx", "32", "--ly", "32", "--lz", "32",  "m.g"};
      if (*seed != 0) options.insert(options.end(), {"--permute", seed});
      write_mesh(exodus_mesh("box", options));
      expect_equal(mesh(kMesh + shapes + more, *seed != 0 ? 3 : 1), expected);
    }
  }
}

// Faces of a side set that are plane, summed up.
double area_of(const RankMesh& m, const RankMesh::SideSet& set) {
  std::vector<std::int32_t> nodes;  // of all hexes
  for (const auto& block : m.blocks) nodes.insert(nodes.end(), block.nodes.begin(), block.nodes.end());
  double area = 0;
  for (std::size_t f = 0; f < set.element.size(); ++f) {
    std::array<Vec3, 4> p;
    for (std::size_t c = 0; c < 4; ++c) {
      const int corner = kFaces[static_cast<std::size_t>(set.side[f] - 1)][c];
      const auto n = static_cast<std::size_t>(
          nodes[8 * static_cast<std::size_t>(set.element[f] - 1) + static_cast<std::size_t>(corner)] - 1);
      p[c] = {m.x[n], m.y[n], m.z[n]};
    }
    area += 0.5 * norm(cross(p[2] - p[0], p[3] - p[1]));
  }
  return area;
}
std::set<std::int32_t> nodes_of(const RankMesh& m, const RankMesh::SideSet& set) {
  std::vector<std::int32_t> nodes;
  for (const auto& block : m.blocks) nodes.insert(nodes.end(), block.nodes.begin(), block.nodes.end());
  std::set<std::int32_t> found;
  for (std::size_t f = 0; f < set.element.size(); ++f)
    for (const int corner : kFaces[static_cast<std::size_t>(set.side[f] - 1)])
      found.insert(
          nodes[8 * static_cast<std::size_t>(set.element[f] - 1) + static_cast<std::size_t>(corner)]);
  return found;
}
// The mesh as the program would have written it.
RankMesh as_written(const ExodusMesh& mesh) {
  RankMesh m;
  m.x = mesh.x;
  m.y = mesh.y;
  m.z = mesh.z;
  for (const auto& b : mesh.blocks) {
    auto& block = m.blocks.emplace_back();
    for (const std::int64_t n : b.nodes) block.nodes.push_back(static_cast<std::int32_t>(n));
  }
  for (const auto& s : mesh.side_sets) {
    auto& set = m.side_sets.emplace_back();
    set.id = s.id;
    set.name = s.name;
    for (const std::int64_t e : s.element) set.element.push_back(static_cast<std::int32_t>(e));
    for (const std::int64_t f : s.side) set.side.push_back(static_cast<std::int32_t>(f));
  }
  return m;
}

template <class Sets>
const auto& set_of(const Sets& sets, std::int64_t id) {
  const auto found = std::find_if(sets.begin(), sets.end(), [id](const auto& s) { return s.id == id; });
  if (found == sets.end()) throw std::runtime_error(fmt::format("no set {}", id));
  return *found;
}

// A cylinder of grains with sets: bottom, top, wall, one without faces; the axis, the bottom's nodes, none.
ExodusMesh cylinder_with_sets() {
  hexmesh::Mesh made = generated("cylinder", {"--n", "4", "--layers", "8", "--grains", "6", "m.g"});
  made.side_sets.push_back({40, "nothing", {}, {}});
  hexmesh::add_node_set(made, 7, "floor", [](const Vec3& p) { return p.z == 0; });
  made.node_sets.push_back({8, "no nodes", {}});
  return exodus_mesh(made);
}

TEST_F(InputMeshes, CarriesSetsOver) {
  const ExodusMesh m = cylinder_with_sets();
  write_mesh(m);
  const RankMesh found = expect_same(kMesh + "gen_sidesets = input_mesh\n", {3, 4});
  const RankMesh before = as_written(m);
  ASSERT_EQ(found.side_sets.size(), 4U);
  for (const auto& set : before.side_sets) {
    SCOPED_TRACE(set.name);
    const auto& after = set_of(found.side_sets, set.id);
    EXPECT_EQ(after.name, set.name);
    EXPECT_GE(after.element.size(), set.element.size());
    const double area = area_of(before, set);
    EXPECT_NEAR(area_of(found, after), area, 1e-12 * area);
  }
  EXPECT_TRUE(set_of(found.side_sets, 40).element.empty());
  ASSERT_EQ(found.node_sets.size(), 3U);
  EXPECT_EQ(set_of(found.node_sets, 1).name, "axis");
  EXPECT_EQ(set_of(found.node_sets, 1).node.size(), 9U);
  const auto& floor = set_of(found.node_sets, 7);
  EXPECT_EQ(floor.name, "floor");
  EXPECT_GT(floor.node.size(), m.node_sets[1].node.size());
  EXPECT_EQ(std::set<std::int32_t>(floor.node.begin(), floor.node.end()),
            nodes_of(found, set_of(found.side_sets, 1)));
  EXPECT_EQ(set_of(found.node_sets, 8).name, "no nodes");
  EXPECT_TRUE(set_of(found.node_sets, 8).node.empty());
  EXPECT_EQ(console().find("WARNING"), std::string::npos);
}

// The void is not meshed, and faces of its hexes are lost.
TEST_F(InputMeshes, TellsOfLostFaces) {
  write_mesh(exodus_mesh("cylinder", {"--n", "4", "--layers", "8", "m.g"}));
  write("s.diatom",
        "diatom\npackage 'a'\nmaterial 1\ninsert sphere\ncenter = 0 0 0\nradius = 4\nendinsert\nendpackage\n"
        "enddiatom\n");
  const RankMesh found = expect_same(kMesh + "diatom_file = s.diatom\ngen_sidesets = input_mesh\n", {1, 4});
  EXPECT_NE(first_console().find("WARNING: "), std::string::npos);
  EXPECT_NE(first_console().find(" faces in side sets of the input mesh belong to hexes that are not meshed"),
            std::string::npos);
  EXPECT_FALSE(set_of(found.side_sets, 1).element.empty());
  EXPECT_TRUE(set_of(found.side_sets, 2).element.empty());
  EXPECT_EQ(set_of(found.side_sets, 2).name, "top");
}

TEST_F(InputMeshes, MakesSetsOfItsOwn) {
  const ExodusMesh m = cylinder_with_sets();
  write_mesh(m);
  const RankMesh before = as_written(m);
  double boundary = 0;
  for (const auto& set : before.side_sets) boundary += area_of(before, set);
  const RankMesh fixed = expect_same(kMesh + "gen_sidesets = fixed\n", {4});
  EXPECT_NEAR(area_of(fixed, set_of(fixed.side_sets, 1)), boundary, 1e-12 * boundary);
  EXPECT_TRUE(fixed.node_sets.empty());
  const RankMesh variable =
      expect_same(kMesh + "gen_sidesets = variable\nsideset_name = 1 first\nmaterial_name = 2 gold\n", {4});
  EXPECT_GT(variable.side_sets.size(), 6U);
  EXPECT_EQ(set_of(variable.side_sets, 1).name, "first");
  EXPECT_EQ(set_of(variable.blocks, 2).name, "gold");
}

TEST_F(InputMeshes, NamesOfTheDeckComeFirst) {
  write_mesh(nested());
  write("v.spn", spn_text(two_balls()));
  const RankMesh found =
      expect_same(two_balls(),
                  kMesh +
                      "input_mesh_blocks = 2 4\nmesh_void = true\ngen_sidesets = input_mesh\n"
                      "material_name = 3 pipe\nmaterial_name = 2 balls\nsideset_name = 3 outside\n",
                  {4});
  EXPECT_EQ(set_of(found.blocks, 1).name, "lower");
  EXPECT_EQ(set_of(found.blocks, 3).name, "pipe");
  EXPECT_EQ(set_of(found.blocks, 2).name, "balls");
  EXPECT_EQ(set_of(found.side_sets, 3).name, "outside");
  EXPECT_EQ(set_of(found.side_sets, 4).name, "upper_tube");
  EXPECT_EQ(set_of(found.node_sets, 2).name, "rim");
}

TEST_F(InputMeshes, KeepsBlocksAsTheyAre) {
  const ExodusMesh m = nested();
  write_mesh(m);
  write("v.spn", spn_text(two_balls()));
  const RankMesh found = mesh(kAppendixN + spn_deck(two_balls(), "v.spn"), 3);
  for (const std::int64_t id : {1, 3}) EXPECT_EQ(hexes_of_block(found, id), hexes_of_block(m, id)) << id;
  expect_told("  material 1 becomes block 4: block 1 of the input mesh keeps its id\n");
  EXPECT_EQ(hexes_by_block(found).size(), 5U);  // 1 and 3, balls, matrix, what is outside of the voxels
  std::int64_t all = 0;
  for (const auto& block : m.blocks) all += block.count();
  EXPECT_GT(hexes_of(found), all);
}

}  // namespace
}  // namespace sculpt::cli
