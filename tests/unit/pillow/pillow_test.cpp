#include "sculpt/pillow/pillow.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "sculpt/brep/interfaces.hpp"
#include "sculpt/mesh/adjacency.hpp"
#include "support/mesh_checks.hpp"
#include "support/stages.hpp"

namespace sculpt {
namespace {

Pillowed pillowed(const HexMesh& cells, double offset = 0.3) {
  return pillow(Comm::self(), cells, face_neighbours(cells), cells.material, {},
                {.offset = offset, .with_neighbours = true});
}

Pillowed surface_pillowed(const Pillowed& first) {
  return pillow(Comm::self(), first.mesh, first.neighbours, surface_labels(first.mesh, first.neighbours), {},
                {.offset = 0.5, .along_edges = true, .with_neighbours = true});
}

Pillowed box_pillowed(const Pillowed& first, double offset = 1, std::uint8_t sides = 0x3f) {
  return pillow(Comm::self(), first.mesh, first.neighbours,
                std::vector<std::int32_t>(first.mesh.hexes.size(), 0), {},
                {.offset = offset, .along_edges = true, .box_sides = sides, .with_neighbours = true});
}

std::int64_t quads(const HexMesh& cells) {
  return static_cast<std::int64_t>(trace_interfaces(cells, face_neighbours(cells)).quads.size());
}

TEST(Pillow, OfAPlaneByHand) {
  const test::Overlay o = test::overlay(test::voxels({2, 1, 1}, {0, 1}));
  const Pillowed p = pillowed(o.cells);
  ASSERT_EQ(p.mesh.size(), 4);
  ASSERT_EQ(p.mesh.nodes(), 12 + 8);
  EXPECT_EQ(p.mesh.hex_id, (std::vector<GlobalId>{0, 2, 8, 12})) << "8 h and 8 h + face + 1";
  EXPECT_EQ(p.mesh.material, (std::vector<std::int32_t>{0, 0, 1, 1}));
  EXPECT_EQ(std::count(p.copied.begin(), p.copied.end(), 1), 8);
  for (std::size_t n = 0; n < p.source.size(); ++n) {
    const auto source = static_cast<std::size_t>(p.source[n]);
    EXPECT_EQ(p.mesh.node_id[n] / 64, o.cells.node_id[source]);
    if (!p.copied[n]) {
      EXPECT_EQ(p.mesh.position[n], o.cells.position[source]) << "old nodes stay";
      EXPECT_EQ(p.mesh.node_id[n] % 64, 0);
    } else {  // a copy has gone 0.3 of the way from the interface to the middle of its cell, along the box
      const double x = p.mesh.position[n].x;
      EXPECT_TRUE(std::fabs(x - 0.85) < 1e-15 || std::fabs(x - 1.15) < 1e-15) << x;
    }
  }
  EXPECT_NEAR(hex_volume(p.mesh.corners(0)), 0.85, 1e-14);
  EXPECT_NEAR(hex_volume(p.mesh.corners(1)), 0.15, 1e-14);
  EXPECT_EQ(test::conformity_problem(p.mesh), "");
  EXPECT_EQ(test::boundary_problem(p.mesh), "");
}

TEST(Pillow, OfAnIsolatedCellByHand) {
  const test::Overlay o = test::overlay(test::voxels("cell", {3, 3, 3}, 2, [](const Index3& c) {
    return c == Index3{1, 1, 1} ? 1 : 0;
  }));
  const Pillowed p = pillowed(o.cells);
  EXPECT_EQ(p.mesh.size(), 27 + 12);
  EXPECT_EQ(p.mesh.nodes(), 64 + 16);
  const std::vector<double> volumes = test::volumes(p.mesh, 2);
  EXPECT_NEAR(volumes[0], 26, 1e-12);
  EXPECT_NEAR(volumes[1], 1, 1e-12);
}

TEST(Pillow, WithoutInterfacesChangesNothingButIds) {
  const test::Overlay o = test::overlay(test::voxels({3, 2, 2}, std::vector<std::int32_t>(12, 0)));
  const Pillowed p = pillowed(o.cells);
  EXPECT_EQ(p.mesh.position, o.cells.position);
  EXPECT_EQ(p.mesh.hexes, o.cells.hexes);
}

void expect_pillowed_well(const test::Case& input) {
  const test::Overlay o = test::filtered(input);
  const std::int64_t faces = quads(o.cells);
  const Pillowed p = pillowed(o.cells);
  EXPECT_EQ(p.mesh.size(), o.cells.size() + 2 * faces) << input.name;
  EXPECT_EQ(test::interface_faces(p.mesh), faces) << input.name;
  EXPECT_EQ(test::conformity_problem(p.mesh), "") << input.name;
  EXPECT_EQ(p.neighbours, face_neighbours(p.mesh)) << input.name;
  EXPECT_TRUE(p.on_interface.empty()) << input.name;
  EXPECT_EQ(test::boundary_problem(p.mesh), "") << input.name;
  EXPECT_EQ(test::box_problem(p.mesh, input.grid), "") << input.name;
  EXPECT_NEAR(test::volume(p.mesh) / test::volume(input.grid), 1, 1e-12) << input.name;
  const std::vector<double> before = test::volumes(o.cells, input.materials),
                            after = test::volumes(p.mesh, input.materials);
  for (std::size_t m = 0; m < before.size(); ++m)
    EXPECT_NEAR(after[m], before[m], 1e-9) << input.name << ", material " << m;

  const Pillowed flat = pillowed(o.cells, 0);  // buffer hexes without thickness, the others as they were
  double volume = 0;
  for (LocalId h = 0; h < flat.mesh.size(); ++h) {
    const double v = hex_volume(flat.mesh.corners(h));
    const bool cell = flat.mesh.hex_id[static_cast<std::size_t>(h)] % 8 == 0;
    EXPECT_NEAR(v,
                cell ? hex_volume(o.cells.corners(
                           static_cast<LocalId>(flat.mesh.hex_id[static_cast<std::size_t>(h)] / 8)))
                     : 0,
                1e-14);
    volume += v;
  }
  EXPECT_NEAR(volume / test::volume(input.grid), 1, 1e-12) << input.name;
}

TEST(Pillow, KeepsAnyMeshConforming) {
  expect_pillowed_well(test::ball({8, 8, 8}, {4, 4, 4}, 2.6));
  expect_pillowed_well(test::noise({7, 6, 5}, 2, 1));
  expect_pillowed_well(test::noise({6, 6, 6}, 9, 2));
  expect_pillowed_well(test::noise({9, 9, 1}, 3, 3));
  expect_pillowed_well(test::grains({10, 9, 8}, 15, 15, 4));
  expect_pillowed_well(test::voxels({5, 1, 1}, {0, 1, 2, 1, 0}));
}

TEST(Pillow, GivesANodeOneCopyPerSideOfTheInterface) {
  // Eight materials at one node: one copy each.
  const test::Overlay o = test::overlay(test::voxels({2, 2, 2}, {0, 1, 2, 3, 4, 5, 6, 7}));
  const Pillowed p = pillowed(o.cells);
  std::map<GlobalId, int> copies;
  for (const GlobalId id : p.mesh.node_id) ++copies[id / 64];
  EXPECT_EQ(copies[13], 9) << "the middle node and a copy for every material";
  EXPECT_EQ(copies[0], 1) << "a corner of the box is no part of an interface";
  EXPECT_EQ(copies[1], 3) << "in the middle of an edge of the box";
  EXPECT_EQ(p.mesh.size(), 8 + 2 * 12);
  EXPECT_EQ(test::conformity_problem(p.mesh), "");
}

TEST(Pillow, WithoutTheVoidHasOneLayerAtItsSurface) {
  const test::Case input = test::ball({8, 8, 8}, {4, 4, 4}, 2.6);
  const test::Overlay o = test::filtered(input);
  std::vector<std::uint8_t> drop(o.cells.hexes.size());
  std::vector<std::int32_t> label = o.cells.material;
  std::int64_t kept = 0;
  for (std::size_t c = 0; c < drop.size(); ++c) {
    drop[c] = o.cells.material[c] == 0;
    if (drop[c])
      label[c] = -1;
    else
      ++kept;
  }
  const Pillowed p =
      pillow(Comm::self(), o.cells, face_neighbours(o.cells), label, drop, {.with_neighbours = true});
  EXPECT_EQ(p.mesh.size(), kept + quads(o.cells));
  EXPECT_EQ(p.neighbours, face_neighbours(p.mesh));
  EXPECT_EQ(test::conformity_problem(p.mesh), "");
  EXPECT_TRUE(
      std::all_of(p.mesh.material.begin(), p.mesh.material.end(), [](std::int32_t m) { return m == 1; }));
  EXPECT_NEAR(test::volume(p.mesh), static_cast<double>(kept), 1e-10);
}

TEST(SurfacePillow, AddsASecondLayerAtEveryInterface) {
  for (const test::Case& input : {test::ball({8, 8, 8}, {4, 4, 4}, 2.6), test::grains({8, 8, 8}, 8, 8, 1)}) {
    const test::Overlay o = test::filtered(input);
    const std::int64_t faces = quads(o.cells);
    const Pillowed first = pillowed(o.cells);
    const std::vector<std::int32_t> label = surface_labels(first.mesh, first.neighbours);
    EXPECT_EQ(std::count_if(label.begin(), label.end(), [](std::int32_t l) { return l >= 0; }), 2 * faces)
        << input.name;
    const Pillowed second = surface_pillowed(first);
    EXPECT_EQ(second.neighbours, face_neighbours(second.mesh)) << input.name;
    EXPECT_EQ(test::conformity_problem(second.mesh, 2), "") << input.name;
    EXPECT_EQ(test::boundary_problem(second.mesh), "") << input.name;
    EXPECT_EQ(test::box_problem(second.mesh, input.grid), "") << input.name;
    EXPECT_GE(test::interface_faces(second.mesh), test::interface_faces(first.mesh))
        << "curves gain a strip: " << input.name;
    EXPECT_GE(second.mesh.size(), first.mesh.size() + 2 * faces)
        << "every hex of a sheet has a face towards its cell";
    EXPECT_NEAR(test::volume(second.mesh) / test::volume(input.grid), 1, 1e-12) << input.name;
  }
}

TEST(SurfaceLabels, NameTheSurfaceOnBothSidesAlike) {
  const test::Overlay o = test::overlay(test::voxels({3, 1, 1}, {0, 1, 2}));
  const Pillowed p = pillowed(o.cells);
  ASSERT_EQ(p.mesh.size(), 3 + 4);
  std::map<std::int32_t, int> count;
  for (const std::int32_t l : surface_labels(p.mesh, p.neighbours)) ++count[l];
  EXPECT_EQ(count[-1], 3) << "the cells themselves";
  ASSERT_EQ(count.size(), 3U) << "0 to 1 and 1 to 2";
  EXPECT_EQ(count.rbegin()->second, 2);
}

// Materials 0 (x < 2), 1 (y < 2) and 2 meet along the line x = y = 2.
test::Overlay triple_line() {
  const auto material = [](const Index3& c) { return c[0] < 2 ? 0 : c[1] < 2 ? 1 : 2; };
  return test::overlay(Comm::self(), test::voxels("triple line", {4, 4, 4}, 3, material), 3);
}

constexpr double kAll = 2;  // a threshold that no hex reaches

TEST(CurvePillow, OfAStraightTripleLineByHand) {
  const test::Overlay o = triple_line();
  const Pillowed first = pillowed(o.cells);
  ASSERT_EQ(first.mesh.size(), 64 + 2 * 24);
  const std::vector<std::uint8_t> anywhere(first.mesh.position.size(), 1);
  const CurveSet set = poor_curves(Comm::self(), first.mesh, anywhere, kAll, 1);
  EXPECT_EQ(set.poor, 4 * 6) << "two buffer hexes of each material at each of four edges";
  EXPECT_EQ(set.wrapped, 4 * 6);
  const Pillowed p = pillow(Comm::self(), first.mesh, first.neighbours, set.label, {},
                            {.along_edges = true, .with_neighbours = true});
  EXPECT_EQ(p.mesh.size(), first.mesh.size() + 2 * set.wrapped) << "below each hex and at its far side";
  EXPECT_EQ(p.mesh.nodes(), first.mesh.nodes() + 5 * 12) << "a ring of twelve nodes on five levels";
  ASSERT_EQ(p.on_interface.size(), 5U * 3) << "where the ring crosses the three interfaces";
  for (const InterfaceCopy& copy : p.on_interface) {
    const Vec3 x = p.mesh.position[at(copy.node)];
    EXPECT_FALSE(copy.on_curve);
    if (std::fabs(x.x - 2) < 1e-14) {  // 0.3 of the way from y = 1 or 3 to the middle of the quads
      EXPECT_NEAR(std::fabs(x.y - 2), 0.85, 1e-14);
      EXPECT_NEAR(std::fabs(copy.direction.x), 1, 1e-14);
    } else {
      EXPECT_NEAR(x.x, 2.85, 1e-14);
      EXPECT_NEAR(x.y, 2, 1e-14);
      EXPECT_NEAR(std::fabs(copy.direction.y), 1, 1e-14);
    }
  }
  EXPECT_EQ(test::conformity_problem(p.mesh, 2), "");
  EXPECT_EQ(test::boundary_problem(p.mesh), "");
  EXPECT_EQ(p.neighbours, face_neighbours(p.mesh));
  const std::vector<double> volumes = test::volumes(p.mesh, 3);
  EXPECT_NEAR(volumes[0], 32, 1e-12);
  EXPECT_NEAR(volumes[1], 16, 1e-12);
  EXPECT_NEAR(volumes[2], 16, 1e-12);
  EXPECT_GT(test::least_scaled_jacobian(p.mesh), 0);
}

TEST(CurvePillow, EndsAcrossItsCurve) {
  const test::Overlay o = triple_line();
  const Pillowed first = pillowed(o.cells);
  std::vector<std::uint8_t> low(first.mesh.position.size());
  for (std::size_t n = 0; n < low.size(); ++n) low[n] = first.mesh.position[n].z < 2.5;
  const CurveSet set = poor_curves(Comm::self(), first.mesh, low, kAll, 1);
  EXPECT_EQ(set.poor, 2 * 6) << "two edges end at nodes that may be on curves";
  EXPECT_EQ(set.wrapped, 3 * 6) << "everything at their nodes";
  const Pillowed p = pillow(Comm::self(), first.mesh, first.neighbours, set.label, {}, {.along_edges = true});
  EXPECT_EQ(p.mesh.size(), first.mesh.size() + 2 * set.wrapped + 6) << "a lid of six hexes";
  EXPECT_EQ(p.mesh.nodes(), first.mesh.nodes() + 4 * 12 + 1);
  const auto on_curve = [](const InterfaceCopy& copy) { return copy.on_curve; };
  ASSERT_EQ(std::count_if(p.on_interface.begin(), p.on_interface.end(), on_curve), 1);
  const InterfaceCopy& end = *std::find_if(p.on_interface.begin(), p.on_interface.end(), on_curve);
  EXPECT_NEAR(norm(p.mesh.position[at(end.node)] - Vec3{2, 2, 3 - 0.15}), 0, 1e-14);
  EXPECT_NEAR(std::fabs(end.direction.z), 1, 1e-14);
  EXPECT_EQ(p.on_interface.size(), 4U * 3 + 1);
  EXPECT_EQ(test::conformity_problem(p.mesh, 2), "");
  EXPECT_GT(test::least_scaled_jacobian(p.mesh), 0);
}

TEST(CurvePillow, WithEnoughLayersWrapsEverything) {
  const test::Overlay o = triple_line();
  const Pillowed first = pillowed(o.cells);
  const std::vector<std::uint8_t> anywhere(first.mesh.position.size(), 1);
  const CurveSet set = poor_curves(Comm::self(), first.mesh, anywhere, kAll, 9);
  EXPECT_EQ(set.wrapped, first.mesh.size());
  EXPECT_EQ(
      pillow(Comm::self(), first.mesh, first.neighbours, set.label, {}, {.along_edges = true}).mesh.size(),
      first.mesh.size());
}

TEST(PoorCurves, AreThoseBelowTheThresholdInside) {
  const test::Overlay o = triple_line();
  const Pillowed first = pillowed(o.cells);
  const std::vector<std::uint8_t> anywhere(first.mesh.position.size(), 1);
  const CurveSet none = poor_curves(Comm::self(), first.mesh, anywhere, 0.1, 3);
  EXPECT_EQ(none.poor, 0);
  EXPECT_TRUE(none.label.empty());
  // Where one interface meets the box no three materials meet.
  const test::Overlay plane = test::overlay(test::voxels({2, 1, 1}, {0, 1}));
  const Pillowed flat = pillowed(plane.cells);
  EXPECT_EQ(
      poor_curves(Comm::self(), flat.mesh, std::vector<std::uint8_t>(flat.mesh.position.size(), 1), kAll, 1)
          .poor,
      0);
}

// What is not meshed counts as a material.
TEST(PoorCurves, RunWhereTwoMaterialsEndAtTheUnmeshed) {
  const test::Overlay o = triple_line();
  std::vector<std::int32_t> label = o.cells.material;
  std::vector<std::uint8_t> drop(label.size());
  for (std::size_t c = 0; c < label.size(); ++c)
    if ((drop[c] = label[c] == 2)) label[c] = -1;
  const Pillowed first =
      pillow(Comm::self(), o.cells, face_neighbours(o.cells), label, drop, {.with_neighbours = true});
  const std::vector<std::uint8_t> anywhere(first.mesh.position.size(), 1);
  const CurveSet set = poor_curves(Comm::self(), first.mesh, anywhere, kAll, 1);
  EXPECT_EQ(set.poor, 4 * 4);
  const Pillowed p = pillow(Comm::self(), first.mesh, first.neighbours, set.label, {},
                            {.along_edges = true, .with_neighbours = true});
  EXPECT_EQ(p.mesh.size(), first.mesh.size() + 2 * set.wrapped);
  EXPECT_EQ(p.on_interface.size(), 5U * 3) << "two of the three rings of nodes are on the free surface";
  EXPECT_EQ(test::conformity_problem(p.mesh, 2), "");
  EXPECT_NEAR(test::volume(p.mesh), 48, 1e-12);
}

TEST(BoundaryPillow, OfACubeByHand) {
  const test::Case input = test::voxels({3, 3, 3}, std::vector<std::int32_t>(27, 0));
  const Pillowed p = box_pillowed(pillowed(test::overlay(input).cells));
  EXPECT_EQ(p.mesh.size(), 27 + 54) << "three layers meet at the edges and corners of the box";
  EXPECT_EQ(p.mesh.nodes(), 64 + 56);
  for (const Vec3& x : p.mesh.position)
    for (std::size_t d = 0; d < 3; ++d)
      EXPECT_TRUE(x[d] == 0 || x[d] == 0.5 || x[d] == 1 || x[d] == 2 || x[d] == 2.5 || x[d] == 3) << x[d];
  EXPECT_EQ(test::conformity_problem(p.mesh, 2, 1), "");
  EXPECT_EQ(test::boundary_problem(p.mesh), "");
  EXPECT_EQ(test::box_problem(p.mesh, input.grid), "");
  EXPECT_EQ(p.neighbours, face_neighbours(p.mesh));
  EXPECT_NEAR(test::volume(p.mesh), 27, 1e-12);
  EXPECT_NEAR(test::least_scaled_jacobian(p.mesh), 1 / std::sqrt(3.0), 1e-12) << "at the corners of the box";
}

TEST(BoundaryPillow, LetsInterfacesThrough) {
  const test::Case input =
      test::voxels("plane", {3, 3, 3}, 2, [](const Index3& c) { return c[0] < 1 ? 0 : 1; });
  const Pillowed first = pillowed(test::overlay(Comm::self(), input, 3).cells);
  ASSERT_EQ(first.mesh.size(), 27 + 2 * 9);
  const Pillowed p = box_pillowed(first);
  EXPECT_EQ(p.mesh.size(), first.mesh.size() + 54 + 2 * 12) << "twelve quads of the interface end at the box";
  ASSERT_EQ(p.on_interface.size(), 12U);
  for (const InterfaceCopy& copy : p.on_interface) {
    EXPECT_EQ(p.mesh.position[at(copy.node)].x, 1);
    EXPECT_EQ(p.mesh.box_sides[at(copy.node)], 0);
    EXPECT_NEAR(copy.direction.x, 1, 1e-14);
  }
  EXPECT_EQ(test::interface_faces(p.mesh), 9 + 12);
  EXPECT_EQ(test::conformity_problem(p.mesh, 2, 1), "");
  EXPECT_EQ(test::box_problem(p.mesh, input.grid), "");
  const std::vector<double> volumes = test::volumes(p.mesh, 2);
  EXPECT_NEAR(volumes[0], 9, 1e-12);
  EXPECT_NEAR(volumes[1], 18, 1e-12);
  EXPECT_GT(test::least_scaled_jacobian(p.mesh), 0);
}

TEST(BoundaryPillow, OfOneSideEndsAtTheOthers) {
  const test::Case input = test::voxels({3, 3, 3}, std::vector<std::int32_t>(27, 0));
  const Pillowed p = box_pillowed(pillowed(test::overlay(input).cells), 1, kZmin);
  EXPECT_EQ(p.mesh.size(), 27 + 9);
  EXPECT_EQ(p.mesh.nodes(), 64 + 16);
  EXPECT_EQ(test::conformity_problem(p.mesh, 2, 1), "");
  EXPECT_EQ(test::box_problem(p.mesh, input.grid), "");
  EXPECT_NEAR(test::least_scaled_jacobian(p.mesh), 1, 1e-14);
}

TEST(FlatHexes, HaveTwoFacesOnOneSideOfTheBox) {
  HexMesh mesh = test::overlay(test::voxels({2, 1, 1}, {0, 0})).cells;
  EXPECT_EQ(sides_with_flat_hexes(Comm::self(), mesh), 0);
  for (const int c : kFaces[4])  // as if the bottom of the first hex had been bent onto ymin
    mesh.box_sides[at(mesh.hexes[0][static_cast<std::size_t>(c)])] |= kYmin;
  EXPECT_EQ(sides_with_flat_hexes(Comm::self(), mesh), kYmin);
}

// Pairs of materials that share a face; -1 stands for what is not meshed.
std::set<std::pair<std::int32_t, std::int32_t>> touching(const HexMesh& mesh) {
  std::set<std::pair<std::int32_t, std::int32_t>> pairs;
  const FaceNeighbours neighbours = face_neighbours_of_any(mesh);
  for (LocalId h = 0; h < mesh.size(); ++h)
    for (int f = 0; f < 6; ++f) {
      const LocalId other = neighbours[at(h)][static_cast<std::size_t>(f)];
      if (other == kNone && face_sides(mesh, h, f) != 0) continue;
      const std::int32_t beyond = other == kNone ? -1 : mesh.material[at(other)];
      if (beyond != mesh.material[at(h)]) pairs.insert(std::minmax(mesh.material[at(h)], beyond));
    }
  return pairs;
}

// Two hexes that share two faces, or a hex with two faces on one side of the box: no smoothing helps those.
std::string topology_problem(const HexMesh& mesh) {
  if (sides_with_flat_hexes(Comm::self(), mesh) != 0) return "a hex has two faces on one side of the box";
  for (auto faces : face_neighbours_of_any(mesh)) {
    std::sort(faces.begin(), faces.end());
    for (std::size_t f = 0; f + 1 < 6; ++f)
      if (faces[f] != kNone && faces[f] == faces[f + 1]) return "two hexes share two faces";
  }
  return {};
}

TEST(CurvePillow, IsNeitherPinchedNorChangesWhatTouches) {
  int pillows = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const test::Case input = test::grains({10, 9, 8}, 12, 12, seed);
    const test::Overlay o = test::filtered(Comm::self(), input, 5);
    const int surfaces = seed % 3 == 0, box = seed % 4 == 0;
    Pillowed first = pillowed(o.cells);
    if (surfaces) first = surface_pillowed(first);
    if (box) first = box_pillowed(first);
    const std::vector<std::uint8_t> anywhere(first.mesh.position.size(), 1);
    for (const int layers : {1, 2, 3}) {
      SCOPED_TRACE(fmt::format("seed {}, {} layers", seed, layers));
      const double threshold = seed % 2 ? 0.1 : -0.5;
      const CurveSet set = poor_curves(Comm::self(), first.mesh, anywhere, threshold, layers);
      if (set.poor == 0) continue;
      const Pillowed p = pillow(Comm::self(), first.mesh, first.neighbours, set.label, {},
                                {.along_edges = true, .with_neighbours = true});
      pillows += p.mesh.size() > first.mesh.size();
      EXPECT_EQ(test::conformity_problem(p.mesh, 2 + surfaces + box, box), "");
      EXPECT_EQ(test::boundary_problem(p.mesh), "");
      EXPECT_EQ(p.neighbours, face_neighbours(p.mesh));
      EXPECT_EQ(topology_problem(p.mesh), "");
      EXPECT_EQ(touching(p.mesh), touching(first.mesh));
      EXPECT_NEAR(test::volume(p.mesh) / test::volume(input.grid), 1, 1e-12);
    }
  }
  EXPECT_GE(pillows, 15);
}

}  // namespace
}  // namespace sculpt
