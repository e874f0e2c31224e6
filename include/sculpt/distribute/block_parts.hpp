#pragma once
// Who owns which blocks of a refined grid: blocks of 2x2x2 cells of the overlay grid, with everything that
// they were refined into. The same on every rank.
#include <cstdint>
#include <span>
#include <vector>

#include "sculpt/distribute/cartesian.hpp"

namespace sculpt {

struct BlockParts {
  Index3 blocks{0, 0, 0};
  std::vector<IndexBox> box;        // per rank; empty where nothing is owned
  std::vector<std::int32_t> owner;  // per block, x fastest

  [[nodiscard]] std::int32_t owner_of(const Index3& block) const {
    return owner[static_cast<std::size_t>(whole(blocks).position(block))];
  }
};

// Local. The boxes of a cut of the blocks.
[[nodiscard]] BlockParts block_parts(const CartesianParts& parts, int ranks);

// Local. Boxes of nearly equal weight by recursive bisection: across the longest axis, ties to the lowest; a
// box that cannot be cut any more leaves the other ranks without one. weight: per block, x fastest.
[[nodiscard]] BlockParts balanced_parts(const Index3& blocks, std::span<const std::int64_t> weight,
                                        int ranks);

}  // namespace sculpt
