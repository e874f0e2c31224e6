#pragma once
// Which nodes of the pillowed mesh lie on interfaces, and what the contour says about them.
#include <vector>

#include "sculpt/brep/interfaces.hpp"
#include "sculpt/contour/interface_smoothing.hpp"
#include "sculpt/pillow/pillow.hpp"
#include "sculpt/smooth/smooth.hpp"

namespace sculpt {

// The second pillow with its sources traced back to the mesh before the first. copied: 1 made by the first
// pillow (or from such a node), 2 made by the second from an old node.
[[nodiscard]] Pillowed stacked(const Pillowed& first, Pillowed second);

// Local. Old interface nodes stay where the contour has them. Copies that a surface pillow made of curve
// nodes lie on the surface: they are put a third of the way into its quads.
[[nodiscard]] Geometry interface_geometry(Pillowed& pillowed, const HexMesh& cells, const Interfaces& faces,
                                          const std::vector<Weight>& weights);

// What interface nodes are held to after the contour: the reconstructed interface or the exact surface, or,
// for the published method on data without one, the quadrics of the smoothed interface.
struct HeldInterface {
  HexMesh cells;  // nodes where the smoothed contour has them
  Interfaces faces;
  std::vector<Crossing> crossings;
  std::vector<Vec3> grid_position;  // of interface nodes in the overlay grid
  ExactSurface exact;
  bool quadrics = false;
};

// Local. Fills geometry.onto; the mesh must be the one that geometry was made for, before smoothing.
void hold(Geometry& geometry, const Pillowed& pillowed, HeldInterface interface);

}  // namespace sculpt
