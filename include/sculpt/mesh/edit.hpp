#pragma once
// Changes to a finished mesh: its coordinates in the user's units, and the removal of hexes.
#include <cstdint>
#include <span>
#include <vector>

#include "sculpt/mesh/hex_mesh.hpp"

namespace sculpt {

// Local. Every coordinate is scaled, then translated; the cell size is scaled.
void transform(HexMesh& mesh, const Vec3& scale, const Vec3& translate);

// Collective. Takes away hexes (remove: 1 per local hex, ghosts marked as their owners mark them) and the
// nodes that no hex uses any more; ids stay. Answers with the new index of each old hex, kNone = removed.
std::vector<LocalId> remove_hexes(const Comm& comm, HexMesh& mesh, std::span<const std::uint8_t> remove);

}  // namespace sculpt
