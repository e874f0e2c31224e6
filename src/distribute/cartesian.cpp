#include "sculpt/distribute/cartesian.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <tuple>

#include "sculpt/base/error.hpp"

namespace sculpt {
namespace {

std::int64_t ceiling(std::int64_t a, std::int64_t b) { return (a + b - 1) / b; }

// Smaller is better: area between ranks, largest box, then fewest segments in z, y, x reversed.
using Score = std::tuple<std::int64_t, std::int64_t, std::int64_t, std::int64_t>;

Score score(const Index3& n, const Index3& p) {
  const std::int64_t area = (p[0] - 1) * n[1] * n[2] + (p[1] - 1) * n[0] * n[2] + (p[2] - 1) * n[0] * n[1];
  const std::int64_t largest = ceiling(n[0], p[0]) * ceiling(n[1], p[1]) * ceiling(n[2], p[2]);
  return {area, largest, -p[2], -p[1]};
}

bool best_factors(const Index3& n, std::int64_t ranks, const Index3& user, Index3& best) {
  Score best_score{std::numeric_limits<std::int64_t>::max(), 0, 0, 0};
  bool found = false;
  for (std::int64_t px = 1; px <= std::min(ranks, n[0]); ++px) {
    if (ranks % px != 0 || (user[0] != 0 && px != user[0])) continue;
    for (std::int64_t py = 1; py <= std::min(ranks / px, n[1]); ++py) {
      const std::int64_t pz = ranks / px / py;
      if (ranks / px % py != 0 || pz > n[2] || (user[1] != 0 && py != user[1]) ||
          (user[2] != 0 && pz != user[2]))
        continue;
      const Index3 p{px, py, pz};
      if (!found || score(n, p) < best_score) {
        best = p;
        best_score = score(n, p);
        found = true;
      }
    }
  }
  return found;
}

// Sides of the domain that hold a grid node.
std::uint8_t sides_of(const Index3& node, const Index3& cells) {
  unsigned sides = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    if (node[d] == 0) sides |= 1U << (2 * d);
    if (node[d] == cells[d]) sides |= 2U << (2 * d);
  }
  return static_cast<std::uint8_t>(sides);
}

void add_nodes(HexMesh& mesh, const Grid& grid, const CartesianParts& parts, const IndexBox& box) {
  const auto count =
      static_cast<std::size_t>((box.extent(0) + 1) * (box.extent(1) + 1) * (box.extent(2) + 1));
  mesh.position.reserve(count);
  mesh.node_id.reserve(count);
  mesh.node_owner.reserve(count);
  mesh.box_sides.reserve(count);
  mesh.colour.reserve(count);
  for (std::int64_t k = box.lo[2]; k <= box.hi[2]; ++k)
    for (std::int64_t j = box.lo[1]; j <= box.hi[1]; ++j)
      for (std::int64_t i = box.lo[0]; i <= box.hi[0]; ++i) {
        const Index3 n{i, j, k};
        mesh.position.push_back({grid.planes[0][static_cast<std::size_t>(i)],
                                 grid.planes[1][static_cast<std::size_t>(j)],
                                 grid.planes[2][static_cast<std::size_t>(k)]});
        mesh.node_id.push_back(grid.node_id(n));
        // Owner of the cell with the smallest id around the node.
        mesh.node_owner.push_back(
            parts.owner({std::max<std::int64_t>(i - 1, 0), std::max<std::int64_t>(j - 1, 0),
                         std::max<std::int64_t>(k - 1, 0)}));
        mesh.box_sides.push_back(sides_of(n, grid.cells));
        mesh.colour.push_back(static_cast<std::uint8_t>((i & 1) | (j & 1) << 1 | (k & 1) << 2));
      }
}

void add_cells(HexMesh& mesh, const Grid& grid, const CartesianParts& parts, const IndexBox& box,
               const IndexBox& owned) {
  const auto count = static_cast<std::size_t>(box.size());
  mesh.hexes.reserve(count);
  mesh.hex_id.reserve(count);
  mesh.hex_owner.reserve(count);
  mesh.layer.reserve(count);
  const std::int64_t sy = box.extent(0) + 1, sz = sy * (box.extent(1) + 1);
  for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k)
    for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j)
      for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
        const Index3 c{i, j, k};
        const std::int64_t first = (i - box.lo[0]) + sy * (j - box.lo[1]) + sz * (k - box.lo[2]);
        Hex hex;
        for (std::size_t v = 0; v < 8; ++v)
          hex[v] = static_cast<LocalId>(first + kCornerOffset[v][0] + sy * kCornerOffset[v][1] +
                                        sz * kCornerOffset[v][2]);
        std::int64_t layer = 0;
        for (std::size_t d = 0; d < 3; ++d)
          layer = std::max({layer, owned.lo[d] - c[d], c[d] - owned.hi[d] + 1});
        mesh.hexes.push_back(hex);
        mesh.hex_id.push_back(grid.cell_id(c));
        mesh.hex_owner.push_back(parts.owner(c));
        mesh.layer.push_back(static_cast<std::uint8_t>(layer));
      }
}

}  // namespace

