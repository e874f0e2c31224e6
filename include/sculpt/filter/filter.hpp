#pragma once
// One material per cell, such that every interface is manifold (the report, section 2.7). A node is manifold
// when, for every material at it, the cells of the material and the other cells each form one face-connected
// set.
#include <cstdint>
#include <span>

#include "sculpt/input/material_source.hpp"
#include "sculpt/mesh/adjacency.hpp"
#include "sculpt/mesh/hex_mesh.hpp"

namespace sculpt {

// Collective. mesh.material of every local cell = the material with the largest fraction; ties go to the one
// with more in the face neighbours, then to the smaller id.
void assign_materials(HexMesh& mesh, const Fractions& fractions, const FaceNeighbours& neighbours);

// Collective. micro_shave: a cell on the box without a face neighbour of its own material takes `to`
// (measured on real Sculpt: always the smallest material id). Returns the number of cells changed on all
// ranks.
std::int64_t shave_boundary(HexMesh& mesh, const FaceNeighbours& neighbours, std::int32_t to);

struct ManifoldReport {
  std::int64_t bad_nodes = 0;      // non-manifold nodes found at the start
  std::int64_t changed_cells = 0;  // changes made (a cell may change more than once)
  std::int64_t forced_nodes = 0;   // nodes settled by the last resort, which merges materials
  int passes = 0;
};

// Collective. Reassigns cells until every node is manifold; needs two ghost layers. Always ends: after a
// fixed number of passes what is left is settled by a rule that only ever lowers material indices.
ManifoldReport resolve_non_manifold(HexMesh& mesh, const Fractions& fractions,
                                    const FaceNeighbours& neighbours, const NodeHexes& around);

// Local. Whether all nodes of the owned cells are manifold.
[[nodiscard]] bool interfaces_are_manifold(const HexMesh& mesh, const FaceNeighbours& neighbours,
                                           const NodeHexes& around);

}  // namespace sculpt
