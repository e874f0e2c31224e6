#include <array>
#include <tuple>

#include "filter/edits.hpp"
#include "filter/ring.hpp"

namespace sculpt {
namespace {

constexpr int kMostForeignFaces = 3;  // of a changed cell; more would be a protrusion

// Whether two faces of a lattice cell have an edge in common.
constexpr bool adjacent(std::size_t f, std::size_t g) { return kFaceAxis[f] != kFaceAxis[g]; }

}  // namespace

// Whether the interface at a face of a cell goes on across none of its edges: the two materials touch here
// only.
bool Collapses::alone(LocalId cell, std::size_t face) const {
  const LocalId other = edits_.neighbours[at(cell)][face];
  if (other == kNone || edits_.material(other) == edits_.material(cell)) return false;
  const std::int32_t a = edits_.material(cell), b = edits_.material(other);
  for (std::size_t t = 0; t < 6; ++t) {
    if (!adjacent(face, t)) continue;
    const LocalId beside = edits_.neighbours[at(cell)][t], beyond = edits_.neighbours[at(other)][t];
    if (beside == kNone || beyond == kNone) continue;  // the edge is on the box
    const std::int32_t c = edits_.material(beside), d = edits_.material(beyond);
    if (c == b || d == a || (c == a && d == b)) return false;
  }
  return true;
}

// Faces that are alone among those whose answer depends on the material of the cell.
int Collapses::alone_around(LocalId cell) const {
  int count = 0;
  for (std::size_t f = 0; f < 6; ++f) {
    count += alone(cell, f);
    const LocalId beside = edits_.neighbours[at(cell)][f];
    for (std::size_t t = 0; t < 6 && beside != kNone; ++t) count += adjacent(f, t) && alone(beside, t);
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
  for (std::size_t f = 0; f < 6; ++f) any = any || alone(cell, f);
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
