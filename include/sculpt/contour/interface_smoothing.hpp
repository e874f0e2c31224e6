#pragma once
// Smooths the contoured interface while it is still a surface mesh on the overlay grid. Voxel data: Taubin
// pairs of a shrinking and a growing Jacobi pass take the noise out (no projection, hardly any change of
// volume). Data with true volume fractions has no such noise: there the passes only spread the nodes on the
// interface, with a projection back to it. The report's projection to a quadric is a third way. Curves move
// along their own edges by the chosen rule.
#include <functional>
#include <optional>
#include <vector>

#include "sculpt/brep/interfaces.hpp"
#include "sculpt/contour/contour.hpp"
#include "sculpt/contour/quadric.hpp"
#include "sculpt/mesh/hex_mesh.hpp"

namespace sculpt {

// Where a curve node wants to go; the values of the option csmooth.
enum class CurveRule {
  kOff = 0,
  kCircle,
  kHermite,
  kAverageTangent,
  kNeighbourSurfaceNormal,
  kVfrac,
  kLinear
};

// What follows a shrinking pass.
enum class SurfaceProjection {
  kOff,        // a growing pass
  kQuadric,    // surface nodes go to the quadric of their neighbours before the pass
  kInterface,  // every node goes back to the interface as it was reconstructed, or to the exact surface
};

struct InterfaceSmoothing {
  int pairs = 5;        // of a shrinking pass and what follows it
  double grow = -0.53;  // share of the way in the growing pass; Taubin's keeps volumes best
  SurfaceProjection projection = SurfaceProjection::kOff;
  ExactSurface exact{};  // used by kInterface, where there is one
  // The point that an interface node at p is tied to, whatever the projection; nothing: it is not.
  std::function<std::optional<Vec3>(std::size_t interface_node, const Vec3& p)> tied{};
  CurveRule curve = CurveRule::kHermite;
};

// Collective. grid_position: where the interface nodes stood in the overlay grid; no node ends farther than
// 0.45 of a cell per axis from there (0.75 with projection, but on the box; 1 where it is tied), and without
// projection none goes farther than 0.55 of a cell. Box sides are kept exactly.
void smooth_interface(HexMesh& mesh, const Interfaces& faces, const std::vector<Crossing>& crossings,
                      const std::vector<Vec3>& grid_position, const InterfaceSmoothing& options);

// Local. The quadric of the surface around a surface node, from the nodes of the quads there. position:
// of an interface node. Right at owned nodes.
[[nodiscard]] Quadric surface_quadric(const HexMesh& mesh, const Interfaces& faces,
                                      std::size_t interface_node,
                                      const std::function<Vec3(LocalId)>& position);

// What later stages may do to an interface node: a symmetric matrix (xx xy xz yy yz zz) that weighs a
// deviation d as d.W.d: the normal direction of a surface, all but the tangent of a curve, everything at a
// vertex; sliding is cheap.
using Weight = std::array<double, 6>;
inline constexpr double kSliding = 0.1;  // weight of a sliding deviation

// Local. The weights of all interface nodes at their present positions (right at owned nodes).
[[nodiscard]] std::vector<Weight> deviation_weights(const HexMesh& mesh, const Interfaces& faces);

}  // namespace sculpt
