#include <gtest/gtest.h>

#include "support/surfaces.hpp"

namespace sculpt::test {
namespace {

const Facets kCube = box_facets({0, 0, 0}, {1, 1, 1});

struct Repaired {
  FacetMesh mesh;
  FacetReport report;
  double volume;
};
Repaired repaired(const Facets& facets) {
  Repaired r;
  r.mesh = parse_stl(ascii_stl(facets), "test.stl");
  r.report = repair(r.mesh);
  r.volume = sizes_of(r.mesh).volume;
  return r;
}

void expect_closed(const FacetReport& report) {
  EXPECT_EQ(report.open.count, 0);
  EXPECT_EQ(report.non_manifold.count, 0);
  EXPECT_EQ(report.inconsistent.count, 0);
}

TEST(Repair, LeavesACubeAlone) {
  const Repaired r = repaired(kCube);
  expect_closed(r.report);
  EXPECT_EQ(r.report.components, 1);
  EXPECT_EQ(r.report.flipped.count + r.report.duplicate.count + r.report.degenerate.count, 0);
  EXPECT_DOUBLE_EQ(r.volume, 1);
}

TEST(Repair, TurnsFacetsThatLookInwards) {
  Facets facets = kCube;
  std::swap(facets[4][0], facets[4][1]);
  std::swap(facets[7][0], facets[7][1]);
  const Repaired r = repaired(facets);
  expect_closed(r.report);
  EXPECT_EQ(r.report.flipped.count, 2);
  EXPECT_EQ(r.report.flipped.facet, 5);
  EXPECT_DOUBLE_EQ(r.volume, 1);
}

TEST(Repair, TurnsASurfaceInsideOut) {
  const Repaired r = repaired(turned(kCube));
  EXPECT_EQ(r.report.flipped.count, 12);
  EXPECT_DOUBLE_EQ(r.volume, 1);
}

TEST(Repair, KeepsHollows) {
  const Facets hollow = kCube + turned(box_facets({0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}));
  const Repaired r = repaired(hollow), inside_out = repaired(turned(hollow));
  EXPECT_EQ(r.report.components, 2);
  EXPECT_EQ(r.report.flipped.count, 0);
  EXPECT_DOUBLE_EQ(r.volume, 1 - 0.125);
  EXPECT_EQ(inside_out.report.flipped.count, 24);
  EXPECT_DOUBLE_EQ(inside_out.volume, 1 - 0.125);
}

TEST(Repair, TurnsBodiesBesideEachOtherAlone) {
  const Repaired r = repaired(kCube + turned(moved(kCube, {3, 0, 0})));
  EXPECT_EQ(r.report.components, 2);
  EXPECT_EQ(r.report.flipped.count, 12);
  EXPECT_EQ(r.report.flipped.facet, 13);
  EXPECT_DOUBLE_EQ(r.volume, 2);
}

TEST(Repair, DropsFacetsOfNoUse) {
  Facets facets = kCube;
  facets.push_back({facets[2][1], facets[2][2], facets[2][0]});               // again, from another corner
  facets.insert(facets.begin(), {facets[0][0], facets[0][1], facets[0][0]});  // a line
  const Repaired r = repaired(facets);
  expect_closed(r.report);
  EXPECT_EQ(r.report.duplicate.count, 1);
  EXPECT_EQ(r.report.duplicate.facet, 14);
  EXPECT_EQ(r.report.degenerate.count, 1);
  EXPECT_EQ(r.report.degenerate.facet, 1);
  EXPECT_EQ(r.mesh.triangles.size(), 12U);
  EXPECT_EQ(r.mesh.facet.front(), 2);
}

TEST(Repair, TellsOfHoles) {
  Facets facets = kCube;
  facets.erase(facets.begin() + 8);
  const Repaired r = repaired(facets);
  EXPECT_EQ(r.report.open.count, 3);
  EXPECT_EQ(r.report.non_manifold.count, 0);
}

TEST(Repair, WeldsCornersThatAreAlmostOne) {
  Facets facets = kCube;
  facets[3][2] += {1e-9, 0, -1e-9};
  const Repaired r = repaired(facets);
  expect_closed(r.report);
  EXPECT_EQ(r.report.welded.count, 1);
  facets[3][2] += {1e-3, 0, 0};
  EXPECT_EQ(repaired(facets).report.welded.count, 0);
  EXPECT_GT(repaired(facets).report.open.count, 0);
}

TEST(Repair, BodiesThatShareAnEdgeStayWhatTheyAre) {
  const Repaired r = repaired(kCube + box_facets({1, 1, 0}, {2, 2, 1}));
  EXPECT_EQ(r.report.non_manifold.count, 1);
  EXPECT_EQ(r.report.non_manifold.place, (Vec3{1, 1, 0.5}));
  EXPECT_EQ(r.report.components, 2);
  EXPECT_DOUBLE_EQ(r.volume, 2);
}

TEST(Repair, TellsOfSurfacesWithOneSide) {
  // Moebius strip of three quads.
  const std::array<Vec3, 6> p{{{1, 0, 0}, {1, 0, 1}, {-1, 1, 0}, {-1, 1, 1}, {-1, -1, 0}, {-1, -1, 1}}};
  const Facets strip{{p[0], p[1], p[2]}, {p[1], p[3], p[2]}, {p[2], p[3], p[4]},
                     {p[3], p[5], p[4]}, {p[4], p[5], p[1]}, {p[5], p[0], p[1]}};
  EXPECT_EQ(repaired(strip).report.inconsistent.count, 1);
}

TEST(FacetNeighbours, GoRoundEachEdge) {
  const FacetMesh mesh = mesh_of(kCube + box_facets({1, 1, 0}, {2, 2, 1}));
  const FacetNeighbours next = facet_neighbours(mesh);
  int fours = 0;
  for (std::size_t t = 0; t < next.size(); ++t)
    for (std::size_t e = 0; e < 3; ++e) {
      const auto& corner = mesh.triangles[t];
      int length = 1;
      for (std::size_t u = at(next[t][e]); u != t; ++length) {
        std::size_t f = 0;
        while (mesh.triangles[u][f] != corner[(e + 1) % 3] && mesh.triangles[u][f] != corner[e]) ++f;
        if (mesh.triangles[u][(f + 1) % 3] != corner[e] &&
            mesh.triangles[u][(f + 1) % 3] != corner[(e + 1) % 3])
          f = (f + 2) % 3;
        u = at(next[u][f]);
      }
      EXPECT_TRUE(length == 2 || length == 4);
      fours += length == 4;
    }
  EXPECT_EQ(fours, 4);
}

TEST(FacetSizes, OfACube) {
  const FacetSizes sizes = sizes_of(mesh_of(box_facets({0, 0, 0}, {2, 2, 2})));
  EXPECT_DOUBLE_EQ(sizes.side_min, 2);
  EXPECT_DOUBLE_EQ(sizes.side_max, std::sqrt(8));
  EXPECT_NEAR(sizes.angle_min, 45, 1e-9);
  EXPECT_NEAR(sizes.angle_max, 90, 1e-9);
  EXPECT_DOUBLE_EQ(sizes.area_min, 2);
  EXPECT_DOUBLE_EQ(sizes.volume, 8);
}

}  // namespace
}  // namespace sculpt::test
