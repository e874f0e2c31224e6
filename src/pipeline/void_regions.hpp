#pragma once
// The option separate_void_blocks (docs/boundary-conditions.md).
#include <cstdint>
#include <optional>
#include <vector>

#include "sculpt/deck/deck.hpp"
#include "sculpt/input/material_source.hpp"
#include "sculpt/mesh/hex_mesh.hpp"
#include "sculpt/quality/summary.hpp"

namespace sculpt {

// Local. The dense index of the material whose block the void is: that of the table, or the one with the id
// void_mat; nothing where there is none.
[[nodiscard]] std::optional<std::int32_t> void_block(const Deck& deck, const MaterialTable& materials);

struct VoidRegions {
  std::int32_t first = 0, others = 0;  // dense indices: of the first region, and of the second and so on
  std::int64_t count = 0;
};

// Collective. Makes every region of the void that hangs together through faces a material of its own, in the
// order of their smallest hexes: the first keeps the index and the id, the others come at the end of the
// table, with the ids after the largest.
VoidRegions separate_void(const Comm& comm, HexMesh& mesh, MaterialTable& materials, std::int32_t of_void);

// Local. The volume that the void had in the input (of each material) is shared out to its regions as they
// have the volume in the mesh.
void share_void_volume(const QualitySummary& summary, const VoidRegions& regions,
                       std::vector<double>& input_volume);

}  // namespace sculpt
