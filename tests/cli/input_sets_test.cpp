// The side sets of an input mesh cover what they did, whatever layers there are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "kinds.hpp"
#include "same_bits.hpp"
#include "sculpt/exo/read_exodus.hpp"
#include "sculpt/geom/hex.hpp"

namespace sculpt::cli {
namespace {

using Point = std::array<double, 3>;

Point point(const RankMesh& mesh, std::int32_t node) {
  const auto n = static_cast<std::size_t>(node) - 1;
  return {mesh.x[n], mesh.y[n], mesh.z[n]};
}
// Corners of the hexes in the order of the file.
std::vector<std::array<Point, 8>> hexes(const RankMesh& mesh) {
  std::vector<std::array<Point, 8>> out;
  for (const RankMesh::Block& block : mesh.blocks)
    for (std::size_t i = 0; i < block.nodes.size(); i += 8) {
      auto& hex = out.emplace_back();
      for (std::size_t c = 0; c < 8; ++c) hex[c] = point(mesh, block.nodes[i + c]);
    }
  return out;
}
double area(const std::array<Point, 4>& p) {
  const auto triangle = [](const Point& a, const Point& b, const Point& c) {
    Vec3 u{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    return 0.5 * norm(cross(u, v));
  };
  return triangle(p[0], p[1], p[2]) + triangle(p[0], p[2], p[3]);
}
double area(const RankMesh& mesh, const RankMesh::SideSet& set) {
  const auto all = hexes(mesh);
  double sum = 0;
  std::set<std::pair<std::int32_t, std::int32_t>> once;
  for (std::size_t i = 0; i < set.element.size(); ++i) {
    std::array<Point, 4> p;
    for (std::size_t v = 0; v < 4; ++v)
      p[v] = all[static_cast<std::size_t>(set.element[i]) - 1]
                [static_cast<std::size_t>(kFaces[static_cast<std::size_t>(set.side[i]) - 1][v])];
    sum += area(p);
    EXPECT_TRUE(once.emplace(set.element[i], set.side[i]).second) << "a face twice";
  }
  return sum;
}

class InputSets : public SameBits {
 protected:
  void make(const std::string& kind, std::vector<std::string> words) const {
    hexmesh::Options options(std::move(words));
    hexmesh::write_mesh(path("in.g"), hexmesh::make_mesh(hexmesh::kind_named(kind), options), "test");
  }
  // The side sets of the input cover what they did.
  void expect_sets(const RankMesh& mesh, const std::vector<std::size_t>& complete) const {
    const RankMesh in = read_exodus(path("in.g"));
    ASSERT_EQ(mesh.side_sets.size(), in.side_sets.size());
    for (std::size_t s = 0; s < in.side_sets.size(); ++s) {
      EXPECT_EQ(mesh.side_sets[s].id, in.side_sets[s].id);
      EXPECT_EQ(mesh.side_sets[s].name, in.side_sets[s].name);
      if (std::find(complete.begin(), complete.end(), s) == complete.end()) continue;
      EXPECT_NEAR(area(mesh, mesh.side_sets[s]) / area(in, in.side_sets[s]), 1, 1e-9) << in.side_sets[s].name;
    }
    ASSERT_EQ(mesh.node_sets.size(), in.node_sets.size());
    for (std::size_t s = 0; s < in.node_sets.size(); ++s) {
      EXPECT_EQ(mesh.node_sets[s].id, in.node_sets[s].id);
      EXPECT_EQ(mesh.node_sets[s].name, in.node_sets[s].name);
      EXPECT_GE(mesh.node_sets[s].node.size(), in.node_sets[s].node.size());
    }
  }
};

TEST_F(InputSets, SetsOfACubeWithLayersOfItsOwn) {
  make("sphere-in-cube", {"--n", "3", "--inside", "2", "--outside", "2", "--grains", "5", "--seed", "7"});
  for (const char* more : {"", "pillow_surfaces = true\n", "pillow_boundary_layers = 1\n"}) {
    SCOPED_TRACE(more);
    const RankMesh alone =
        expect_same(std::string("input_mesh = in.g\ngen_sidesets = input_mesh\n") + more, {3});
    expect_sets(alone, {0, 1, 2, 3, 4, 5});
    const RankMesh fixed = mesh(std::string("input_mesh = in.g\ngen_sidesets = fixed\n") + more, 2);
    ASSERT_GE(fixed.side_sets.size(), 1U);
    EXPECT_EQ(fixed.side_sets[0].id, 1);
    EXPECT_NEAR(area(fixed, fixed.side_sets[0]), 24, 1e-9);
  }
}

}  // namespace
}  // namespace sculpt::cli
