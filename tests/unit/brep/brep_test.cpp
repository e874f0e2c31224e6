// Volumes, surfaces, curves and vertices of voxel patterns, counted by hand.
#include "sculpt/brep/brep.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "support/cases.hpp"
#include "support/stages.hpp"

namespace sculpt::test {
namespace {

struct Traced {
  HexMesh cells;
  Interfaces faces;
  Brep brep;
  BoxFaces box;
};

Traced traced(const Case& input) {
  Traced t;
  t.cells = overlay(input).cells;
  const FaceNeighbours neighbours = face_neighbours(t.cells);
  t.faces = trace_interfaces(t.cells, neighbours);
  t.brep = build_brep(Comm::self(), t.cells, neighbours, t.faces);
  t.box = trace_box_faces(Comm::self(), t.cells, neighbours, t.brep.volume);
  return t;
}
Traced traced(const Index3& cells, std::int32_t materials,
              const std::function<std::int32_t(const Index3&)>& material) {
  return traced(voxels("brep", cells, materials, material));
}

void expect_counts(const Brep& b, std::int64_t volumes, std::int64_t surfaces, std::int64_t curves,
                   std::int64_t vertices) {
  EXPECT_EQ(b.volumes, volumes);
  EXPECT_EQ(b.surfaces, surfaces);
  EXPECT_EQ(b.curves, curves);
  EXPECT_EQ(b.vertices, vertices);
}

TEST(Brep, OfOneMaterialIsOneVolumeAndTheSidesOfTheBox) {
  const Traced t = traced({3, 2, 4}, 1, [](const Index3&) { return 0; });
  expect_counts(t.brep, 1, 0, 0, 0);
  EXPECT_EQ(t.box.surfaces, 6);
  EXPECT_EQ(t.box.faces.size(), 52u);
}

TEST(Brep, OfTwoHalvesHasOneSurfaceBoundedByFourCurves) {
  const Traced t = traced({4, 4, 4}, 2, [](const Index3& c) { return c[0] < 2 ? 0 : 1; });
  expect_counts(t.brep, 2, 1, 4, 4);
  EXPECT_EQ(t.box.surfaces, 10);
}

TEST(Brep, OfTwoCellsHasCurvesOfOneEdgeBetweenVertices) {
  expect_counts(traced(voxels({2, 1, 1}, {0, 1})).brep, 2, 1, 4, 4);
}

TEST(Brep, OfAnInclusionHasAClosedSurfaceWithoutCurves) {
  const auto inside = [](const Index3& c) {
    return std::all_of(c.begin(), c.end(), [](auto x) { return x == 1 || x == 2; });
  };
  expect_counts(traced({4, 4, 4}, 2, [&](const Index3& c) { return inside(c) ? 1 : 0; }).brep, 2, 1, 0, 0);
}

TEST(Brep, OfAColumnHasTwoClosedCurvesWithoutVertices) {
  const auto inside = [](const Index3& c) { return c[0] > 0 && c[0] < 3 && c[1] > 0 && c[1] < 3; };
  const Traced t = traced({4, 4, 5}, 2, [&](const Index3& c) { return inside(c) ? 1 : 0; });
  expect_counts(t.brep, 2, 1, 2, 0);
  EXPECT_EQ(t.box.surfaces, 8);
}

// A below, B and C above it: a triple line of four edges, nine curves on the box.
TEST(Brep, OfThreeGrainsHasATripleLine) {
  const Traced t = traced({4, 4, 4}, 3, [](const Index3& c) { return c[2] < 2 ? 0 : c[0] < 2 ? 1 : 2; });
  expect_counts(t.brep, 3, 3, 10, 8);
}

//   B B B
//   A C A   A and B meet left and right of C.
//   A A A
TEST(Brep, TwoVolumesMayMeetInTwoSurfaces) {
  const Traced t = traced(voxels({3, 3, 1}, {0, 0, 0, 0, 2, 0, 1, 1, 1}));
  EXPECT_EQ(t.brep.volumes, 3);
  EXPECT_EQ(t.brep.surfaces, 4);
  std::set<std::int32_t> between_a_and_b;
  for (std::size_t q = 0; q < t.faces.quads.size(); ++q)
    if (Interfaces::materials(t.cells, t.faces.quads[q]) == std::array{0, 1})
      between_a_and_b.insert(t.brep.surface[q]);
  EXPECT_EQ(between_a_and_b.size(), 2u);
}

// Four quads meet at the middle edge: nothing is joined across it.
TEST(Brep, SurfacesEndWhereFourQuadsMeet) {
  const Traced t = traced(voxels({2, 2, 1}, {0, 1, 1, 0}));
  EXPECT_EQ(t.brep.volumes, 4);
  EXPECT_EQ(t.brep.surfaces, 4);
}

TEST(Brep, NumbersVolumesByMaterialThenByCell) {
  EXPECT_EQ(traced(voxels({5, 1, 1}, {1, 0, 1, 0, 1})).brep.volume,
            (std::vector<std::int32_t>{2, 0, 3, 1, 4}));
}

TEST(Brep, SeparatesTheBoxFacesOfAVolumeThatDoNotTouch) {
  //  z = 1:  0 1 0    z = 0:  0 0 0
  const Traced t = traced(voxels({3, 1, 2}, {0, 0, 0, 0, 1, 0}));
  EXPECT_EQ(t.brep.volumes, 2);
  std::set<std::int32_t> top;
  for (std::size_t f = 0; f < t.box.faces.size(); ++f)
    if (t.box.faces[f].side == 5) top.insert(t.box.surface[f]);
  EXPECT_EQ(top.size(), 3u);
  EXPECT_EQ(t.box.surfaces, 6 + 4);  // two more on top; ymin and ymax of the other volume
}

TEST(Brep, DoesNotDependOnTheLattice) {
  Traced t = traced(noise({9, 7, 8}, 2, 5));
  HexMesh any = t.cells;
  any.lattice = {0, 0, 0};
  const Brep b = build_brep(Comm::self(), any, face_neighbours(any), t.faces);
  EXPECT_EQ(b.volume, t.brep.volume);
  EXPECT_EQ(b.volumes, t.brep.volumes);
}

// Flood fill, the plain way.
TEST(Brep, FindsTheVolumesThatAFloodFillFinds) {
  const Traced t = traced(noise({12, 11, 10}, 2, 7));
  const FaceNeighbours neighbours = face_neighbours(t.cells);
  std::vector<std::int32_t> seen(t.cells.hexes.size(), -1);
  std::int32_t count = 0;
  for (LocalId seed = 0; seed < t.cells.size(); ++seed) {
    if (seen[static_cast<std::size_t>(seed)] >= 0) continue;
    std::vector<LocalId> stack{seed};
    seen[static_cast<std::size_t>(seed)] = count;
    while (!stack.empty()) {
      const auto c = static_cast<std::size_t>(stack.back());
      stack.pop_back();
      EXPECT_EQ(t.brep.volume[c], t.brep.volume[static_cast<std::size_t>(seed)]);
      for (const LocalId n : neighbours[c]) {
        const auto o = static_cast<std::size_t>(n);
        if (n == kNone || seen[o] >= 0 || t.cells.material[o] != t.cells.material[c]) continue;
        seen[o] = count;
        stack.push_back(n);
      }
    }
    ++count;
  }
  EXPECT_EQ(t.brep.volumes, count);
}

}  // namespace
}  // namespace sculpt::test
