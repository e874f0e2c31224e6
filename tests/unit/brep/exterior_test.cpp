#include "sculpt/brep/exterior.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "sculpt/mesh/edge_walk.hpp"
#include "support/input_meshes.hpp"
#include "support/mesh_checks.hpp"

namespace sculpt::test {
namespace {

HexMesh with_exterior(const WholeMesh& mesh, const ExteriorOptions& options = {},
                      const std::vector<std::int32_t>& keep = {}) {
  InputCells full = input_cells(Comm::self(), mesh);
  std::vector<std::uint8_t> kept;
  for (const std::int32_t b : full.block)
    kept.push_back(std::find(keep.begin(), keep.end(), b) != keep.end());
  find_exterior(Comm::self(), full.cells, face_neighbours(full.cells), kept, options);
  return std::move(full.cells);
}

std::size_t surfaces(const HexMesh& cells) {
  std::set<std::int32_t> found;
  for (const Facet& f : cells.exterior.facets)
    if (f.surface >= 0) found.insert(f.surface);
  EXPECT_EQ(found.size(), cells.exterior.curved.size());
  return found.size();
}
// -1: none.
int kind_of(const HexMesh& cells, LocalId n) {
  const LocalId hold = cells.exterior.hold_of[at(n)];
  return hold == kNone ? -1 : static_cast<int>(cells.exterior.holds[at(hold)].kind);
}
constexpr int kPoint = static_cast<int>(Hold::Kind::kPoint), kLine = static_cast<int>(Hold::Kind::kLine),
              kSurface = static_cast<int>(Hold::Kind::kSurface);

bool is_near(double a, double b) { return std::fabs(a - b) < 1e-9; }

TEST(FindExterior, OfACubeIsWhatTheSidesOfItsBoxAre) {
  const HexMesh cells = with_exterior(permuted(whole_grid(box_grid({3, 4, 5}, {0, 0, 0}, {3, 4, 5})), 3));
  EXPECT_EQ(surfaces(cells), 6U);
  EXPECT_EQ(cells.exterior.facets.size(), 2U * (12 + 15 + 20));
  EXPECT_EQ(exterior_problem(cells, 0), "");
  for (const std::uint8_t curved : cells.exterior.curved) EXPECT_EQ(curved, 0);
  const Vec3 size{3, 4, 5};
  for (LocalId n = 0; n < cells.nodes(); ++n) {
    const Vec3& p = cells.position[at(n)];
    int sides = 0;
    Vec3 free{1, 1, 1};
    for (std::size_t d = 0; d < 3; ++d)
      if (p[d] == 0 || p[d] == size[d]) {
        ++sides;
        free[d] = 0;
      }
    constexpr int kKind[4] = {-1, kSurface, kLine, kPoint};
    EXPECT_EQ(kind_of(cells, n), kKind[sides]);
    const Vec3 move{0.25, -0.125, 0.375};
    EXPECT_EQ(held(cells, n, p, move), scaled(move, free)) << "exactly as on a box";
    EXPECT_EQ(std::popcount(cells.box_sides[at(n)]), sides);
  }
  for (const ExteriorFace& f : cells.exterior.faces)
    EXPECT_EQ(std::popcount(face_sides(cells, f.hex, f.face)), 1);
  for (const Facet& f : cells.exterior.facets) {
    EXPECT_EQ(f.kept, 0);
    EXPECT_EQ(f.whole, 0);
    EXPECT_EQ(f.node[0], *std::min_element(f.node.begin(), f.node.end()));
    Vec3 middle;
    for (const Vec3& c : f.corner) middle += 0.25 * c;
    EXPECT_GT(dot(facet_normal(f), middle - 0.5 * size), 0) << "outward";
  }
}

TEST(FindExterior, OfACylinderHasThreeSurfaces) {
  const HexMesh cells = with_exterior(generated("cylinder", {"--n", "6", "--layers", "4"}));
  EXPECT_EQ(surfaces(cells), 3U);
  EXPECT_EQ(exterior_problem(cells, 0), "");
  int curved = 0;
  for (const std::uint8_t c : cells.exterior.curved) curved += c;
  EXPECT_EQ(curved, 1);
  for (LocalId n = 0; n < cells.nodes(); ++n) {
    const Vec3& p = cells.position[at(n)];
    const bool wall = is_near(std::hypot(p.x, p.y), 5), cap = p.z == 0 || p.z == 10;
    EXPECT_EQ(kind_of(cells, n), wall && cap ? kPoint : wall ? kLine : cap ? kSurface : -1);
    if (wall && !cap) {  // along the axis only
      const Vec3 to = held(cells, n, p, {0.3, 0.2, 0.5});
      EXPECT_EQ((Vec3{to.x, to.y, 0}), (Vec3{}));
      EXPECT_NEAR(to.z, 0.5, 1e-12);
    }
  }
}

TEST(FindExterior, NodesSlideAroundACylinderIfTheyMay) {
  ExteriorOptions options;
  options.slides = true;
  const HexMesh cells = with_exterior(generated("cylinder", {"--n", "6", "--layers", "4"}), options);
  EXPECT_EQ(surfaces(cells), 3U);
  for (LocalId n = 0; n < cells.nodes(); ++n) {
    const Vec3& p = cells.position[at(n)];
    const bool wall = is_near(std::hypot(p.x, p.y), 5), cap = p.z == 0 || p.z == 10;
    EXPECT_EQ(kind_of(cells, n), wall && cap ? kLine : wall || cap ? kSurface : -1) << "the rim is a curve";
    if (!wall || cap) continue;
    const Vec3 to = p + held(cells, n, p, {-0.5 * p.y / 5, 0.5 * p.x / 5, 0});
    EXPECT_LT(std::hypot(to.x, to.y), 5);
    EXPECT_GT(std::hypot(to.x, to.y), 5 * std::cos(3.14159 / 24));
    EXPECT_GT(norm(to - p), 0.4);
  }
}

// A prism with twelve sides: its edges have 150 degrees inside.
TEST(FindExterior, TheFeatureAngleTellsWhereSurfacesEnd) {
  const WholeMesh mesh = generated("cylinder", {"--n", "3", "--layers", "2"});
  for (const auto& [angle, count] :
       {std::pair{80.0, 1U}, std::pair{135.0, 3U}, std::pair{149.0, 3U}, std::pair{151.0, 14U}}) {
    ExteriorOptions options;
    options.feature_angle = angle;
    EXPECT_EQ(surfaces(with_exterior(mesh, options)), count) << angle;
  }
}

TEST(FindExterior, FacesWithDifferentLabelsBelongToDifferentSurfaces) {
  const WholeMesh mesh = whole_grid(box_grid({4, 2, 2}, {0, 0, 0}, {4, 2, 2}));
  InputCells full = input_cells(Comm::self(), mesh);
  ExteriorOptions options;
  options.label = [&](LocalId cell, int) { return full.cells.corners(cell)[0].x < 2 ? 1 : 0; };
  find_exterior(Comm::self(), full.cells, face_neighbours(full.cells), {}, options);
  EXPECT_EQ(surfaces(full.cells), 6U + 4U);
  for (LocalId n = 0; n < full.cells.nodes(); ++n)
    if (full.cells.position[at(n)] == Vec3{2, 1, 0}) EXPECT_EQ(kind_of(full.cells, n), kLine);
}

TEST(FindExterior, BlocksThatStayHoldTheirNodes) {
  const WholeMesh mesh = generated("nested", {"--n", "1"});
  const HexMesh cells = with_exterior(mesh, {}, {1});  // the upper part, inside the tube
  InputCells full = input_cells(Comm::self(), mesh);
  std::set<LocalId> of_kept;
  for (LocalId c = 0; c < cells.size(); ++c)
    if (full.block[at(c)] == 1) of_kept.insert(cells.hexes[at(c)].begin(), cells.hexes[at(c)].end());
  for (LocalId n = 0; n < cells.nodes(); ++n)
    if (of_kept.contains(n)) EXPECT_EQ(kind_of(cells, n), kPoint);
  std::size_t towards_kept = 0;
  for (const ExteriorFace& f : cells.exterior.faces) {
    EXPECT_NE(full.block[at(f.hex)], 1) << "the faces are those of the others";
    const Facet& facet = cells.exterior.facets[at(f.facet)];
    const auto nodes = face_nodes(cells, {f.hex, f.face});
    const bool kept = std::all_of(nodes.begin(), nodes.end(), [&](LocalId n) { return of_kept.contains(n); });
    EXPECT_EQ(facet.kept, kept);
    EXPECT_EQ(facet.whole, kept);
    EXPECT_EQ(facet.cell, cells.hex_id[at(f.hex)]);
    EXPECT_EQ(facet.face, f.face);
    towards_kept += kept;
  }
  EXPECT_GT(towards_kept, 0U);
}

TEST(HoldInside, KeepsFacesBetweenCellsInTheirPlane) {
  HexMesh cells = with_exterior(whole_grid(box_grid({4, 4, 4}, {0, 0, 0}, {4, 4, 4})));
  for (LocalId c = 0; c < cells.size(); ++c) {
    const HexCorners p = cells.corners(c);
    cells.material[at(c)] = p[0].x < 2 ? 0 : p[0].y < 2 ? 1 : 2;
  }
  const std::vector<LocalId> before = cells.exterior.hold_of;
  const std::size_t faces = cells.exterior.faces.size();
  hold_inside(Comm::self(), cells, face_neighbours(cells), false, [&](LocalId a, LocalId b) {
    return cells.material[at(a)] != cells.material[at(b)] &&
           cells.material[at(a)] + cells.material[at(b)] < 3;
  });  // 0-1 and 0-2, not 1-2
  EXPECT_EQ(cells.exterior.faces.size(), faces) << "the exterior is what it was";
  EXPECT_EQ(surfaces(cells), 6U) << "the faces inside have none";
  for (LocalId n = 0; n < cells.nodes(); ++n) {
    const Vec3& p = cells.position[at(n)];
    if (p.x != 2) {
      EXPECT_EQ(cells.exterior.hold_of[at(n)], before[at(n)]);
      continue;
    }
    const int outer = (p.y == 0 || p.y == 4) + (p.z == 0 || p.z == 4);
    // Between 0-1 and 0-2 the plane goes on, but what is beyond differs.
    const int lines = outer + (p.y == 2);
    EXPECT_EQ(kind_of(cells, n), lines == 0   ? kSurface
                                 : lines == 1 ? kLine
                                              : kPoint)
        << p.x << " " << p.y << " " << p.z;
    if (lines == 0) EXPECT_EQ(held(cells, n, p, {0.5, 0.25, 0.125}), (Vec3{0, 0.25, 0.125}));
  }
}

Interfaces interfaces_of(HexMesh& cells, const std::function<bool(const Vec3&)>& second) {
  for (LocalId c = 0; c < cells.size(); ++c) {
    Vec3 middle;
    for (const Vec3& p : cells.corners(c)) middle += 0.125 * p;
    cells.material[at(c)] = second(middle);
  }
  return trace_interfaces(cells, face_neighbours(cells));
}

TEST(KeepWhole, CurvedSurfacesThatInterfacesMeet) {
  for (const bool slides : {false, true}) {
    ExteriorOptions options;
    options.slides = slides;
    HexMesh cells = with_exterior(generated("cylinder", {"--n", "4", "--layers", "4"}), options);
    Interfaces faces = interfaces_of(cells, [](const Vec3& p) { return norm(p - Vec3{0, 0, 5}) < 2; });
    keep_whole(Comm::self(), cells.exterior, cells, faces);
    for (const Facet& f : cells.exterior.facets) EXPECT_EQ(f.whole, 0) << "a ball inside meets none";
    faces = interfaces_of(cells, [](const Vec3& p) { return p.x > 0; });
    keep_whole(Comm::self(), cells.exterior, cells, faces);
    for (const Facet& f : cells.exterior.facets) {
      const bool wall = std::fabs(facet_normal(f).z) < 0.5;
      EXPECT_EQ(f.whole, wall && !slides);
    }
  }
}

TEST(KeepWhole, SurfacesWithAnInterfaceAlongTheirEdge) {
  const WholeMesh mesh = generated("sphere-in-cube", {"--n", "3", "--inside", "1", "--outside", "1"});
  InputCells full = input_cells(Comm::self(), mesh);
  HexMesh cells = std::move(full.cells);
  find_exterior(Comm::self(), cells, face_neighbours(cells), {}, {});
  EXPECT_EQ(surfaces(cells), 6U);
  for (std::size_t c = 0; c < cells.hexes.size(); ++c) cells.material[c] = full.block[c] == 2;  // towards +x
  const Interfaces faces = trace_interfaces(cells, face_neighbours(cells));
  keep_whole(Comm::self(), cells.exterior, cells, faces);
  for (const Facet& f : cells.exterior.facets)
    EXPECT_EQ(f.whole, facet_normal(f).x > -0.5) << "all but the opposite one have an edge with +x";
}

}  // namespace
}  // namespace sculpt::test
