#pragma once
// Smooths the contoured interface while it is still a surface mesh on the overlay grid. Voxel data: Taubin
// pairs of a shrinking and a growing Jacobi pass take the noise out (no projection, hardly any change of
// volume). Data with true volume fractions has no such noise: there the passes only spread the nodes on the
// interface, with a projection back to it. Curves move along their own edges by the chosen rule.
#include <vector>

#include "sculpt/brep/interfaces.hpp"
#include "sculpt/contour/contour.hpp"
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

struct InterfaceSmoothing {
  int pairs = 5;         // a shrinking and a growing pass each
  double grow = -0.53;   // share of the way in the growing pass; Taubin's keeps volumes best
  bool project = false;  // shrinking passes only, each followed by a projection to the interface
  CurveRule curve = CurveRule::kHermite;
};

// Collective. grid_position: where the interface nodes stood in the overlay grid; no node ends farther than
// 0.45 of a cell per axis from there (0.75 with projection, but on the box). Box sides are kept exactly.
void smooth_interface(HexMesh& mesh, const Interfaces& faces, const std::vector<Crossing>& crossings,
                      const std::vector<Vec3>& grid_position, const InterfaceSmoothing& options);

// What later stages may do to an interface node: a symmetric matrix (xx xy xz yy yz zz) that weighs a
// deviation d as d.W.d: the normal direction of a surface, all but the tangent of a curve, everything at a
// vertex; sliding is cheap.
using Weight = std::array<double, 6>;

// Local. The weights of all interface nodes at their present positions (right at owned nodes).
[[nodiscard]] std::vector<Weight> deviation_weights(const HexMesh& mesh, const Interfaces& faces);

}  // namespace sculpt