IndexBox CartesianParts::owned(int rank) const {
  if (rank >= segments[0] * segments[1] * segments[2]) return {};
  const IndexBox all{{0, 0, 0}, segments};
  const Index3 s = all.cell(rank);
  IndexBox box;
  for (std::size_t d = 0; d < 3; ++d) {
    box.lo[d] = cuts[d][static_cast<std::size_t>(s[d])];
    box.hi[d] = cuts[d][static_cast<std::size_t>(s[d] + 1)];
  }
  return box;
}

IndexBox CartesianParts::ghosted(int rank, int layers) const {
  IndexBox box = owned(rank);
  if (box.empty()) return box;
  for (std::size_t d = 0; d < 3; ++d) {
    box.lo[d] -= layers;
    box.hi[d] += layers;
  }
  return intersection(box, whole(cells));
}

int CartesianParts::owner(const Index3& cell) const {
  Index3 s;
  for (std::size_t d = 0; d < 3; ++d)
    s[d] = std::upper_bound(cuts[d].begin(), cuts[d].end(), cell[d]) - cuts[d].begin() - 1;
  return static_cast<int>(s[0] + segments[0] * (s[1] + segments[1] * s[2]));
}

CartesianParts cut_grid(const Index3& cells, int ranks, const Index3& user) {
  CartesianParts parts;
  parts.cells = cells;
  const bool fixed = user[0] != 0 || user[1] != 0 || user[2] != 0;
  bool found = best_factors(cells, ranks, user, parts.segments);
  if (!found && fixed)
    throw Error(fmt::format(
        "iproc, jproc, kproc = {}, {}, {} (0 = free): cannot cut a grid of {} x {} x {} cells into {} "
        "parts; expected factors of the number of ranks, each at most the cells of its axis",
        user[0], user[1], user[2], cells[0], cells[1], cells[2], ranks));
  for (std::int64_t fewer = ranks - 1; !found; --fewer)
    found = best_factors(cells, fewer, user, parts.segments);
  for (std::size_t d = 0; d < 3; ++d)
    for (std::int64_t s = 0; s <= parts.segments[d]; ++s)
      parts.cuts[d].push_back(ceiling(s * cells[d], parts.segments[d]));
  return parts;
}

HexMesh lattice_mesh(const Comm& comm, const Grid& grid, const CartesianParts& parts, int layers) {
  HexMesh mesh;
  mesh.cell_size = grid.cell_size();
  mesh.colours = 8;
  mesh.ghost_layers = layers;
  collectively(comm, "building the overlay grid", [&] {
    const IndexBox box = parts.ghosted(comm.rank(), layers);
    if (box.empty()) return;
    if (box.size() > std::numeric_limits<LocalId>::max() / 8)
      throw Error(fmt::format("{} cells on one rank: at most {} fit; use more ranks", box.size(),
                              std::numeric_limits<LocalId>::max() / 8));
    for (std::size_t d = 0; d < 3; ++d) mesh.lattice[d] = static_cast<LocalId>(box.extent(d));
    add_nodes(mesh, grid, parts, box);
    add_cells(mesh, grid, parts, box, parts.owned(comm.rank()));
  });
  mesh.node_exchange = GhostExchange(comm, mesh.node_id, mesh.node_owner);
  mesh.hex_exchange = GhostExchange(comm, mesh.hex_id, mesh.hex_owner);
  return mesh;
}

}  // namespace sculpt
