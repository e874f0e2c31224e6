#pragma once
// The transition from coarse to fine cells, block by block. Cells are refined in blocks of 2x2x2; a block
// that is not refined itself but touches refined ones is cut by the 2-refinement templates (Owen, Shih, Ernst
// 2017; the report, section 2.5.1): one pass per axis, in which the edges between marked and unmarked nodes
// of the block's middle plane are halved. What becomes of a block depends on the refined blocks among the 18
// that share a face or an edge with it, and on nothing else. Pure.
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "sculpt/base/vec3.hpp"

namespace sculpt {

// Which of the neighbours of a block are refined: bits 0-5 the faces -x +x -y +y -z +z; bits 6-9 the edges
// along x
// (-y-z, +y-z, -y+z, +y+z), 10-13 those along y (-x-z, +x-z, -x+z, +x+z), 14-17 along z (-x-y, ...).
using BlockPattern = std::uint32_t;
inline constexpr int kBlockNeighbours = 18;
// Offset, in blocks, of the neighbour of each bit.
extern const std::array<std::array<int, 3>, kBlockNeighbours> kBlockOffset;

struct BlockTemplate {
  // Positions in cells, [0,2] per axis. Nodes on the surface of the block first: their positions are
  // multiples of 1/8 and tell them apart, in this block and in those beside it. `surface` counts them.
  std::vector<Vec3> node;
  std::size_t surface = 0;
  // Of the interior nodes (from `surface`), which only meet nodes of this block: from kFirstFreeColour
  // upwards, no two alike in one hex. Not of plain blocks, whose nodes are a lattice.
  std::vector<std::uint8_t> interior_colour;
  std::vector<std::array<std::uint16_t, 8>> hex;  // Exodus corner order
  // Sides (bit order of the faces of a pattern) where a hex has two faces. The block beyond must not have any
  // there, or two hexes would share two faces; nor may the domain end there.
  std::uint8_t double_sides = 0;
};

// The hexes of a block with these refined neighbours; null where no valid transition exists, so that the
// block must be refined as well. `ends`: bit d set when the block ends at its middle plane in axis d (an odd
// number of cells there); then only the half before it is given, and the pattern must be symmetric about that
// plane.
[[nodiscard]] std::unique_ptr<const BlockTemplate> block_template(BlockPattern pattern, unsigned ends);

}  // namespace sculpt
