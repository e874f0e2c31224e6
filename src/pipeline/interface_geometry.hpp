#pragma once
// Which nodes of the pillowed mesh lie on interfaces, and what the contour says about them.
#include <vector>

#include "sculpt/brep/interfaces.hpp"
#include "sculpt/contour/interface_smoothing.hpp"
#include "sculpt/pillow/pillow.hpp"
#include "sculpt/quality/fidelity.hpp"
#include "sculpt/smooth/smooth.hpp"

namespace sculpt {

// The second pillow with its sources traced back to the mesh before the first. copied: 1 made by the first
// pillow (or from such a node), 2 made by the second from an old node.
[[nodiscard]] Pillowed stacked(const Pillowed& first, Pillowed second);

// Local. Old interface nodes stay where the contour has them. Copies that a surface pillow made of curve
// nodes lie on the surface: they are put a third of the way into its quads.
[[nodiscard]] Geometry interface_geometry(Pillowed& pillowed, const HexMesh& cells, const Interfaces& faces,
                                          const std::vector<Weight>& weights);

// Local. The interface nodes of the mesh that this rank owns, without copies. contoured: where the contour
// placed each node of `faces`.
[[nodiscard]] InterfaceTrack interface_track(const Pillowed& pillowed, const Geometry& geometry,
                                             const Interfaces& faces, const std::vector<Vec3>& contoured);

}  // namespace sculpt
