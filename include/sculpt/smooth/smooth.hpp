#pragma once
// Moves the nodes of a finished hex mesh until every hex is valid and good: Laplacian passes, untangling,
// improvement, and the raising of what is still below the target (docs/smoothing.md). Nodes move one after
// another in an order that depends on global ids only, nodes of one colour at the same time.
#include <array>
#include <functional>
#include <span>
#include <vector>

#include "sculpt/base/log.hpp"
#include "sculpt/mesh/adjacency.hpp"
#include "sculpt/mesh/hex_mesh.hpp"

namespace sculpt {

// The interface nodes: where each should stay and how a deviation d weighs (d.W.d, W = xx xy xz yy yz zz).
struct Geometry {
  std::vector<LocalId> index;  // per mesh node: its entry below or kNone
  std::vector<Vec3> target;
  std::vector<std::array<double, 6>> weight;
  std::vector<std::uint8_t> on_curve;  // 1 for nodes of curves and vertices
};

struct SmoothOptions {
  int laplacian_passes = 2;    // Jacobi passes over the nodes near interfaces
  int improve_sweeps = 5;      // most optimisation sweeps over hexes below improve_below
  double improve_below = 0.6;  // scaled Jacobian
  double target = 0.3;         // scaled Jacobian that every hex shall reach
  int target_rounds = 100;     // most sweeps over hexes below the target
  double fidelity = 1;         // weight of deviations of interface nodes from where they were put
  double release_curves_below =
      0.1;  // curve nodes of hexes below it may leave their curve; negative: held harder
};

// Collective. The mesh needs one ghost layer of hexes. Every hex ends with a positive Jacobian if any way to
// it was found; what is left below the target is told by summarise().
void smooth_mesh(HexMesh& mesh, const Geometry& geometry, const SmoothOptions& options, const Log& log);

}  // namespace sculpt
