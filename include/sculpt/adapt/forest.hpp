#pragma once
// Which cells of the overlay grid are halved, and how often. Cells are refined in blocks of 2x2x2: a block of
// level l is made of cells of level l (1/2^l of the size of the grid's cells). A refined block of level 0 has
// a block of level 1 in the place of each of its cells, and so on; blocks that are not refined are the
// leaves, which hold the cells of the mesh (the report, section 2.5). Where an odd number of cells of a level
// fits along an axis, its last blocks end at their middle plane; cells across the end of the domain are
// refined. The same on every rank. Local.
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "sculpt/grid/index_box.hpp"

namespace sculpt {

class Forest {
 public:
  // cells: of the overlay grid; levels: how often a cell may be halved, 0 = never; periodic: axes whose ends
  // meet (an even number of cells there unless levels is 0); missing: so many cells of the finest level
  // before the high ends of the grid the domain ends. Nothing is refined at first but cells across these
  // ends.
  Forest(const Index3& cells, int levels, const std::array<bool, 3>& periodic,
         const Index3& missing = {0, 0, 0});

  [[nodiscard]] int levels() const { return levels_; }
  [[nodiscard]] const std::array<bool, 3>& periodic() const { return periodic_; }
  // Cells in the domain if all were of this level, those across its ends included.
  [[nodiscard]] Index3 cells(int level) const;
  // Blocks of this level: half as many, rounded up.
  [[nodiscard]] Index3 blocks(int level) const;

  // Whether a block is refined; blocks beyond an end of the grid are where the axis is periodic, the images
  // of those before the middle plane where the grid ends there, and never otherwise. False for level =
  // levels().
  [[nodiscard]] bool refined(int level, const Index3& block) const;
  // Asks for cells of a level to be halved: refines their blocks, but nothing else that this brings about.
  void refine_cell(int level, const Index3& cell);
  void refine_block(int level, const Index3& block);

  // The words of all levels, to be combined with those of other ranks by bitwise or.
  [[nodiscard]] std::span<std::uint64_t> words() { return words_; }

  // Refines more blocks until all cells around a refined cell are of its level, and every leaf has a valid
  // transition. Returns how many blocks were added.
  std::int64_t close();

  // Bit per refined neighbour of a leaf (BlockPattern in block_template.hpp); bits that say nothing new are
  // cleared.
  [[nodiscard]] std::uint32_t pattern(int level, const Index3& block) const;
  // Bit d set when the block ends at its middle plane in axis d.
  [[nodiscard]] unsigned ends(int level, const Index3& block) const;

  // Calls visit(level, block) for the leaves in the place of a block of level 0, in the order of their
  // octants.
  void for_each_leaf(const Index3& base_block, const std::function<void(int, const Index3&)>& visit) const;

 private:
  struct Level {
    Index3 blocks{0, 0, 0};
    std::size_t first_word = 0;
  };
  [[nodiscard]] bool fits(int level, std::size_t axis) const;
  void refine_across_end(std::size_t axis);
  [[nodiscard]] bool wrap(int level, Index3& block) const;
  [[nodiscard]] std::size_t number(const Level& l, const Index3& b) const {
    return static_cast<std::size_t>(b[0] + l.blocks[0] * (b[1] + l.blocks[1] * b[2]));
  }
  [[nodiscard]] std::vector<Index3> list(int level) const;
  [[nodiscard]] bool has_transition(int level, const Index3& block) const;
  bool add(int level, Index3 block, std::vector<Index3>& added);
  void nest(int level, const std::vector<Index3>& blocks, std::vector<Index3>& added);
  void repair(int level, std::vector<Index3> changed, std::vector<Index3>& added);
  void visit_leaves(int level, const Index3& block,
                    const std::function<void(int, const Index3&)>& visit) const;

  Index3 finest_;  // cells of the finest level
  int levels_;
  std::array<bool, 3> periodic_;
  std::vector<Level> refined_;
  std::vector<std::uint64_t> words_;
};

}  // namespace sculpt
