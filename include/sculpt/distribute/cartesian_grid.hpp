#pragma once
// Unstructured meshes that are a Cartesian grid of equal cells in disguise.
#include <optional>
#include <vector>

#include "sculpt/grid/grid.hpp"
#include "sculpt/mesh/element_share.hpp"
#include "sculpt/par/comm.hpp"

namespace sculpt {

struct CartesianShare {
  Grid grid;                   // box_grid of the box of all nodes
  std::vector<GlobalId> cell;  // per element of the share: its cell in the numbering of the grid
};

// Collective. The grid that this mesh is, when its elements are all cells of one box of equal cells, each
// once, right-handed in any of the 24 orientations, and its nodes stand where the planes meet, within 1e-9 of
// the spacing (and the rounding of the coordinates), each once; in any numbering. The grid does not depend on
// who has what. Cheap to deny. Throws AgreedError when a node of a mesh that may be a grid has no
// coordinates.
[[nodiscard]] std::optional<CartesianShare> cartesian_grid_of(const Comm& comm, const ElementShare& share);

}  // namespace sculpt
