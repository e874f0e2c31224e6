#include <array>
#include <tuple>

#include "filter/edits.hpp"
#include "filter/ring.hpp"
#include "sculpt/mesh/edge_walk.hpp"

namespace sculpt {
namespace {

constexpr int kMostForeignFaces = 3;  // of a changed cell; more would be a protrusion

}  // namespace

// Whether the interface at a face goes on across its edge a-b: another face there is between the same two
// materials. Not where the edge is on the box.
bool Collapses::goes_on(HexFace face, LocalId a, LocalId b) const {
  const HexMesh& mesh = edits_.mesh;
  const LocalId last = edits_.neighbours[at(face.hex)][static_cast<std::size_t>(face.face)];
  const std::int32_t p = edits_.material(face.hex), q = edits_.material(last);
  bool again = false;
  for (LocalId cell = face.hex; cell != last;) {
    face = other_side(mesh, edits_.neighbours, across_edge(mesh, face, a, b));
    if (face.hex == kNone) return false;
    const std::int32_t from = edits_.material(cell), to = edits_.material(face.hex);
    again = again || (from == p && to == q) || (from == q && to == p);
    cell = face.hex;
  }
  return again;
}

// Whether the interface at a face of a cell goes on across none of its edges: the two materials touch here
// only.
bool Collapses::alone(HexFace face) const {
  const LocalId other = edits_.neighbours[at(face.hex)][static_cast<std::size_t>(face.face)];
  if (other == kNone || edits_.material(other) == edits_.material(face.hex)) return false;
  const auto nodes = face_nodes(edits_.mesh, face);
  for (std::size_t v = 0; v < 4; ++v)
    if (goes_on(face, nodes[v], nodes[(v + 1) % 4])) return false;
  return true;
}

// Faces that are alone among those at an edge of a cell that begin beyond one of its faces there. closed:
// tells whether the way around the edge came back to the cell.
int Collapses::alone_beyond(HexFace face, LocalId a, LocalId b, bool& closed) const {
  const LocalId cell = face.hex;
  int count = 0;
  for (;;) {
    face = other_side(edits_.mesh, edits_.neighbours, face);
    closed = face.hex == cell;
    if (closed || face.hex == kNone) return count;
    face = across_edge(edits_.mesh, face, a, b);
    count += edits_.neighbours[at(face.hex)][static_cast<std::size_t>(face.face)] != cell && alone(face);
  }
}

// Faces that are alone among those whose answer depends on the material of the cell: its own and all at its
// edges.
int Collapses::alone_around(LocalId cell) const {
  int count = 0;
  for (int f = 0; f < 6; ++f) count += alone({cell, f});
  for (std::size_t a = 0; a < 8; ++a)
    for (std::size_t b = a + 1; b < 8; ++b) {
      const auto& faces = kEdgeFaces[a][b];
      if (faces[0] < 0) continue;
      const Hex& hex = edits_.mesh.hexes[at(cell)];
      bool closed = false;
      count += alone_beyond({cell, faces[0]}, hex[a], hex[b], closed);
      if (!closed) count += alone_beyond({cell, faces[1]}, hex[a], hex[b], closed);
    }
  return count;
}

bool Collapses::manifold_around(LocalId cell) const {
  std::array<std::int32_t, Ring::kMost> material;
  for (const LocalId n : edits_.mesh.hexes[at(cell)]) {
    const Ring ring = ring_of(edits_.mesh, edits_.neighbours, edits_.around, n);
    const auto size = static_cast<std::size_t>(ring.size);
    for (std::size_t c = 0; c < size; ++c) material[c] = edits_.material(ring.cell[c]);
    if (!ring.manifold({material.data(), size})) return false;
  }
  return true;
}

// The cell and those of its images that alone_around() looks at: two cells away, where a periodic axis has no
// more.
std::vector<LocalId> Collapses::instances_within_reach(LocalId cell) const {
  const std::span<const GlobalId> home = edits_.mesh.hex_homes();
  std::vector<LocalId> instances{cell};
  for (std::size_t f = 0; f < 6; ++f) {
    const LocalId next = edits_.neighbours[at(cell)][f];
    const LocalId second = next == kNone ? kNone : edits_.neighbours[at(next)][f];
    if (second != kNone && home[at(second)] == home[at(cell)]) instances.push_back(second);
  }
  return instances;
}

// The material around a cell with a lone face that leaves fewest of them: interfaces may not grow, the cell
// may not become a protrusion, and the nodes must stay manifold.
std::int32_t Collapses::better(LocalId cell) const {
  bool any = false;
  for (int f = 0; f < 6; ++f) any = any || alone({cell, f});
  if (!any || edits_.locked(cell)) return kNone;
  const std::int32_t own = edits_.material(cell);
  const auto faces_towards = [&](std::int32_t m) {
    int like = 0, unlike = 0;
    for (const LocalId n : edits_.neighbours[at(cell)])
      if (n != kNone) ++(edits_.material(n) == m ? like : unlike);
    return std::pair(like, unlike);
  };
  const int like = faces_towards(own).first, before = alone_around(cell);
  const std::vector<LocalId> instances = instances_within_reach(cell);
  const auto try_material = [&](std::int32_t m) {
    for (const LocalId c : instances) edits_.mesh.material[at(c)] = m;
  };
  std::tuple<int, double, std::int32_t> best{before, 0, kNone};
  for (const LocalId n : edits_.neighbours[at(cell)]) {
    if (n == kNone || edits_.material(n) == own) continue;
    const std::int32_t m = edits_.material(n);
    const auto [with, against] = faces_towards(m);
    if (with < like || against > kMostForeignFaces) continue;
    const double loss = edits_.loss(cell, m);
    try_material(m);
    const int after = alone_around(cell);
    const bool good = after < before && manifold_around(cell);
    try_material(own);
    const std::tuple<int, double, std::int32_t> candidate{after, loss, m};
    if (good && (std::get<2>(best) == kNone || candidate < best)) best = candidate;
  }
  return std::get<2>(best);
}

}  // namespace sculpt
