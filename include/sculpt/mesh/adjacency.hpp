#pragma once
// Adjacency of a HexMesh, built when a stage needs it and dropped after. Local. Lists ascend in local index,
// which is the order of global ids.
#include <array>
#include <span>
#include <vector>

#include "sculpt/mesh/hex_mesh.hpp"

namespace sculpt {

// For every node the hexes around it as 8 * hex + corner.
class NodeHexes {
 public:
  explicit NodeHexes(const HexMesh& mesh);
  [[nodiscard]] std::span<const std::int32_t> operator[](LocalId node) const {
    const auto n = static_cast<std::size_t>(node);
    return {items_.data() + offset_[n], items_.data() + offset_[n + 1]};
  }
  [[nodiscard]] std::size_t largest() const;

 private:
  std::vector<std::int64_t> offset_;
  std::vector<std::int32_t> items_;
};

// For every hex its neighbours across the six faces (kFaces order); kNone where there is none in this rank's
// mesh. A hex of an inner layer without a neighbour has that face on the boundary of the domain.
using FaceNeighbours = std::vector<std::array<LocalId, 6>>;
[[nodiscard]] FaceNeighbours face_neighbours(const HexMesh& mesh);
// The same without use of the lattice, for any hex mesh.
[[nodiscard]] FaceNeighbours face_neighbours_of_any(const HexMesh& mesh);

// The face of a hex (kFaces index) that has these four nodes in any order, or -1.
[[nodiscard]] int face_with_nodes(const Hex& hex, const std::array<LocalId, 4>& nodes);

}  // namespace sculpt
