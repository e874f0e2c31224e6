#pragma once
// The distributed hex mesh: one type for every overlay grid and every stage (docs/architecture.md). Before
// the hexes are built its elements are the cells of the overlay grid, afterwards the hexes of the result.
//
// Local numbering ascends in global id, for nodes and hexes, owned and ghost alike: so "in local order" is
// "in canonical order", and adjacency lists built by a plain loop are sorted for free. layer says what is
// owned.
//
// Periodic meshes: around the domain lie images of its nodes and hexes, a whole number of periods away
// (docs/periodic.md). They are local entities like all others and belong to the ghost layers, and every rank
// holds its own. An image has
//   - an id of its own; ids ascend in an order that a translation by a period does not change, so that lists
//     around an entity and around its images are in the same order;
//   - the home, which is the id of the entity in the domain that it is an image of; the domain holds the
//     nodes on its low sides, those on the high sides are images;
//   - the owner of the home plus the number of ranks, so that no rank takes an image for its own;
//   - the value of its home in every exchange, positions translated (share_positions).
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sculpt/base/types.hpp"
#include "sculpt/base/vec3.hpp"
#include "sculpt/geom/hex.hpp"
#include "sculpt/mesh/exterior.hpp"
#include "sculpt/par/ghost_exchange.hpp"

namespace sculpt {

// Bits of HexMesh::box_sides.
enum BoxSide : std::uint8_t { kXmin = 1, kXmax = 2, kYmin = 4, kYmax = 8, kZmin = 16, kZmax = 32 };
inline constexpr std::uint8_t kAxisSides[3] = {kXmin | kXmax, kYmin | kYmax, kZmin | kZmax};

// Ids of the hexes that a pillow makes of hex h: 8 h + 0 .. 6 (pillow.hpp).
inline constexpr GlobalId kHexFactor = 8;

// How many periods an image lies from its home, per axis; 0 0 0 for what is no image.
using Image = std::array<std::int16_t, 3>;

struct HexMesh {
  // Nodes.
  std::vector<Vec3> position;
  std::vector<GlobalId> node_id;         // key that does not depend on the number of ranks, ascending
  std::vector<std::int32_t> node_owner;  // rank; of images: rank + number of ranks
  std::vector<std::uint8_t> box_sides;   // sides of the domain that hold the node: of its box (BoxSide), or
                                         // surfaces of its exterior, which share bits where they never meet
  std::vector<std::uint8_t>
      colour;                    // nodes of one colour share no hex unless they stem from one overlay node
  std::vector<float> node_unit;  // size of the smallest cells around the node, in units of cell_size;
                                 // empty: 1 everywhere, as in every lattice

  // Hexes.
  std::vector<Hex> hexes;               // Exodus corner order, local node indices
  std::vector<GlobalId> hex_id;         // as node_id, ascending
  std::vector<std::int32_t> hex_owner;  // as node_owner
  std::vector<std::uint8_t> layer;      // 0 owned, 1 and above: ghost layers outwards
  std::vector<std::int32_t> material;   // dense material index

  // Of periodic meshes; empty in others.
  std::vector<GlobalId> node_home, hex_home;
  std::vector<Image> node_image, hex_image;
  Vec3 period{0, 0, 0};   // per axis; 0 = not periodic
  Vec3 quantum{0, 0, 0};  // powers of two that positions are multiples of; 0 = of nothing

  Exterior exterior;  // of a domain that is no box; else empty

  GhostExchange node_exchange;  // ghost nodes take their owners' values
  GhostExchange hex_exchange;   // likewise for hexes
  int ghost_layers = 0;         // of hexes around the owned ones, where the domain has them
  int colours = 0;              // number of colours in use
  Vec3 cell_size{1, 1, 1};      // of the overlay grid, at level 0
  std::array<LocalId, 3> lattice{0, 0,
                                 0};  // cells per axis when the local hexes are a full box, x fastest; else 0

  [[nodiscard]] LocalId nodes() const { return static_cast<LocalId>(position.size()); }
  [[nodiscard]] LocalId size() const { return static_cast<LocalId>(hexes.size()); }
  // Lengths "in cells" are those of the cells at a node. The size of these in units of cell_size (exactly, in
  // refined grids), and what turns a vector into cells.
  [[nodiscard]] double unit(LocalId node) const {
    return node_unit.empty() ? 1.0 : static_cast<double>(node_unit[at(node)]);
  }
  [[nodiscard]] Vec3 per_cell(LocalId node) const {
    const double u = unit(node);
    return {1 / (u * cell_size.x), 1 / (u * cell_size.y), 1 / (u * cell_size.z)};
  }
  // Hexes count in the smallest cells at their nodes.
  [[nodiscard]] double hex_unit(LocalId hex) const {
    if (node_unit.empty()) return 1.0;
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
  // The ids that the owners of nodes and hexes know them by.
  [[nodiscard]] std::span<const GlobalId> node_homes() const {
    return node_home.empty() ? node_id : node_home;
  }
  [[nodiscard]] std::span<const GlobalId> hex_homes() const { return hex_home.empty() ? hex_id : hex_home; }
  [[nodiscard]] Image image_of(LocalId hex) const {
    return hex_image.empty() ? Image{0, 0, 0} : hex_image[static_cast<std::size_t>(hex)];
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

// Local. What is left of the displacement of a node that is at `from`, on the boundary, when the node stays
// on the boundary: its component along the sides of the box that hold it, or the way to the nearest point of
// the exterior that it may go to.
[[nodiscard]] inline Vec3 held(const HexMesh& mesh, LocalId node, const Vec3& from, const Vec3& move) {
  if (mesh.exterior.empty()) return held_on_box(move, mesh.box_sides[at(node)]);
  const LocalId hold = mesh.exterior.hold_of[at(node)];
  if (hold == kNone) return move;
  if (mesh.exterior.holds[at(hold)].kind == Hold::Kind::kPoint) return {};
  return mesh.exterior.nearest(hold, from + move) - from;
}

// Local. The directions in which a node at p may begin to move.
struct Freedom {
  std::uint8_t fixed_axes = 0;  // bits of BoxSide: no component along these axes
  int dimensions = 3;           // on an exterior
  Vec3 direction;               // the normal when there are 2, the tangent when there is 1

  [[nodiscard]] Vec3 along(const Vec3& v) const {
    if (dimensions == 3) return held_on_box(v, fixed_axes);
    if (dimensions == 2) return v - dot(v, direction) * direction;
    return dimensions == 1 ? dot(v, direction) * direction : Vec3{};
  }
};
[[nodiscard]] Freedom freedom(const HexMesh& mesh, LocalId node, const Vec3& p);

// Collective. Makes both exchanges anew from ids, homes and owners.
void connect_ranks(const Comm& comm, HexMesh& mesh);

// Local. In a periodic mesh the position of an owned node is rounded to the quantum, so that differences of
// positions are the same, to the last bit, for an entity and its images. Whoever moves owned nodes does this,
// or lets share_positions do it, before the moves are looked at.
void round_to_quantum(const HexMesh& mesh, Vec3& position);

// Local. Where a ghost node is when its home is at `home`: one addition of the period per axis.
[[nodiscard]] Vec3 position_of_ghost(const HexMesh& mesh, LocalId node, const Vec3& home);

// Collective. Ghosts take the positions of their owners' nodes; owned ones are rounded to the quantum first.
void share_positions(HexMesh& mesh);
// The same for the positions of some nodes (ascending), with their own exchange.
void share_positions(const HexMesh& mesh, const GhostExchange& exchange, std::span<const LocalId> nodes,
                     std::vector<Vec3>& position);

}  // namespace sculpt
