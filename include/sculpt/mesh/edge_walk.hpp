#pragma once
// Walks around an edge of the mesh, from face to face. Local.
#include "sculpt/mesh/adjacency.hpp"
#include "sculpt/mesh/hex_mesh.hpp"

namespace sculpt {

// The three faces of a hex that hold a corner.
inline constexpr std::array<std::array<int, 3>, 8> kCornerFaces = [] {
  std::array<std::array<int, 3>, 8> faces{};
  for (int c = 0; c < 8; ++c) {
    std::size_t k = 0;
    for (int f = 0; f < 6; ++f)
      for (const int v : kFaces[static_cast<std::size_t>(f)])
        if (v == c) faces[static_cast<std::size_t>(c)][k++] = f;
  }
  return faces;
}();

struct HexFace {
  LocalId hex;
  int face;
};

[[nodiscard]] inline std::array<LocalId, 4> face_nodes(const HexMesh& mesh, HexFace at_face) {
  std::array<LocalId, 4> nodes;
  for (std::size_t v = 0; v < 4; ++v)
    nodes[v] = mesh.hexes[at(at_face.hex)]
                         [static_cast<std::size_t>(kFaces[static_cast<std::size_t>(at_face.face)][v])];
  return nodes;
}

[[nodiscard]] inline bool face_has(const HexMesh& mesh, HexFace at_face, LocalId node) {
  for (const LocalId n : face_nodes(mesh, at_face))
    if (n == node) return true;
  return false;
}

// The other face of the same hex at its edge a-b.
[[nodiscard]] inline HexFace across_edge(const HexMesh& mesh, HexFace from, LocalId a, LocalId b) {
  for (int f = 0; f < 6; ++f)
    if (f != from.face && face_has(mesh, {from.hex, f}, a) && face_has(mesh, {from.hex, f}, b))
      return {from.hex, f};
  return from;  // a-b is no edge of the face
}

// The same face seen from the neighbour; hex = kNone where there is none.
[[nodiscard]] inline HexFace other_side(const HexMesh& mesh, const FaceNeighbours& neighbours, HexFace of) {
  const LocalId other = neighbours[at(of.hex)][static_cast<std::size_t>(of.face)];
  if (other == kNone) return {kNone, -1};
  return {other, face_with_nodes(mesh.hexes[at(other)], face_nodes(mesh, of))};
}

}  // namespace sculpt
