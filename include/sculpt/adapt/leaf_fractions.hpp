#pragma once
// Volume fractions of the cells of a refined mesh, from the geometry or the data, never from coarser cells.
#include "sculpt/adapt/leaf_mesh.hpp"
#include "sculpt/input/material_source.hpp"

namespace sculpt {

// Local. Fractions of the owned cells, in their order: cubes as they are, hexes of transitions by sampling.
// The field must know the blocks of this rank.
[[nodiscard]] Fractions leaf_fractions(const Grid& grid, const LeafMesh& mesh, MaterialField& field);

}  // namespace sculpt
