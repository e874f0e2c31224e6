// All ranks together make the mesh that one rank makes alone, to the last bit.
#include "sculpt/input/pamgen.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "../../unit/input/input_fixture.hpp"
#include "../../unit/input/pamgen_descriptions.hpp"

namespace sculpt {
namespace {

using namespace test;

template <class T>
std::vector<T> sorted(std::vector<T> list) {
  std::sort(list.begin(), list.end());
  return list;
}

struct Element {
  GlobalId number;
  std::array<GlobalId, 8> corner;
  std::int32_t block;
  auto operator<=>(const Element&) const = default;
};

std::vector<Element> elements_of(const ElementShare& share) {
  std::vector<Element> list;
  for (std::size_t e = 0; e < share.element.size(); ++e)
    list.push_back({share.element[e], share.corner[e], share.block[e]});
  return list;
}

struct Node {
  GlobalId number;
  std::array<double, 3> position;
  auto operator<=>(const Node&) const = default;
};

std::vector<Node> nodes_of(const ElementShare& share) {
  std::vector<Node> list;
  for (std::size_t n = 0; n < share.node.size(); ++n)
    list.push_back({share.node[n], {share.position[n].x, share.position[n].y, share.position[n].z}});
  return list;
}

template <class T>
std::vector<T> without_repeats(std::vector<T> list) {
  list = sorted(std::move(list));
  list.erase(std::unique(list.begin(), list.end()), list.end());
  return list;
}

void expect_same_as_alone(const std::string& text) {
  const Comm comm = Comm::world();
  const TemporaryFile file(comm, text);
  const InputMesh mine = read_pamgen(comm, file.path(), Log());
  const InputMesh whole = read_pamgen(Comm::self(), file.path(), Log());
  EXPECT_EQ(mine.share.elements, whole.share.elements);
  EXPECT_EQ(mine.share.nodes, whole.share.nodes);
  EXPECT_EQ(mine.blocks, whole.blocks);
  EXPECT_TRUE(std::is_sorted(mine.share.element.begin(), mine.share.element.end()));
  EXPECT_TRUE(std::is_sorted(mine.share.node.begin(), mine.share.node.end()));
  EXPECT_EQ(sorted(comm.concatenate(elements_of(mine.share))), elements_of(whole.share));
  EXPECT_EQ(without_repeats(comm.concatenate(nodes_of(mine.share))), nodes_of(whole.share));
  ASSERT_EQ(mine.side_sets.size(), whole.side_sets.size());
  for (std::size_t s = 0; s < whole.side_sets.size(); ++s) {
    const auto faces = [](const InputMesh::SideSet& set) {
      std::vector<std::array<GlobalId, 2>> list;
      for (std::size_t i = 0; i < set.element.size(); ++i) list.push_back({set.element[i], set.face[i]});
      return list;
    };
    EXPECT_EQ(mine.side_sets[s].id, whole.side_sets[s].id);
    EXPECT_EQ(sorted(comm.concatenate(faces(mine.side_sets[s]))), sorted(faces(whole.side_sets[s])));
  }
  ASSERT_EQ(mine.node_sets.size(), whole.node_sets.size());
  for (std::size_t s = 0; s < whole.node_sets.size(); ++s) {
    EXPECT_EQ(mine.node_sets[s].id, whole.node_sets[s].id);
    EXPECT_EQ(without_repeats(comm.concatenate(mine.node_sets[s].node)), sorted(whole.node_sets[s].node));
  }
}

TEST(PamgenTogether, Rectilinear) { expect_same_as_alone(kRectilinear); }
TEST(PamgenTogether, Brick) { expect_same_as_alone(kBrick); }
TEST(PamgenTogether, Cylinder) { expect_same_as_alone(kCylinder); }
TEST(PamgenTogether, Sphere) { expect_same_as_alone(kSphere); }
// 4 x 4 x 4 elements, which Pamgen does not cut in 7.
TEST(PamgenTogether, Transformed) { expect_same_as_alone(kTransformed); }

TEST(PamgenTogether, FewerElementsThanRanks) {
  std::string text = kTransformed;
  for (const char* n : {"nx = 4", "ny = 4", "nz = 4"}) text.replace(text.find(n) + 5, 1, "1");
  expect_same_as_alone(text);
}

TEST(PamgenTogether, OneMessageForAllRanks) {
  const Comm comm = Comm::world();
  std::string text = kRectilinear;
  text.replace(text.find("gmin"), 4, "gmn");
  const TemporaryFile file(comm, text);
  try {
    (void)read_pamgen(comm, file.path(), Log());
    FAIL();
  } catch (const AgreedError& e) {
    EXPECT_EQ(e.what(),
              "input_mesh_pamgen: '" + file.path() + "': line 9: Unknown identifier in this context: GMN");
  }
}

}  // namespace
}  // namespace sculpt
