#pragma once
// The order of the cells in a voxel file: three nested loops over the axes. Turns a stretch of the file into
// the rows of a box of cells that it crosses, so that sender and receiver list the same cells without naming
// them.
#include <array>
#include <cstdint>

#include "sculpt/grid/index_box.hpp"

namespace sculpt {

struct FileOrder {
  Index3 cells{0, 0, 0};                     // of the whole file
  std::array<std::size_t, 3> axes{0, 1, 2};  // outermost loop first

  // Calls row(at, count, cell) for each row along the innermost axis that the box shares with the numbers
  // [first, first + count) of the file, in file order: `at` is counted from `first`, `cell` is the row's
  // first cell.
  template <class Row>
  void for_each_row(const IndexBox& box, std::int64_t first, std::int64_t count, const Row& row) const {
    if (count <= 0 || box.empty()) return;
    const auto [outer, middle, inner] = axes;
    const std::int64_t n_middle = cells[middle], n_inner = cells[inner], end = first + count;
    const std::int64_t first_row = first / n_inner, last_row = (end - 1) / n_inner;
    const std::int64_t first_slab = first_row / n_middle, last_slab = last_row / n_middle;
    Index3 cell;
    const std::int64_t a_end = std::min(box.hi[outer], last_slab + 1);
    for (std::int64_t a = std::max(box.lo[outer], first_slab); a < a_end; ++a) {
      const std::int64_t b_first = a == first_slab ? first_row % n_middle : 0;
      const std::int64_t b_last = a == last_slab ? last_row % n_middle : n_middle - 1;
      const std::int64_t b_end = std::min(box.hi[middle], b_last + 1);
      for (std::int64_t b = std::max(box.lo[middle], b_first); b < b_end; ++b) {
        const std::int64_t start = (a * n_middle + b) * n_inner;
        const std::int64_t from = std::max(first, start + box.lo[inner]);
        const std::int64_t to = std::min(end, start + box.hi[inner]);
        if (from >= to) continue;
        cell[outer] = a;
        cell[middle] = b;
        cell[inner] = from - start;
        row(from - first, to - from, cell);
      }
    }
  }
};

}  // namespace sculpt
