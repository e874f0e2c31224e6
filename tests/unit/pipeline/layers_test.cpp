#include "pipeline/layers.hpp"

#include <gtest/gtest.h>

#include "support/mesh_checks.hpp"
#include "support/stages.hpp"

namespace sculpt {
namespace {

LayerPlan plan_of(int number) {
  Deck deck;
  deck.pillow = number;
  return layer_plan(deck);
}

TEST(LayerPlan, FollowsThePillowNumbers) {
  EXPECT_FALSE(plan_of(0).any());
  EXPECT_TRUE(plan_of(0).smooth_after);
  EXPECT_TRUE(plan_of(1).surfaces);
  EXPECT_FALSE(plan_of(1).curves);
  EXPECT_TRUE(plan_of(2).curves);
  EXPECT_EQ(plan_of(2).curve_layers, 3);
  EXPECT_FALSE(plan_of(2).surfaces);
  EXPECT_TRUE(plan_of(3).boundaries);
  EXPECT_FALSE(plan_of(3).curves);
  EXPECT_TRUE(plan_of(100).surfaces);
  EXPECT_FALSE(plan_of(100).curves);
  EXPECT_FALSE(plan_of(100).smooth_after);
  for (int layers = 2; layers <= 5; ++layers)
    for (const bool smooth : {false, true}) {
      const LayerPlan p = plan_of((smooth ? 210 : 200) + layers);
      EXPECT_TRUE(p.curves);
      EXPECT_FALSE(p.surfaces);
      EXPECT_EQ(p.curve_layers, layers);
      EXPECT_EQ(p.smooth_after, smooth);
    }
}

TEST(LayerPlan, FollowsTheLongOptions) {
  Deck deck;
  deck.pillow_surfaces = deck.pillow_curves = deck.pillow_boundaries = deck.pillow_smooth_off = true;
  deck.pillow_curve_layers = 4;
  deck.pillow_curve_thresh = 0.45;
  deck.pillow_boundary_layers = 2;
  const LayerPlan p = layer_plan(deck);
  EXPECT_TRUE(p.surfaces && p.curves && p.boundaries && !p.smooth_after);
  EXPECT_EQ(p.curve_layers, 4);
  EXPECT_EQ(p.curve_threshold, 0.45);
  EXPECT_EQ(p.boundary_layers, 2);
}

TEST(LayerPlan, NeedsAGhostLayerForEveryPillow) {
  LayerPlan p;
  EXPECT_EQ(p.ghost_layers(), 2);
  p.boundaries = true;  // adds nothing to a grid that is not refined
  EXPECT_EQ(p.ghost_layers(), 2);
  p.refined = true;
  EXPECT_EQ(p.ghost_layers(), 3);
  p.surfaces = p.curves = true;
  p.boundary_layers = 2;
  EXPECT_EQ(p.ghost_layers(), 7);
}

LayeredMesh layered(const test::Case& input, const LayerPlan& plan, std::int32_t left_out = -1) {
  const Comm comm = Comm::self();
  const HexMesh cells = test::filtered(comm, input, plan.ghost_layers()).cells;
  const FaceNeighbours neighbours = face_neighbours(cells);
  const Interfaces faces = trace_interfaces(cells, neighbours);
  std::vector<std::uint8_t> drop(cells.hexes.size());
  for (std::size_t c = 0; c < drop.size(); ++c) drop[c] = cells.material[c] == left_out;
  LayeredMesh m =
      add_layers(comm, cells, neighbours, drop, faces, deviation_weights(cells, faces), plan, Log());
  if (plan.curves) add_curve_layers(comm, m, plan, {}, Log());
  return m;
}

TEST(Layers, AlongTheBoxAreOfEqualThickness) {
  const test::Case input = test::voxels({3, 3, 3}, std::vector<std::int32_t>(27, 0));
  LayerPlan plan;
  plan.boundary_layers = 2;
  const HexMesh mesh = layered(input, plan).mesh;
  EXPECT_EQ(mesh.size(), 27 + 2 * 54);
  EXPECT_EQ(mesh.nodes(), 64 + 2 * 56);
  for (const Vec3& x : mesh.position)
    for (std::size_t d = 0; d < 3; ++d) {
      const double from_box = std::min(x[d], 3 - x[d]);
      EXPECT_NEAR(from_box * 3, std::round(from_box * 3), 1e-14) << "0, 1/3, 2/3 or 1";
    }
  EXPECT_EQ(test::box_problem(mesh, input.grid), "");
  EXPECT_NEAR(test::volume(mesh), 27, 1e-12);
  EXPECT_GT(test::least_scaled_jacobian(mesh), 0.5);
}

// The smoother knows exactly the nodes on interfaces, whichever layers there are.
TEST(Layers, TellTheNodesOfInterfaces) {
  const test::Case input = test::grains({9, 8, 7}, 12, 4, 5);
  LayerPlan surfaces, curves, boundary, all;
  surfaces.surfaces = all.surfaces = curves.curves = all.curves = true;
  boundary.boundary_layers = all.boundary_layers = 2;
  curves.curve_layers = all.curve_layers = 1;
  for (const LayerPlan& plan : {LayerPlan{}, surfaces, curves, boundary, all})
    for (const std::int32_t left_out : {-1, 1}) {
      SCOPED_TRACE(std::to_string(plan.ghost_layers()) + " ghost layers, without " +
                   std::to_string(left_out));
      const LayeredMesh m = layered(input, plan, left_out);
      EXPECT_EQ(m.pillows, 1 + plan.surfaces + plan.curves + plan.boundary_layers);
      std::vector<std::uint8_t> wanted(m.mesh.position.size(), 0), told = wanted;
      const FaceNeighbours neighbours = face_neighbours(m.mesh);
      for (LocalId h = 0; h < m.mesh.size(); ++h)
        for (std::size_t f = 0; f < 6; ++f) {
          const LocalId other = neighbours[at(h)][f];
          if (other == kNone ? face_sides(m.mesh, h, static_cast<int>(f)) != 0
                             : m.mesh.material[at(other)] == m.mesh.material[at(h)])
            continue;
          for (const int c : kFaces[f]) wanted[at(m.mesh.hexes[at(h)][static_cast<std::size_t>(c)])] = 1;
        }
      for (std::size_t n = 0; n < told.size(); ++n) told[n] = m.geometry.index[n] != kNone;
      EXPECT_EQ(told, wanted);
      for (std::size_t n = 0; n < told.size(); ++n)
        if (told[n])
          EXPECT_EQ(m.geometry.target[at(m.geometry.index[n])], m.mesh.position[n]) << "not smoothed yet";
    }
}

TEST(CurveLayers, AreTakenOutWhereTheyDoHarm) {
  const test::Case input = test::grains({8, 8, 8}, 10, 10, 2);
  LayerPlan plan;
  const HexMesh without = layered(input, plan).mesh;
  plan.curves = true;
  plan.curve_layers = 1;
  plan.curve_threshold = 0.5;
  const Comm comm = Comm::self();
  const auto tried = [&](const std::function<void(LayeredMesh&)>& smooth) {
    LayerPlan volume = plan;
    volume.curves = false;
    LayeredMesh m = layered(input, volume);
    add_curve_layers(comm, m, plan, smooth, Log());
    return m;
  };
  const LayeredMesh spoilt =
      tried([](LayeredMesh& m) { std::swap(m.mesh.position[0], m.mesh.position[at(m.mesh.nodes() - 1)]); });
  EXPECT_EQ(spoilt.pillows, 1);
  EXPECT_EQ(spoilt.mesh.position, without.position);
  EXPECT_EQ(spoilt.mesh.hexes, without.hexes);
  const LayeredMesh kept = tried({});
  EXPECT_EQ(kept.pillows, 2) << "not smoothed, so not judged";
  EXPECT_GT(kept.mesh.size(), without.size());
}

}  // namespace
}  // namespace sculpt
