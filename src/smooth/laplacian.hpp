#pragma once
// Jacobi Laplacian of the volume nodes near interfaces (the report, section 2.12.1).
#include "sculpt/smooth/smooth.hpp"
#include "smooth/active_set.hpp"

namespace sculpt {

// Collective. Moves the nodes of hexes that touch an interface, and one layer of hexes beyond, to the mean of
// their edge neighbours; interface nodes stay. Nodes of the box keep to its sides and look at nodes on the
// same sides only.
void laplacian_passes(HexMesh& mesh, const NodeHexes& around, const Geometry& geometry, int passes,
                      const Log& log);

// Local. From a node to the mean of its edge neighbours (those on the same box sides).
[[nodiscard]] Vec3 towards_neighbours(const HexMesh& mesh, const NodeHexes& around, LocalId node);

}  // namespace sculpt
