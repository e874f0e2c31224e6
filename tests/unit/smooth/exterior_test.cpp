// Nodes that are held by an exterior, smoothed.
#include <gtest/gtest.h>

#include "sculpt/brep/exterior.hpp"
#include "smooth/node_step.hpp"
#include "support/cases.hpp"
#include "support/input_meshes.hpp"
#include "support/mesh_checks.hpp"

namespace sculpt::test {
namespace {

Geometry no_interface(const HexMesh& mesh) {
  Geometry none;
  none.index.assign(mesh.position.size(), kNone);
  return none;
}

// Nodes are put off their places, but not off what holds them.
HexMesh disturbed(HexMesh mesh, double size) {
  for (LocalId n = 0; n < mesh.nodes(); ++n) {
    Vec3 move;
    for (std::size_t d = 0; d < 3; ++d)
      move[d] = size * (scatter_unit(9, 3 * static_cast<std::uint64_t>(n) + d) - 0.5);
    Vec3& p = mesh.position[at(n)];
    p += held(mesh, n, p, move);
  }
  return mesh;
}
HexMesh with_exterior(const WholeMesh& mesh) {
  HexMesh cells = input_cells(Comm::self(), mesh).cells;
  find_exterior(Comm::self(), cells, face_neighbours(cells), {}, {});
  return cells;
}

TEST(SmoothOnAnExterior, NodesStayOnPlanesAndEdgesExactly) {
  const HexMesh cells = with_exterior(whole_grid(box_grid({4, 4, 4}, {0, 0, 0}, {1, 1, 1})));
  const HexMesh before = disturbed(cells, 0.3);
  const double worst = least_scaled_jacobian(before);
  ASSERT_LT(worst, 0.3);
  HexMesh mesh = before;
  smooth_mesh(mesh, no_interface(mesh), {}, Log());
  EXPECT_GE(least_scaled_jacobian(mesh), 0.3);
  EXPECT_NEAR(volume(mesh), 1, 1e-14);
  int moved = 0;
  for (LocalId n = 0; n < mesh.nodes(); ++n)
    for (std::size_t d = 0; d < 3; ++d) {
      const double was = cells.position[at(n)][d], is = mesh.position[at(n)][d];
      if (was == 0 || was == 1)
        EXPECT_EQ(is, was);
      else if ((mesh.box_sides[at(n)] != 0))
        moved += is != before.position[at(n)][d];
    }
  EXPECT_GT(moved, 0) << "nodes on the boundary take part";
}

TEST(SmoothOnAnExterior, TheShapeOfACylinderIsKept) {
  const HexMesh cells = with_exterior(generated("cylinder", {"--n", "4", "--layers", "4"}));
  HexMesh mesh = disturbed(cells, 2);
  const double worst = least_scaled_jacobian(mesh);
  smooth_mesh(mesh, no_interface(mesh), {}, Log());
  EXPECT_GT(least_scaled_jacobian(mesh), std::max(worst, 0.299));
  EXPECT_NEAR(volume(mesh) / volume(cells), 1, 1e-13);
  EXPECT_EQ(exterior_problem(mesh, 1e-12), "");
}

// One node of a cube in the middle of a side and one in the middle of an edge: every step ends on them.
TEST(NodeStepOnAnExterior, EndsOnWhatHoldsTheNode) {
  const HexMesh cells = with_exterior(whole_grid(box_grid({2, 2, 2}, {0, 0, 0}, {2, 2, 2})));
  for (const auto& [place, free] :
       {std::pair{Vec3{1, 1, 0}, Vec3{1, 1, 0}}, std::pair{Vec3{1, 0, 0}, Vec3{1, 0, 0}},
        std::pair{Vec3{0, 0, 0}, Vec3{0, 0, 0}}, std::pair{Vec3{1, 1, 1}, Vec3{1, 1, 1}}})
    for (const bool climbs : {false, true}) {
      HexMesh mesh = cells;
      const auto n = static_cast<LocalId>(std::find(mesh.position.begin(), mesh.position.end(), place) -
                                          mesh.position.begin());
      mesh.position[at(n)] += scaled({0.7, 0.6, 0.5}, free);
      const double before = least_scaled_jacobian(mesh);
      const NodeHexes around(mesh);
      const Geometry geometry = no_interface(mesh);
      NodeStep step(mesh, around, geometry, false);
      step.set_scale({1 / mesh.cell_size.x, 1 / mesh.cell_size.y, 1 / mesh.cell_size.z});
      bool moved = false;
      for (int i = 0; i < 20; ++i) moved = (climbs ? step.climb(n, {}) : step.newton(n, {})) || moved;
      EXPECT_EQ(moved, free != Vec3{});
      const Vec3 off = mesh.position[at(n)] - place;
      for (std::size_t d = 0; d < 3; ++d)
        if (free[d] == 0) EXPECT_EQ(off[d], 0);
      if (moved) EXPECT_GT(least_scaled_jacobian(mesh), before);
    }
}

}  // namespace
}  // namespace sculpt::test
