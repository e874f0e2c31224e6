#pragma once
// Gives materials of a smooth mesh the volumes they should have, by small moves of the interfaces.
#include <limits>
#include <span>

#include "sculpt/mesh/hex_mesh.hpp"

namespace sculpt {

struct VolumeCorrection {
  int rounds = 0;
  double error = 0;     // largest relative error of volume left
  double farthest = 0;  // longest way of a node, in cells
  int left_alone = 0;   // materials that are off by more than the share that is corrected
};

// Collective. wanted: volume of each material (units of the mesh), below 0 = free. interface: per node, kNone
// for a node that is on no interface (Geometry::index). Interface nodes move along the gradients of the
// volumes of their materials, each gradient times a pressure of its material and, as smaller cells bear
// shorter moves, the size of the cells at the node; the pressures follow from the missing volumes (the linear
// system of the first-order changes). Nodes of hexes that would fall below `least_quality` (scaled Jacobian;
// or below what they have, if that is less) stay where they are; so do nodes of hexes whose edges would
// become short. A material whose volume is off by more than the share `most` is free as well. Needs one ghost
// layer.
VolumeCorrection correct_volumes(HexMesh& mesh, std::span<const LocalId> interface,
                                 std::span<const double> wanted, double least_quality,
                                 double most = std::numeric_limits<double>::infinity());

}  // namespace sculpt
