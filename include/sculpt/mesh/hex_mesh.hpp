#pragma once
// The distributed hex mesh: one type for every overlay grid and every stage (docs/architecture.md). Before
// the hexes are built its elements are the cells of the overlay grid, afterwards the hexes of the result.
//
// Local numbering ascends in global id, for nodes and hexes, owned and ghost alike: so "in local order" is
// "in canonical order", and adjacency lists built by a plain loop are sorted for free. layer says what is
// owned.
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sculpt/base/types.hpp"
#include "sculpt/base/vec3.hpp"
#include "sculpt/geom/hex.hpp"
#include "sculpt/par/ghost_exchange.hpp"

namespace sculpt {

// Bits of HexMesh::box_sides.
enum BoxSide : std::uint8_t { kXmin = 1, kXmax = 2, kYmin = 4, kYmax = 8, kZmin = 16, kZmax = 32 };
inline constexpr std::uint8_t kAxisSides[3] = {kXmin | kXmax, kYmin | kYmax, kZmin | kZmax};

struct HexMesh {
  // Nodes.
  std::vector<Vec3> position;
  std::vector<GlobalId> node_id;         // key that does not depend on the number of ranks, ascending
  std::vector<std::int32_t> node_owner;  // rank
  std::vector<std::uint8_t> box_sides;   // sides of the domain box that hold the node
  std::vector<std::uint8_t>
      colour;                       // nodes of one colour share no hex unless they stem from one overlay node
  std::vector<std::uint8_t> level;  // the smallest cells around the node have 2^-level times the cell size;
                                    // empty: 0 everywhere, as in every lattice

  // Hexes.
  std::vector<Hex> hexes;               // Exodus corner order, local node indices
  std::vector<GlobalId> hex_id;         // as node_id, ascending
  std::vector<std::int32_t> hex_owner;  // rank
  std::vector<std::uint8_t> layer;      // 0 owned, 1 and above: ghost layers outwards
  std::vector<std::int32_t> material;   // dense material index

  GhostExchange node_exchange;  // ghost nodes take their owners' values
  GhostExchange hex_exchange;   // likewise for hexes
  int ghost_layers = 0;         // of hexes around the owned ones, where the domain has them
  int colours = 0;              // number of colours in use
  Vec3 cell_size{1, 1, 1};      // of the overlay grid, at level 0
  std::array<LocalId, 3> lattice{0, 0,
                                 0};  // cells per axis when the local hexes are a full box, x fastest; else 0

  [[nodiscard]] LocalId nodes() const { return static_cast<LocalId>(position.size()); }
  [[nodiscard]] LocalId size() const { return static_cast<LocalId>(hexes.size()); }
  // Lengths "in cells" are those of the cells at a node. The size of these in units of cell_size, exactly,
  // and what turns a vector into cells.
  [[nodiscard]] double unit(LocalId node) const {
    return level.empty() ? 1.0 : 1.0 / static_cast<double>(std::uint64_t{1} << level[at(node)]);
  }
  [[nodiscard]] Vec3 per_cell(LocalId node) const {
    const double u = unit(node);
    return {1 / (u * cell_size.x), 1 / (u * cell_size.y), 1 / (u * cell_size.z)};
  }
  // Hexes count in the smallest cells at their nodes.
  [[nodiscard]] double hex_unit(LocalId hex) const {
    if (level.empty()) return 1.0;
    double least = 1;
    for (const LocalId n : hexes[at(hex)]) least = std::min(least, unit(n));
    return least;
  }

  [[nodiscard]] HexCorners corners(LocalId hex) const {
    HexCorners p;
    for (std::size_t c = 0; c < 8; ++c)
      p[c] = position[static_cast<std::size_t>(hexes[static_cast<std::size_t>(hex)][c])];
    return p;
  }
  // Volume of a cell of the overlay mesh, in units of that of cell_size: in a lattice all count as one.
  [[nodiscard]] double volume_in_cells(LocalId cell) const {
    return lattice[0] != 0 ? 1.0 : hex_volume(corners(cell)) / (cell_size.x * cell_size.y * cell_size.z);
  }
};

// Local: sides of the box that all corners of a hex face share; 0 inside.
[[nodiscard]] std::uint8_t face_sides(const HexMesh& mesh, LocalId hex, int face);

// Keeps the component of a displacement along the planes that hold the node.
[[nodiscard]] inline Vec3 held_on_box(Vec3 move, std::uint8_t sides) {
  for (std::size_t d = 0; d < 3; ++d)
    if (sides & kAxisSides[d]) move[d] = 0;
  return move;
}

}  // namespace sculpt
