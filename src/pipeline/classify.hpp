#pragma once
// The stages from volume fractions to one material per cell: thickening, assignment and filtering, as the
// deck asks for them.
#include <functional>
#include <optional>
#include <vector>

#include "sculpt/base/log.hpp"
#include "sculpt/deck/deck.hpp"
#include "sculpt/input/material_source.hpp"
#include "sculpt/mesh/adjacency.hpp"
#include "sculpt/mesh/hex_mesh.hpp"
#include "sculpt/pipeline/stages.hpp"

namespace sculpt {

// Collective. Volume of each material, in cells, in the mesh that would follow from the materials of the
// cells.
using MeshVolumes = std::function<std::vector<double>()>;

// Collective. Sets cells.material; the fractions follow it: the material of a cell is the one with most of
// it. The table gains the void where thicken_void needs one. around is built but with stair = fast, which
// filters nothing. input_volume (of each material, in cells) and mesh_volumes serve to find thickening
// values. Answers the volumes that materials shall have in the mesh (thicken_material = ... auto), below 0
// for all others.
[[nodiscard]] std::vector<double> classify(const Comm& comm, const Deck& deck, HexMesh& cells,
                                           Fractions& fractions, MaterialTable& materials,
                                           const FaceNeighbours& neighbours, std::optional<NodeHexes>& around,
                                           const std::vector<double>& input_volume,
                                           const MeshVolumes& mesh_volumes, const Log& log, Stages& stages);

}  // namespace sculpt
