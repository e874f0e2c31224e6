#pragma once
// Moves the nodes of a finished hex mesh until every hex is valid and good: Laplacian passes, untangling,
// improvement, and the raising of what is still below the target (docs/smoothing.md). Nodes move one after
// another in an order that depends on global ids only, nodes of one colour at the same time.
#include <array>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "sculpt/base/log.hpp"
#include "sculpt/mesh/adjacency.hpp"
#include "sculpt/mesh/hex_mesh.hpp"

namespace sculpt {

// The interface nodes: where each should stay and how a deviation d weighs (d.W.d, W = xx xy xz yy yz zz).
struct Geometry {
  static constexpr double kSliding = 0.1;  // weight of a tangential deviation

  std::vector<LocalId> index;  // per mesh node: its entry below or kNone
  std::vector<Vec3> target;
  std::vector<std::array<double, 6>> weight;
  std::vector<std::uint8_t> on_curve;  // 1 for nodes of curves and vertices
  std::vector<LocalId> origin;  // the interface node of the contour that it is, kNone for a copy of one
  std::vector<std::int32_t>
      surface;  // of a copy: the surface of the input geometry that it is tied to, or kNone; empty: none is
  // The point of the geometry that belongs to an interface node of the contour (of an owned node) when it is
  // at p; target: where the contour has it. Box sides are not considered. May be empty where nothing asks for
  // onto(): neither hold_on_geometry, max_deviation nor the published method.
  std::function<Vec3(LocalId origin, const Vec3& target, const Vec3& p)> contour;
  // The point of a surface of the input geometry that is nearest to p. Needed where copies are tied to some.
  std::function<Vec3(std::int32_t surface, const Vec3& p)> on_surface;

  // The point that belongs to an entry when its node is at p. A copy that is not tied to a surface is held to
  // the plane or line through its target that its weight tells.
  [[nodiscard]] Vec3 onto(LocalId entry, const Vec3& p) const;
};

enum class OptimisationMethod {
  kNewton,     // this program's own
  kPublished,  // the report's: Jacobi optimisation and colouring (sections 2.12.3 and 2.12.4)
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
  bool hold_on_geometry = false;  // interface nodes end as near to the geometry as the target allows
  bool captured = false;  // with hold_on_geometry: that matters more than the target, down to a scaled
                          // Jacobian of 0.12 and edges of 0.04 cells
  double max_deviation =
      std::numeric_limits<double>::infinity();  // of interface nodes from the geometry; a length
  bool deviation_by_level = false;  // max_deviation is that at level 0; in smaller cells it is smaller
  int guarantee_rounds = 0;         // most rounds in which interfaces give way more and more
  double guarantee = 0.2;           // to this scaled Jacobian
  OptimisationMethod method = OptimisationMethod::kNewton;
  bool damping = true;      // published method: the n-th of N passes goes n/N of the way
  bool size_aware = false;  // published method: quality counts short and long edges (equations 2.9-2.11)
};

// Collective. The mesh needs one ghost layer of hexes. Every hex ends with a positive Jacobian if any way to
// it was found; what is left below the target is told by summarise().
void smooth_mesh(HexMesh& mesh, const Geometry& geometry, const SmoothOptions& options, const Log& log);

}  // namespace sculpt
