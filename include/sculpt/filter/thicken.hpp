#pragma once
// Thickening: materials grow into their neighbours before the cells are filtered (the report, section 2.7.4).
#include "sculpt/input/material_source.hpp"
#include "sculpt/mesh/adjacency.hpp"
#include "sculpt/mesh/hex_mesh.hpp"

namespace sculpt {

// Collective. Every cell that is not assigned to the material gains `value` of it times a share, up to a
// fraction of 1; its other materials shrink in proportion. The share is 1 beside a flat interface, more in a
// notch and less at a tip: the part of the cells around it that hold the material, each weighed by the nodes
// it has in common with the cell. Then all cells are assigned anew.
void thicken(HexMesh& mesh, Fractions& fractions, const FaceNeighbours& neighbours, const NodeHexes& around,
             std::int32_t material, double value);

// Collective. Takes care that no two materials other than the void have a node in common: cells at a cell of
// another material become void, those of the material with the larger id first. both_sides: all such cells
// become void. Returns the number of cells changed.
std::int64_t separate_by_void(HexMesh& mesh, Fractions& fractions, const NodeHexes& around,
                              std::int32_t void_material, bool both_sides);

}  // namespace sculpt
