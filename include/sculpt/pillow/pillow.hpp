#pragma once
// Pillowing: layers of buffer hexes around sets of hexes (the report, section 2.11.2). One operator serves
// volume pillows (label = material) and surface pillows (label = interface the hex touches).
#include <span>
#include <vector>

#include "sculpt/mesh/hex_mesh.hpp"

namespace sculpt {

struct Pillowed {
  HexMesh mesh;
  std::vector<LocalId> source;  // per node of mesh: the node of the old mesh that it is or was copied from
  std::vector<std::uint8_t> copied;  // per node of mesh: 1 for a copy
};

// Collective. label: per hex the set it belongs to, below 0 = none; drop: per hex, not part of the result
// (the sets see it all the same). Every hex of a set receives one new hex on each face towards a hex outside
// its set; faces on the domain boundary receive none: the layers end there. The new hexes lie between copies
// of the old nodes, moved by `offset` towards the inside, and the old nodes, which stay. Uses up one ghost
// layer of the old mesh.
//
// Ids: node n and its copies become 64 n + 0, 1, ...; hex h and its new neighbours 8 h + 0 and 8 h + face
// + 1.
[[nodiscard]] Pillowed pillow(const Comm& comm, const HexMesh& mesh, std::span<const std::int32_t> label,
                              std::span<const std::uint8_t> drop, double offset);

// Local. Labels for a surface pillow of a mesh that has a volume pillow: hexes with a face on an interface
// are labelled by the pair of materials there, on both sides alike, all others -1. Each interface surface is
// wrapped as a whole, so that the nodes of its curves receive copies that lie on the surface.
[[nodiscard]] std::vector<std::int32_t> surface_labels(const HexMesh& mesh);

}  // namespace sculpt
