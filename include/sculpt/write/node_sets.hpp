#pragma once
// Node sets of the finished mesh. In periodic meshes partners come in the same order in the sets of opposite
// sides, edges and corners: in a file that holds all nodes the i-th nodes are a period apart.
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sculpt/mesh/hex_mesh.hpp"
#include "sculpt/write/write_mesh.hpp"

namespace sculpt {

// Nodes that this rank knows to be in a set; any rank may know of a node.
struct NodeSetMembers {
  std::int64_t id;
  std::vector<GlobalId> node;  // ids in the mesh; those that it does not have do not count
};

// Collective. The set with all nodes that this rank has, whichever rank knows of them. The mesh is not
// periodic.
[[nodiscard]] NodeSet gathered(const HexMesh& mesh, const NodeSetMembers& members);

// A side, edge or corner of the box: per axis -1 = the low side, 1 = the high one, 0 = neither.
using BoxPlace = std::array<int, 3>;

// The six sides in the order of BoxSide, the twelve edges, the eight corners.
[[nodiscard]] std::vector<BoxPlace> box_places();
// xmin, xmin_ymax, xmin_ymax_zmin, ...
[[nodiscard]] std::string place_name(const BoxPlace& place);

// Finds the nodes of places. Across an axis that is not periodic they lie on the side. Across a periodic axis
// they are those that have a partner on the other side: hexes on both sides of it use the node; at edges and
// corners nodes that have partners in every direction, hexes on all four or eight sides. Local. The mesh has
// a box and one ghost layer.
class NodesOfBox {
 public:
  explicit NodesOfBox(const HexMesh& mesh);
  // Ascending.
  [[nodiscard]] std::vector<LocalId> at_place(const BoxPlace& place) const;

 private:
  [[nodiscard]] bool is_at(LocalId node, const BoxPlace& place) const;

  const HexMesh& mesh_;
  // Per node of a periodic mesh: which copies of the domain have hexes around it (bit 13 + i + 3 j + 9 k for
  // the copy i, j, k periods away).
  std::vector<std::uint32_t> copies_;
};

}  // namespace sculpt
