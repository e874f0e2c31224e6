#include "sculpt/contour/capture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "support/features.hpp"
#include "support/mesh_checks.hpp"
#include "support/stages.hpp"

namespace sculpt {
namespace {

struct Contoured {
  HexMesh cells;
  Interfaces faces;
  Capture capture;
};

// The interface of a box as the contour leaves it, captured.
Contoured contoured(const std::shared_ptr<const test::BoxFeatures>& box, std::int32_t only = kNone) {
  test::Overlay o = test::filtered(test::box_case({16, 16, 16}, *box));
  Contoured c{std::move(o.cells), {}, {}};
  c.faces = trace_interfaces(c.cells, face_neighbours(c.cells));
  place_nodes(c.cells, c.faces, edge_crossings(c.cells, c.faces, o.fractions, NodeHexes(c.cells)));
  c.capture = capture_geometry(c.cells, c.faces, box, only);
  return c;
}

const auto kBox = test::turned_box({8.1, 7.9, 8.05}, {5, 4.3, 4.6});

TEST(Capture, DividesABoxIntoItsSixSides) {
  const Contoured c = contoured(kBox);
  EXPECT_EQ(std::set<std::int32_t>(c.faces.part.begin(), c.faces.part.end()),
            (std::set<std::int32_t>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(c.capture.corner_nodes, 8);
  std::set<std::pair<std::int32_t, std::int32_t>> curves;
  for (std::size_t i = 0; i < c.faces.nodes.size(); ++i)
    if (c.capture.tie[i].kind == Tie::Kind::kCurve) curves.emplace(c.capture.tie[i].a, c.capture.tie[i].b);
  EXPECT_EQ(curves.size(), 12U);
}

TEST(Capture, MakesCurvesOfTheEdgesBetweenTheSides) {
  const Contoured c = contoured(kBox);
  for (std::size_t i = 0; i < c.faces.nodes.size(); ++i) {
    std::set<std::int32_t> parts;
    for (const LocalId item : c.faces.node_quads[i]) parts.insert(c.faces.part[at(item / 4)]);
    EXPECT_EQ(c.faces.kind[i] == NodeClass::kSurface, parts.size() == 1);
    EXPECT_EQ(c.faces.curve_neighbours[i].empty(), parts.size() == 1);
  }
}

TEST(Capture, TiesEveryNodeToAPointOfTheBox) {
  const Contoured c = contoured(kBox);
  std::set<std::array<double, 3>> corners;
  for (std::size_t i = 0; i < c.faces.nodes.size(); ++i) {
    const Vec3 p = c.cells.position[at(c.faces.nodes[i])];
    const std::optional<Vec3> to = c.capture.onto(i, p);
    ASSERT_TRUE(to.has_value());
    EXPECT_NEAR(norm(kBox->nearest(*to, 0, 1)->point - *to), 0, 1e-12);
    if (c.capture.tie[i].kind == Tie::Kind::kCurve) EXPECT_NEAR(kBox->from_edges(*to), 0, 1e-12);
    if (c.capture.tie[i].kind == Tie::Kind::kCorner) corners.insert({to->x, to->y, to->z});
  }
  EXPECT_EQ(corners.size(), 8U) << "no two nodes share a corner";
}

TEST(Capture, OfOneSideLeavesTheOthersAlone) {
  const Contoured c = contoured(kBox, 3);
  EXPECT_EQ(std::set<std::int32_t>(c.faces.part.begin(), c.faces.part.end()),
            (std::set<std::int32_t>{kNone, 3}));
  EXPECT_EQ(c.capture.curve_nodes, 0);
  const auto tied = std::count_if(c.capture.tie.begin(), c.capture.tie.end(),
                                  [](const Tie& t) { return t.kind == Tie::Kind::kSurface && t.a == 3; });
  EXPECT_GT(tied, 40);
}

TEST(Capture, PassesOverWhatIsFarFromTheGeometry) {
  const auto elsewhere = test::turned_box({8.1, 7.9, 8.05}, {2, 2, 2});
  test::Overlay o = test::filtered(test::box_case({16, 16, 16}, *kBox));
  Interfaces faces = trace_interfaces(o.cells, face_neighbours(o.cells));
  const Capture capture = capture_geometry(o.cells, faces, elsewhere, kNone);
  for (const std::int32_t part : faces.part) EXPECT_EQ(part, kNone);
  for (const Tie& tie : capture.tie) EXPECT_EQ(tie.kind, Tie::Kind::kFree);
}

}  // namespace
}  // namespace sculpt
