#pragma once
// The layers of buffer hexes in their order: volume, surface, boundary, and around poor curves after the
// smoothing (the report, section 2.11; docs/pillowing.md).
#include <functional>
#include <span>

#include "sculpt/base/log.hpp"
#include "sculpt/brep/interfaces.hpp"
#include "sculpt/contour/interface_smoothing.hpp"
#include "sculpt/deck/deck.hpp"
#include "sculpt/mesh/hex_mesh.hpp"
#include "sculpt/pillow/pillow.hpp"
#include "sculpt/smooth/smooth.hpp"

namespace sculpt {

// What the options pillow and pillow_... ask for together.
struct LayerPlan {
  bool surfaces = false;
  bool captured = false;  // the surfaces of a captured geometry, each by itself
  bool curves = false;
  int curve_layers = 3;
  double curve_threshold = 0.3;
  bool boundaries = false;  // on sides of the box where refinement left flat hexes
  bool refined = false;     // the grid may have such hexes
  int boundary_layers = 0;  // on all sides of the box
  bool smooth_after = true;

  [[nodiscard]] bool any() const {
    return surfaces || captured || curves || boundaries || boundary_layers > 0;
  }
  // Layers of ghost cells that the overlay mesh needs: one for each pillow, one for the smoothing.
  [[nodiscard]] int ghost_layers() const {
    return 2 + (surfaces || captured) + curves + boundary_layers + (boundaries && refined);
  }
};
[[nodiscard]] LayerPlan layer_plan(const Deck& deck);

struct LayeredMesh {
  HexMesh mesh;
  Geometry geometry;         // of its interface nodes
  int pillows = 0;           // how often pillow() was called
  GlobalId node_factor = 1;  // the nodes of the overlay grid have this times their old ids
};

// Collective. Everything that comes before the smoothing. Gives up the cells when
// it is done with them. drop: per cell, no part of the mesh; weights: of
// the interface nodes.
[[nodiscard]] LayeredMesh add_layers(const Comm& comm, HexMesh cells, FaceNeighbours neighbours,
                                     std::span<const std::uint8_t> drop, const Interfaces& faces,
                                     const std::vector<Weight>& weights, const LayerPlan& plan,
                                     const Log& log);

// Collective. Wraps the poor curves of a mesh, smoothed or not, and calls `smooth` for the result, unless it
// is empty. Where the worst hex is worse after that smoothing than before, the mesh stays as it was.
void add_curve_layers(const Comm& comm, LayeredMesh& layered, const LayerPlan& plan,
                      const std::function<void(LayeredMesh&)>& smooth, const Log& log);

}  // namespace sculpt
