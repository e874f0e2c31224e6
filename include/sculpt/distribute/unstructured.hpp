#pragma once
// The distributed mesh of unstructured elements: layers of ghosts over nodes, whoever has which elements.
#include <cstdint>
#include <vector>

#include "sculpt/mesh/element_share.hpp"
#include "sculpt/mesh/hex_mesh.hpp"

namespace sculpt {

struct UnstructuredMesh {
  HexMesh cells;                    // materials are left unset; no node is on a side of the domain box
  std::vector<std::int32_t> block;  // per local cell: index of its block
  std::vector<double> value;        // values_per_element of each owned cell, in local order
};

// Collective. This rank's elements with `layers` (1 or more) layers of ghosts: layer n + 1 is what shares a
// node with layer n. Ids are the numbers of the share. A node belongs to the rank of the element with the
// smallest number at it. cell_size is a cube of the mean volume of all elements. Nothing but owners and
// layers depends on who has which elements. Throws AgreedError when a node has no coordinates.
[[nodiscard]] UnstructuredMesh unstructured_mesh(const Comm& comm, const ElementShare& share, int layers);

}  // namespace sculpt
