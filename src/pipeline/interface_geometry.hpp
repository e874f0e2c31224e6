#pragma once
// Which nodes of the pillowed mesh lie on interfaces, and what the contour says about them.
#include <span>
#include <vector>

#include "sculpt/brep/interfaces.hpp"
#include "sculpt/contour/capture.hpp"
#include "sculpt/contour/interface_smoothing.hpp"
#include "sculpt/pillow/pillow.hpp"
#include "sculpt/smooth/smooth.hpp"

namespace sculpt {

// Local. Of the volume pillow of the cells: the old interface nodes, which stay where the contour has them.
[[nodiscard]] Geometry interface_geometry(const Pillowed& pillowed, const Interfaces& faces,
                                          const std::vector<Weight>& weights);

// Local. The same after another pillow of the mesh: old interface nodes keep what is known of them, copies
// that lie on an interface shall stay where they were made. captured: per label of the pillow, the surface of
// the geometry that its copies are tied to, or kNone; may be empty.
[[nodiscard]] Geometry followed(const Geometry& before, const Pillowed& pillowed,
                                std::span<const std::int32_t> captured);

// What interface nodes are held to after the contour: the reconstructed interface or the exact surface, or,
// for the published method on data without one, the quadrics of the smoothed interface.
struct HeldInterface {
  HexMesh cells;  // nodes where the smoothed contour has them
  Interfaces faces;
  std::vector<Crossing> crossings;
  std::vector<Vec3> grid_position;  // of interface nodes in the overlay grid
  ExactSurface exact;
  bool quadrics = false;
  Capture capture{};
};

// Local. Fills geometry.contour.
void hold(Geometry& geometry, HeldInterface interface);

}  // namespace sculpt
