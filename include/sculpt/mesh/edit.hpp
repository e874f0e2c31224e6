#pragma once
// Changes to a finished mesh: its coordinates in the user's units, and the removal of hexes.
#include <cstdint>
#include <span>
#include <vector>

#include "sculpt/mesh/hex_mesh.hpp"

namespace sculpt {

// Local. New indices of the entries of a list that are not dropped, ascending; kNone for the others.
[[nodiscard]] std::vector<LocalId> indices_without(std::span<const std::uint8_t> drop);
// Local. Takes the entries whose new index is kNone out of a list.
template <class T>
void compact(std::vector<T>& list, std::span<const LocalId> index) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < index.size(); ++i)
    if (index[i] != kNone) list[kept++] = list[i];
  list.resize(kept);
}

// Local. Takes the nodes that no hex uses out of the mesh (its exchange of nodes is left alone). Answers with
// the new index of each old node.
std::vector<LocalId> drop_unused_nodes(HexMesh& mesh);

// Collective. Every coordinate is scaled, then translated; the cell size and the period are scaled. From now
// on images are the period away from their homes, and no longer the period rounded to the quantum.
void transform(HexMesh& mesh, const Vec3& scale, const Vec3& translate);

// Collective. Turns the mesh, which has no exterior and is not periodic, about the origin: a point p comes to
// p.x axes[0] + p.y axes[1] + p.z axes[2].
void turn(HexMesh& mesh, const std::array<Vec3, 3>& axes);

// Collective. Takes away hexes (remove: per local hex, 1 = by its owner) and the nodes that no hex uses any
// more; ids stay. The exterior is no more than it was: faces that come to light
// are no part of it. Answers with the new index of each old hex, kNone = removed.
std::vector<LocalId> remove_hexes(const Comm& comm, HexMesh& mesh, std::vector<std::uint8_t> remove);

// Collective. Puts the hexes of another mesh, of which this one has none, beside those of this one; nodes
// with the same id are the same, with the same owner. Ids of `other` are multiplied by the factors first.
// Both have the ghosts of the mesh that they make together. The result has no exterior.
void join_hexes(const Comm& comm, HexMesh& mesh, HexMesh other, GlobalId node_factor, GlobalId hex_factor);

}  // namespace sculpt
