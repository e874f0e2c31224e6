#include "sculpt/brep/interfaces.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/stages.hpp"

namespace sculpt {
namespace {

struct Traced {
  HexMesh cells;
  Interfaces faces;
  // Class of the grid node (i,j,k); fails when it is not on an interface.
  [[nodiscard]] NodeClass kind(const Index3& n) const {
    return faces.kind[static_cast<std::size_t>(interface_node(n))];
  }
  [[nodiscard]] LocalId interface_node(const Index3& n) const {
    const auto& l = cells.lattice;
    const LocalId i =
        faces.index_of[static_cast<std::size_t>(n[0] + (l[0] + 1) * (n[1] + (l[1] + 1) * n[2]))];
    if (i == kNone) throw Error("no interface node");
    return i;
  }
};

Traced traced(const Index3& cells, std::int32_t materials,
              const std::function<std::int32_t(const Index3&)>& material) {
  Traced t{test::overlay(test::voxels("by hand", cells, materials, material)).cells, {}};
  t.faces = trace_interfaces(t.cells, face_neighbours(t.cells));
  return t;
}

void expect_consistent(const Traced& t) {
  const Interfaces& f = t.faces;
  std::size_t items = 0;
  for (std::size_t i = 0; i < f.nodes.size(); ++i) {
    EXPECT_EQ(f.index_of[static_cast<std::size_t>(f.nodes[i])], static_cast<LocalId>(i));
    items += f.node_quads[i].size();
    EXPECT_TRUE(std::is_sorted(f.node_quads[i].begin(), f.node_quads[i].end()));
    for (const LocalId item : f.node_quads[i])
      EXPECT_EQ(f.quads[static_cast<std::size_t>(item / 4)].node[static_cast<std::size_t>(item % 4)],
                f.nodes[i]);
    for (const LocalId n : f.neighbours[i]) {
      const auto back = f.neighbours[static_cast<std::size_t>(n)];
      EXPECT_TRUE(std::binary_search(back.begin(), back.end(), static_cast<LocalId>(i)));
    }
    for (const LocalId n : f.curve_neighbours[i])
      EXPECT_TRUE(std::binary_search(f.neighbours[i].begin(), f.neighbours[i].end(), n));
  }
  EXPECT_EQ(items, 4 * f.quads.size());
  for (const InterfaceQuad& q : f.quads) {
    EXPECT_LT(q.cell[0], q.cell[1]);
    Vec3 from, to;
    for (const LocalId n : t.cells.hexes[static_cast<std::size_t>(q.cell[0])])
      from += t.cells.position[static_cast<std::size_t>(n)];
    for (const LocalId n : t.cells.hexes[static_cast<std::size_t>(q.cell[1])])
      to += t.cells.position[static_cast<std::size_t>(n)];
    const auto p = [&](std::size_t v) { return t.cells.position[static_cast<std::size_t>(q.node[v])]; };
    EXPECT_GT(dot(cross(p(2) - p(0), p(3) - p(1)), to - from), 0)
        << "the normal points from cell[0] to cell[1]";
  }
}

TEST(Interfaces, OfOneMaterialAreEmpty) {
  const Traced t = traced({3, 3, 3}, 1, [](const Index3&) { return 0; });
  EXPECT_TRUE(t.faces.quads.empty());
  EXPECT_TRUE(t.faces.nodes.empty());
}

TEST(Interfaces, OfAPlaneThroughTheBox) {
  const Traced t = traced({4, 3, 5}, 2, [](const Index3& c) { return c[0] < 2 ? 1 : 0; });
  EXPECT_EQ(t.faces.quads.size(), 15U);
  EXPECT_EQ(t.faces.nodes.size(), 4U * 6U);
  expect_consistent(t);
  for (const InterfaceQuad& q : t.faces.quads) {
    EXPECT_EQ(q.face, 1);
    EXPECT_EQ(Interfaces::materials(t.cells, q), (std::array<std::int32_t, 2>{0, 1}));
  }
  EXPECT_EQ(t.kind({2, 1, 1}), NodeClass::kSurface);
  EXPECT_EQ(t.kind({2, 0, 2}), NodeClass::kCurve) << "where the interface meets a side of the box";
  EXPECT_EQ(t.kind({2, 2, 5}), NodeClass::kCurve);
  EXPECT_EQ(t.kind({2, 0, 0}), NodeClass::kVertex) << "at an edge of the box";
  EXPECT_EQ(t.faces.neighbours[static_cast<std::size_t>(t.interface_node({2, 1, 1}))].size(), 4U);
  EXPECT_EQ(t.faces.curve_neighbours[static_cast<std::size_t>(t.interface_node({2, 1, 1}))].size(), 0U);
  EXPECT_EQ(t.faces.curve_neighbours[static_cast<std::size_t>(t.interface_node({2, 0, 2}))].size(), 2U);
  EXPECT_EQ(std::count(t.faces.kind.begin(), t.faces.kind.end(), NodeClass::kVertex), 4);
}

TEST(Interfaces, OfAnIsolatedCell) {
  const Traced t = traced({3, 3, 3}, 2, [](const Index3& c) { return c == Index3{1, 1, 1} ? 1 : 0; });
  EXPECT_EQ(t.faces.quads.size(), 6U);
  EXPECT_EQ(t.faces.nodes.size(), 8U);
  expect_consistent(t);
  EXPECT_EQ(std::count(t.faces.kind.begin(), t.faces.kind.end(), NodeClass::kSurface), 8)
      << "one closed smooth surface";
}

TEST(Interfaces, OfThreeMaterialsMeetInACurve) {
  // 0 | 1 side by side on top of 2.
  const Traced t = traced({4, 4, 4}, 3, [](const Index3& c) { return c[2] < 2 ? 2 : c[0] < 2 ? 0 : 1; });
  expect_consistent(t);
  EXPECT_EQ(t.faces.quads.size(), 16U + 8U);
  EXPECT_EQ(t.kind({2, 2, 2}), NodeClass::kCurve);
  EXPECT_EQ(t.kind({1, 2, 2}), NodeClass::kSurface);
  EXPECT_EQ(t.kind({2, 2, 3}), NodeClass::kSurface);
  EXPECT_EQ(t.kind({2, 0, 2}), NodeClass::kVertex) << "the curve ends on the box";
  EXPECT_EQ(t.kind({2, 0, 3}), NodeClass::kCurve);
  const auto curve = t.faces.curve_neighbours[static_cast<std::size_t>(t.interface_node({2, 2, 2}))];
  ASSERT_EQ(curve.size(), 2U);
  EXPECT_EQ(curve[0], t.interface_node({2, 1, 2}));
  EXPECT_EQ(curve[1], t.interface_node({2, 3, 2}));
}

TEST(Interfaces, OfFourMaterialsMeetInAVertex) {
  // A layer of 3 below three sectors: four curves meet in the middle node.
  const Traced t = traced({4, 4, 4}, 4, [](const Index3& c) {
    return c[2] < 2 ? 3 : c[0] < 2 ? 0 : c[1] < 2 ? 1 : 2;
  });
  expect_consistent(t);
  EXPECT_EQ(t.kind({2, 2, 2}), NodeClass::kVertex);
  EXPECT_EQ(t.faces.curve_neighbours[static_cast<std::size_t>(t.interface_node({2, 2, 2}))].size(), 4U);
  EXPECT_EQ(t.kind({2, 2, 3}), NodeClass::kCurve);
  EXPECT_EQ(t.kind({3, 2, 2}), NodeClass::kCurve);
}

TEST(Interfaces, AFlatCornerOfMaterialsIsNoCurve) {
  // Two quads of one interface at a right angle: an edge of the staircase is part of a smooth surface.
  const Traced t = traced({4, 4, 4}, 2, [](const Index3& c) { return c[0] < 2 && c[1] < 2 ? 0 : 1; });
  EXPECT_EQ(t.kind({2, 2, 2}), NodeClass::kSurface);
  EXPECT_EQ(t.kind({2, 2, 0}), NodeClass::kCurve) << "on the box";
}

TEST(Interfaces, QuadsAscendAndAreCompleteOnRandomVoxels) {
  const test::Case input = test::noise({6, 5, 4}, 4, 9);
  Traced t{test::filtered(input).cells, {}};
  const FaceNeighbours neighbours = face_neighbours(t.cells);
  t.faces = trace_interfaces(t.cells, neighbours);
  expect_consistent(t);
  std::size_t expected = 0;
  for (std::size_t c = 0; c < neighbours.size(); ++c)
    for (const LocalId other : neighbours[c])
      expected += other != kNone && t.cells.material[static_cast<std::size_t>(other)] != t.cells.material[c];
  EXPECT_EQ(2 * t.faces.quads.size(), expected);
  EXPECT_TRUE(std::is_sorted(t.faces.quads.begin(), t.faces.quads.end(),
                             [](const InterfaceQuad& a, const InterfaceQuad& b) {
                               return std::pair(a.cell[0], a.face) < std::pair(b.cell[0], b.face);
                             }));
}

}  // namespace
}  // namespace sculpt
