#pragma once
// The overlay mesh of a run with `input_mesh` or `input_mesh_pamgen`.
#include "pipeline/overlay.hpp"

namespace sculpt {

[[nodiscard]] bool has_input_mesh(const Deck& deck);

// Collective. Lengths at a node count in its shortest edge (HexMesh::node_unit).
void set_units(HexMesh& cells);

// Collective. Reads the hex mesh and its materials. A mesh that is a Cartesian grid becomes one, so that it
// gives what the same grid gives without a mesh.
[[nodiscard]] Overlay read_unstructured(const Comm& comm, const Deck& deck, const Log& log, Stages& stages);

}  // namespace sculpt
