#pragma once
// Walks around an edge of the mesh, from face to face. Local.
#include <algorithm>
#include <array>

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

// The two faces at the edge between two corners; -1 where there is no edge.
inline constexpr std::array<std::array<std::array<int, 2>, 8>, 8> kEdgeFaces = [] {
  std::array<std::array<std::array<int, 2>, 8>, 8> faces{};
  for (std::size_t a = 0; a < 8; ++a)
    for (std::size_t b = 0; b < 8; ++b) {
      faces[a][b] = {-1, -1};
      std::size_t k = 0;
      for (const int edge : kCornerNeighbours[a])
        for (const int f : kCornerFaces[a])
          for (const int g : kCornerFaces[b])
            if (edge == static_cast<int>(b) && f == g) faces[a][b][k++] = f;
    }
  return faces;
}();

// The corner of face g (an index into kFaces[g]) at which the edge begins that it shares with face f of the
// same hex; -1 when they share none.
[[nodiscard]] constexpr int side_over(int g, int f) {
  const auto& on = kFaces[static_cast<std::size_t>(f)];
  const auto& corners = kFaces[static_cast<std::size_t>(g)];
  const auto shared = [&](std::size_t v) { return std::find(on.begin(), on.end(), corners[v]) != on.end(); };
  for (std::size_t v = 0; g != f && v < 4; ++v)
    if (shared(v) && shared((v + 1) % 4)) return static_cast<int>(v);
  return -1;
}

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

// The other face of the same hex at the edge a-b of a face.
[[nodiscard]] inline HexFace across_edge(const HexMesh& mesh, HexFace from, LocalId a, LocalId b) {
  const Hex& hex = mesh.hexes[at(from.hex)];
  const auto corner = [&](LocalId n) {
    return static_cast<std::size_t>(std::find(hex.begin(), hex.end(), n) - hex.begin());
  };
  const auto& faces = kEdgeFaces[corner(a)][corner(b)];
  return {from.hex, faces[faces[0] == from.face]};
}

// The same face seen from the neighbour; hex = kNone where there is none.
[[nodiscard]] inline HexFace other_side(const HexMesh& mesh, const FaceNeighbours& neighbours, HexFace of) {
  const LocalId other = neighbours[at(of.hex)][static_cast<std::size_t>(of.face)];
  if (other == kNone) return {kNone, -1};
  // Two hexes may have more than one face in common, but no two of them hold the same diagonal.
  const auto nodes = face_nodes(mesh, of);
  const auto& back = neighbours[at(other)];
  int face = 0;
  while (back[static_cast<std::size_t>(face)] != of.hex || !face_has(mesh, {other, face}, nodes[0]) ||
         !face_has(mesh, {other, face}, nodes[2]))
    ++face;
  return {other, face};
}

}  // namespace sculpt
