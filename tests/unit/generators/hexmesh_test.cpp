// Every kind of mesh of the generator: conforming, right-handed, of the right volume, with its sets.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numeric>
#include <set>

#include "kinds.hpp"
#include "sculpt/exo/read_exodus.hpp"
#include "turn.hpp"

namespace hexmesh {
namespace {

constexpr double kPi = 3.14159265358979323846;

Mesh made(const std::string& kind, std::vector<std::string> words = {}) {
  Options options(std::move(words));
  return make_mesh(kind_named(kind), options);
}

double volume(const Mesh& mesh, std::int32_t block = -1) {
  double sum = 0;
  for (std::size_t h = 0; h < mesh.hex.size(); ++h)
    if (block < 0 || mesh.block[h] == block) sum += sculpt::hex_volume(mesh.corners(h));
  return sum;
}

double least_scaled_jacobian(const Mesh& mesh) {
  double least = 1;
  for (std::size_t h = 0; h < mesh.hex.size(); ++h)
    least = std::min(least, sculpt::scaled_jacobian(mesh.corners(h)));
  return least;
}

// Faces by their nodes: seen at most twice, from opposite sides; no node unused, no two at one place; the
// blocks one after another.
void expect_conforming(const Mesh& mesh) {
  std::map<std::set<std::int32_t>, std::vector<std::pair<std::size_t, std::size_t>>> faces;
  std::vector<bool> used(mesh.node.size(), false);
  for (std::size_t h = 0; h < mesh.hex.size(); ++h)
    for (std::size_t f = 0; f < 6; ++f) {
      std::set<std::int32_t> nodes;
      for (const int c : sculpt::kFaces[f]) nodes.insert(mesh.hex[h][static_cast<std::size_t>(c)]);
      ASSERT_EQ(nodes.size(), 4U);
      for (const std::int32_t n : nodes) used[static_cast<std::size_t>(n)] = true;
      faces[nodes].emplace_back(h, f);
    }
  std::map<std::set<std::int32_t>, int> edges;  // of the boundary: each belongs to two faces
  for (const auto& [nodes, hexes] : faces) {
    ASSERT_LE(hexes.size(), 2U);
    if (hexes.size() == 2) continue;
    for (std::size_t c = 0; c < 4; ++c) {
      const auto& hex = mesh.hex[hexes[0].first];
      const auto& corner = sculpt::kFaces[hexes[0].second];
      ++edges[{hex[static_cast<std::size_t>(corner[c])], hex[static_cast<std::size_t>(corner[(c + 1) % 4])]}];
    }
  }
  for (const auto& [nodes, count] : edges) ASSERT_EQ(count, 2);
  EXPECT_EQ(std::count(used.begin(), used.end(), false), 0);
  EXPECT_TRUE(std::is_sorted(mesh.block.begin(), mesh.block.end()));
  std::set<std::array<double, 3>> places;
  for (const Vec3& p : mesh.node)
    places.insert({std::round(p.x * 1e9), std::round(p.y * 1e9), std::round(p.z * 1e9)});
  EXPECT_EQ(places.size(), mesh.node.size());
}

// Sets list boundary faces once, and something at all.
void expect_sets(const Mesh& mesh) {
  for (const auto& s : mesh.side_sets) {
    EXPECT_FALSE(s.element.empty()) << s.name;
    std::set<std::pair<std::int32_t, std::int32_t>> sides;
    for (std::size_t i = 0; i < s.element.size(); ++i) sides.emplace(s.element[i], s.side[i]);
    EXPECT_EQ(sides.size(), s.element.size()) << s.name;
  }
  for (const auto& s : mesh.node_sets) {
    EXPECT_FALSE(s.node.empty()) << s.name;
    EXPECT_TRUE(std::is_sorted(s.node.begin(), s.node.end())) << s.name;
  }
}

class EveryKind : public testing::TestWithParam<const char*> {};

TEST_P(EveryKind, IsConformingAndRightHanded) {
  const Mesh mesh = made(GetParam());
  expect_conforming(mesh);
  expect_sets(mesh);
  EXPECT_GT(least_scaled_jacobian(mesh), 0.3);
}

TEST_P(EveryKind, StaysTheSameMeshWhenShuffled) {
  const Mesh mesh = made(GetParam()), shuffled = made(GetParam(), {"--permute", "7"});
  EXPECT_NE(shuffled.hex, mesh.hex);
  EXPECT_NEAR(volume(shuffled), volume(mesh), 1e-9 * volume(mesh));
  ASSERT_EQ(shuffled.side_sets.size(), mesh.side_sets.size());
  for (std::size_t s = 0; s < mesh.side_sets.size(); ++s) {
    const auto centre = [](const Mesh& m, const Mesh::SideSet& set) {
      Vec3 sum;
      for (std::size_t i = 0; i < set.element.size(); ++i)
        for (const int c : sculpt::kFaces[static_cast<std::size_t>(set.side[i])])
          sum += m.corners(static_cast<std::size_t>(set.element[i]))[static_cast<std::size_t>(c)];
      return sum;
    };
    const Vec3 apart = centre(mesh, mesh.side_sets[s]) - centre(shuffled, shuffled.side_sets[s]);
    EXPECT_LT(norm(apart), 1e-6) << mesh.side_sets[s].name;
  }
  expect_sets(shuffled);
}

INSTANTIATE_TEST_SUITE_P(HexMesh, EveryKind,
                         testing::Values("nested", "cylinder", "sphere-in-cube", "bar", "box"),
                         [](const auto& of) {
                           std::string name = of.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST(HexMesh, KindsHoldAtOtherSizes) {
  for (const char* n : {"1", "3"}) {
    const Mesh mesh = made("nested", {"--n", n});
    expect_conforming(mesh);
    EXPECT_GT(least_scaled_jacobian(mesh), 0.3) << n;
  }
  for (const char* n : {"2", "3", "15"})
    for (const char* kind : {"cylinder", "sphere-in-cube"}) {
      const Mesh mesh = made(kind, {"--n", n});
      expect_conforming(mesh);
      EXPECT_GT(least_scaled_jacobian(mesh), 0.3) << kind << " " << n;
    }
}

TEST(HexMesh, VolumesAreThoseOfTheShapes) {
  EXPECT_NEAR(volume(made("cylinder", {"--n", "30", "--layers", "2"})), kPi * 25 * 10, 0.002 * kPi * 250);
  EXPECT_NEAR(volume(made("sphere-in-cube")), 8, 1e-12);
  EXPECT_NEAR(volume(made("sphere-in-cube", {"--n", "24"}), 0), 4 * kPi / 3 * 0.6 * 0.6 * 0.6, 0.01);
  EXPECT_NEAR(volume(made("box", {"--nx", "3", "--lx", "2", "--z0", "-5"})), 200, 1e-9);
  EXPECT_NEAR(volume(made("bar", {"--nx", "200"})), 80, 0.01);
}

TEST(HexMesh, NestedHasFourBlocksAroundEachOther) {
  const Mesh mesh = made("nested");
  ASSERT_EQ(mesh.blocks.size(), 4U);
  EXPECT_GT(mesh.hex.size(), 10000U);
  EXPECT_LT(mesh.hex.size(), 30000U);
  // A line of hexes along z has as many hexes around it as its nodes in the cross section have quads.
  std::map<std::int32_t, int> hexes_of;
  for (const Hex& h : mesh.hex)
    for (const std::int32_t n : h) ++hexes_of[n];
  std::set<int> counts;
  for (const auto& [n, count] : hexes_of) counts.insert(count);
  EXPECT_TRUE(counts.contains(6));   // three quads, two layers
  EXPECT_TRUE(counts.contains(10));  // five
  for (std::size_t h = 0; h < mesh.hex.size(); ++h) {
    const auto p = mesh.corners(h);
    Vec3 centre;
    for (const Vec3& c : p) centre += 0.125 * c;
    const double radius = std::hypot(centre.x - 13, centre.y - 13);
    EXPECT_EQ(mesh.block[h], centre.z > 21.4 ? 3 : radius > 8 ? 2 : centre.z > 7 ? 1 : 0);
  }
}

TEST(HexMesh, FractionsOfGrainsSumToOne) {
  const Mesh mesh = made("cylinder", {"--grains", "9", "--seed", "4"});
  ASSERT_EQ(mesh.variables.size(), 9U);
  EXPECT_EQ(mesh.variables[8].name, "vf_9");
  int mixed = 0;
  for (std::size_t h = 0; h < mesh.hex.size(); ++h) {
    double sum = 0, most = 0;
    for (const auto& v : mesh.variables) {
      sum += v.value[h];
      most = std::max(most, v.value[h]);
    }
    EXPECT_EQ(sum, 1);  // multiples of 1/64
    mixed += most < 1;
  }
  EXPECT_GT(mixed, 100);
  for (const auto& v : mesh.variables)
    EXPECT_GT(std::accumulate(v.value.begin(), v.value.end(), 0.0), 50) << v.name;
}

TEST(HexMesh, AFileHoldsTheMesh) {
  const std::string path =
      (std::filesystem::temp_directory_path() / ("sculpt_hexmesh_" + std::to_string(::getpid()) + ".g"))
          .string();
  const Mesh mesh = made("nested", {"--n", "1", "--grains", "3"});
  write_mesh(path, mesh, "a title");
  const sculpt::RankMesh back = sculpt::read_exodus(path);
  std::filesystem::remove(path);
  EXPECT_EQ(back.title, "a title");
  ASSERT_EQ(back.x.size(), mesh.node.size());
  for (std::size_t n = 0; n < mesh.node.size(); ++n)
    EXPECT_EQ((Vec3{back.x[n], back.y[n], back.z[n]}), mesh.node[n]);
  std::size_t hex = 0;
  ASSERT_EQ(back.blocks.size(), 4U);
  for (const auto& block : back.blocks)
    for (std::size_t i = 0; i < block.nodes.size(); ++i, hex += i % 8 == 0)
      EXPECT_EQ(block.nodes[i] - 1, mesh.hex[hex][i % 8]);
  EXPECT_EQ(back.blocks[2].name, "tube");
  ASSERT_EQ(back.side_sets.size(), mesh.side_sets.size());
  EXPECT_EQ(back.side_sets[3].name, "upper_tube");
  EXPECT_EQ(back.side_sets[2].side[0], mesh.side_sets[2].side[0] + 1);
  ASSERT_EQ(back.element_values.size(), 3U);
  EXPECT_EQ(back.element_values[1], mesh.variables[1].value);
}

TEST(HexMesh, DirectionsAreThoseOfTheLibrary) {
  for (int i = -40; i <= 400; ++i) {
    const Direction d = direction(i / 360.0);
    EXPECT_NEAR(d.cos, std::cos(i / 180.0 * kPi), 1e-15) << i;
    EXPECT_NEAR(d.sin, std::sin(i / 180.0 * kPi), 1e-15) << i;
  }
  EXPECT_EQ(direction(0.25).cos, 0);
  EXPECT_EQ(direction(0.125).cos, direction(0.375).sin);
}

std::string mistake(const std::string& kind, std::vector<std::string> words) {
  try {
    Options options(std::move(words));
    (void)make_mesh(kind_named(kind), options);
    return options.file();
  } catch (const std::exception& e) {
    return e.what();
  }
}

TEST(HexMesh, MistakesAreTold) {
  EXPECT_EQ(mistake("box", {"--nx", "2", "a.g"}), "a.g");
  EXPECT_EQ(mistake("cube", {}), "found 'cube', expected one of nested cylinder sphere-in-cube bar box");
  EXPECT_EQ(mistake("box", {"--nx", "2x"}), "--nx: found '2x', expected an integer from 1 to 500");
  EXPECT_EQ(mistake("box", {"--nx"}), "--nx: no value");
  EXPECT_TRUE(mistake("box", {"--radius", "3", "a.g"}).starts_with("no option --radius here; there are --"));
  EXPECT_EQ(mistake("box", {"a.g", "b.g"}), "found 2 file names, expected one");
  EXPECT_EQ(mistake("box", {"--nx", "1", "--ny", "1", "--nz", "1", "--grains", "2", "a.g"}),
            "--grains: 2 grains in a mesh of 1 hexes");
}

}  // namespace
}  // namespace hexmesh
