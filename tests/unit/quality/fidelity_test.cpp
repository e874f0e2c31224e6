#include "sculpt/quality/fidelity.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/stages.hpp"

namespace sculpt {
namespace {

HexMesh cells_of(const test::Case& input) { return test::overlay(input).cells; }

TEST(MeasureKink, OfAPlaneIsNought) {
  const Kink kink = measure_kink(
      Comm::self(), cells_of(test::voxels("plane", {2, 3, 4}, 2,
                                          [](const Index3& c) { return static_cast<std::int32_t>(c[0]); })));
  EXPECT_EQ(kink.quads, 12);
  EXPECT_EQ(kink.edges, 2 * 4 + 3 * 3);
  EXPECT_NEAR(kink.mean, 0, 1e-7);
}

// One cell in the corner of the box: three quads, three edges of 90 degrees.
TEST(MeasureKink, OfACornerByHand) {
  HexMesh mesh = cells_of(test::voxels({2, 2, 2}, {1, 0, 0, 0, 0, 0, 0, 0}));
  Kink kink = measure_kink(Comm::self(), mesh);
  EXPECT_EQ(kink.quads, 3);
  EXPECT_EQ(kink.edges, 3);
  EXPECT_NEAR(kink.mean, 90, 1e-6);
  // With the corner node pulled inwards, each normal is that of the diagonals of its quad.
  mesh.position[13] = {1.0 / 3, 1.0 / 3, 1.0 / 3};
  kink = measure_kink(Comm::self(), mesh);
  const Vec3 n = unit(cross(mesh.position[13] - Vec3{1, 0, 0}, Vec3{1, 0, 1} - Vec3{1, 1, 0})),
             m = unit(cross(mesh.position[13] - Vec3{0, 1, 0}, Vec3{1, 1, 0} - Vec3{0, 1, 1}));
  EXPECT_NEAR(kink.mean, std::acos(std::fabs(dot(n, m))) * 180 / std::acos(-1.0), 1e-6);
}

// The middle of a plane pushed out until both halves stand at 60 degrees to it.
TEST(MeasureKink, OfASharpFoldIsTheFullAngle) {
  HexMesh mesh = cells_of(test::voxels({2, 2, 1}, {0, 1, 0, 1}));
  for (Vec3& p : mesh.position)
    if (p.x == 1 && p.y == 1) p.x += std::sqrt(3.0);
  const Kink kink = measure_kink(Comm::self(), mesh);
  EXPECT_EQ(kink.edges, 1);
  EXPECT_NEAR(kink.mean, 120, 1e-6);
}

// Edges where three materials meet do not count.
TEST(MeasureKink, LeavesOutEdgesOfSeveralInterfaces) {
  const Kink kink = measure_kink(Comm::self(), cells_of(test::voxels({2, 2, 1}, {0, 1, 2, 2})));
  EXPECT_EQ(kink.quads, 3);
  EXPECT_EQ(kink.edges, 0);
  EXPECT_EQ(kink.mean, 0);
}

TEST(Displacement, InCellsByHand) {
  test::Case input = test::voxels({2, 1, 1}, {0, 1});
  input.grid = uniform_grid(input.grid.cells, {0, 0, 0}, {2, 4, 1});
  HexMesh mesh = cells_of(input);
  InterfaceTrack track;  // the four nodes at x = 2; a fifth is not part of the mesh
  for (const LocalId n : {1, 4, 7, 10}) {
    track.node.push_back(mesh.node_id[at(n)]);
    track.contoured.push_back(mesh.position[at(n)]);
    track.smoothed.push_back(mesh.position[at(n)]);
  }
  track.node.push_back(1000);
  track.contoured.push_back({});
  track.smoothed.push_back({});
  mesh.position[1] += Vec3{0.6, 1.6, 0};  // (0.3, 0.4, 0) cells
  track.smoothed[0] += Vec3{0.6, 0, 0};   // of it 0.4 cells in y beyond the target
  track.contoured[1] += Vec3{0, 0, -0.25};
  const Displacement d = displacement(Comm::self(), mesh, track);
  EXPECT_EQ(d.nodes, 4);
  EXPECT_NEAR(d.largest_from_contour, 0.5, 1e-12);
  EXPECT_NEAR(d.mean_from_contour, (0.5 + 0.25) / 4, 1e-9);
  EXPECT_NEAR(d.largest_from_target, 0.4, 1e-12);
  EXPECT_NEAR(d.mean_from_target, 0.1, 1e-9);
  EXPECT_EQ(displacement(Comm::self(), mesh, {}).nodes, 0);
}

TEST(Volumes, OfTheInputByItsFractions) {
  const test::Case input = test::half_space({4, 4, 4}, {0.6, 0.64, 0.48}, 3.3);
  const test::Overlay o = test::overlay(input);
  const std::vector<double> volume = input_volumes(Comm::self(), o.cells, o.fractions, 2);
  double second = 0;
  for (LocalId c = 0; c < o.cells.size(); ++c)
    for (auto e = o.fractions.offset[at(c)]; e < o.fractions.offset[at(c) + 1]; ++e)
      if (o.fractions.material[static_cast<std::size_t>(e)] == 1)
        second += o.fractions.value[static_cast<std::size_t>(e)];
  EXPECT_NEAR(volume[0] + volume[1], 64, 1e-7);
  EXPECT_NEAR(volume[1], second, 1e-7);
  EXPECT_GT(second, 10);
}

TEST(Volumes, MovedByHand) {
  QualitySummary s;
  s.materials = {{8, 1, 1, 50}, {8, 1, 1, 28}};
  // Materials of 55, 25 and 20 cells; the last one lost all its cells, 22 cells are not meshed.
  const std::vector<double> input{55, 25, 20};
  EXPECT_NEAR(volume_moved(s, input, 2), 0.5 * (5 + 3 + 2), 1e-12) << "material 2 is not meshed on purpose";
  EXPECT_NEAR(volume_moved(s, input, std::nullopt), 0.5 * (5 + 3 + 20 + 22), 1e-12);
  EXPECT_EQ(volume_moved({}, {}, std::nullopt), 0);
}

}  // namespace
}  // namespace sculpt
