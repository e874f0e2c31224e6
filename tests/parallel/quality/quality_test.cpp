// What is told about a mesh does not depend on the number of ranks, to the last bit.
#include <gtest/gtest.h>

#include "sculpt/mesh/edit.hpp"
#include "sculpt/quality/fidelity.hpp"
#include "support/mesh_checks.hpp"
#include "support/stages.hpp"

namespace sculpt::test {
namespace {

void expect_equal(const std::vector<ListedHex>& a, const std::vector<ListedHex>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].hex, b[i].hex);
    EXPECT_EQ(a[i].element, b[i].element);
    EXPECT_EQ(a[i].material, b[i].material);
    EXPECT_EQ(a[i].scaled_jacobian, b[i].scaled_jacobian);
    EXPECT_EQ(a[i].corner, b[i].corner);
    EXPECT_EQ(a[i].least_determinant, b[i].least_determinant);
    EXPECT_EQ(a[i].shortest_edge, b[i].shortest_edge);
    EXPECT_EQ(a[i].centre, b[i].centre);
    EXPECT_EQ(a[i].valid, b[i].valid);
  }
}

void expect_equal(const QualitySummary& a, const QualitySummary& b) {
  EXPECT_EQ(a.hexes, b.hexes);
  EXPECT_EQ(a.below_03, b.below_03);
  EXPECT_EQ(a.below_05, b.below_05);
  EXPECT_EQ(a.not_positive_inside, b.not_positive_inside);
  EXPECT_EQ(a.histogram, b.histogram);
  EXPECT_EQ(a.least, b.least);
  EXPECT_EQ(a.average, b.average);
  EXPECT_EQ(a.shortest_edge, b.shortest_edge);
  EXPECT_EQ(a.shortest_edge_cells, b.shortest_edge_cells);
  ASSERT_EQ(a.materials.size(), b.materials.size());
  for (std::size_t m = 0; m < a.materials.size(); ++m) {
    EXPECT_EQ(a.materials[m].hexes, b.materials[m].hexes);
    EXPECT_EQ(a.materials[m].least, b.materials[m].least);
    EXPECT_EQ(a.materials[m].mean, b.materials[m].mean);
    EXPECT_EQ(a.materials[m].volume, b.materials[m].volume);
  }
  expect_equal(a.worst, b.worst);
  expect_equal(a.invalid, b.invalid);
}

void expect_same_report(const HexMesh& together, const HexMesh& alone) {
  const Comm world = Comm::world();
  expect_equal(summarise(world, together), summarise(Comm::self(), alone));
  const Kink a = measure_kink(world, together), b = measure_kink(Comm::self(), alone);
  EXPECT_EQ(a.quads, b.quads);
  EXPECT_EQ(a.edges, b.edges);
  EXPECT_EQ(a.mean, b.mean);
}

// The owned nodes of a mesh, displaced by known amounts.
InterfaceTrack made_up_track(const HexMesh& mesh, const Comm& comm) {
  InterfaceTrack track;
  for (std::size_t n = 0; n < mesh.position.size(); ++n) {
    if (mesh.node_owner[n] != comm.rank()) continue;
    const double d = scatter_unit(4, static_cast<std::uint64_t>(mesh.node_id[n]));
    track.node.push_back(mesh.node_id[n]);
    track.contoured.push_back(mesh.position[n] + Vec3{d, 0, 0});
    track.smoothed.push_back(mesh.position[n] + Vec3{0, d * d, 0.1});
  }
  return track;
}

TEST(Report, IsTheSameAloneAndTogether) {
  const Comm world = Comm::world();
  StageOptions without_void;
  without_void.void_material = 0;
  for (const auto& [input, options] : {std::pair(grains({9, 10, 8}, 14, 6, 4), StageOptions{}),
                                       std::pair(noise({3, 5, 4}, 3, 1), StageOptions{}),
                                       std::pair(grains({8, 8, 8}, 9, 4, 6), without_void)}) {
    const HexMesh together = run_stages(world, input, options).mesh,
                  alone = run_stages(Comm::self(), input, options).mesh;
    expect_same_report(together, alone);
    EXPECT_GT(measure_kink(Comm::self(), alone).edges, 0) << input.name;
    const Displacement a = displacement(world, together, made_up_track(together, world)),
                       b = displacement(Comm::self(), alone, made_up_track(alone, Comm::self()));
    EXPECT_EQ(a.nodes, alone.nodes());
    EXPECT_EQ(a.nodes, b.nodes);
    EXPECT_EQ(a.mean_from_contour, b.mean_from_contour);
    EXPECT_EQ(a.mean_from_target, b.mean_from_target);
    EXPECT_EQ(a.largest_from_contour, b.largest_from_contour);
    EXPECT_EQ(a.largest_from_target, b.largest_from_target);
  }
}

// Folded hexes on many ranks.
TEST(Report, OfABadMeshIsTheSameAloneAndTogether) {
  const Case input = noise({6, 7, 6}, 3, 2);
  const auto spoilt = [&](const Comm& comm) {
    HexMesh mesh = overlay(comm, input).cells;
    for (std::size_t n = 0; n < mesh.position.size(); ++n)
      for (std::size_t d = 0; d < 3; ++d)
        mesh.position[n][d] +=
            1.2 * (scatter_unit(7, 3 * static_cast<std::uint64_t>(mesh.node_id[n]) + d) - 0.5);
    return mesh;
  };
  expect_same_report(spoilt(Comm::world()), spoilt(Comm::self()));
  EXPECT_GT(summarise(Comm::self(), spoilt(Comm::self())).not_positive_inside, 5);
}

TEST(RemoveHexes, IsTheSameAloneAndTogether) {
  const Case input = grains({9, 10, 8}, 14, 6, 4);
  const auto thinned = [&](const Comm& comm) {
    HexMesh mesh = run_stages(comm, input).mesh;
    std::vector<std::uint8_t> remove;
    for (const double q : scaled_jacobians(mesh)) remove.push_back(q < 0.7);
    remove_hexes(comm, mesh, remove);
    return mesh;
  };
  const Comm world = Comm::world();
  const HexMesh together = thinned(world), alone = thinned(Comm::self());
  EXPECT_EQ(checksum(world, together), checksum(Comm::self(), alone));
  EXPECT_EQ(world.sum(owned_hexes(together)), owned_hexes(alone));
  EXPECT_GT(run_stages(Comm::self(), input).mesh.size(), alone.size());
  EXPECT_GE(least_scaled_jacobian(alone), 0.7 - 1e-14);
  expect_same_report(together, alone);
}

}  // namespace
}  // namespace sculpt::test
