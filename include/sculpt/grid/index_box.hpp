#pragma once
// A box of cells of a Cartesian grid, half open: lo <= (i,j,k) < hi. Within a box x varies fastest.
#include <algorithm>
#include <array>
#include <cstdint>

namespace sculpt {

using Index3 = std::array<std::int64_t, 3>;

struct IndexBox {
  Index3 lo{0, 0, 0}, hi{0, 0, 0};

  bool operator==(const IndexBox&) const = default;
  [[nodiscard]] std::int64_t extent(std::size_t axis) const {
    return std::max<std::int64_t>(0, hi[axis] - lo[axis]);
  }
  [[nodiscard]] std::int64_t size() const { return extent(0) * extent(1) * extent(2); }
  [[nodiscard]] bool empty() const { return size() == 0; }
  [[nodiscard]] bool contains(const Index3& c) const {
    return c[0] >= lo[0] && c[0] < hi[0] && c[1] >= lo[1] && c[1] < hi[1] && c[2] >= lo[2] && c[2] < hi[2];
  }
  // Position of a cell of the box in x-fastest order, from 0.
  [[nodiscard]] std::int64_t position(const Index3& c) const {
    return (c[0] - lo[0]) + extent(0) * ((c[1] - lo[1]) + extent(1) * (c[2] - lo[2]));
  }
  [[nodiscard]] Index3 cell(std::int64_t position) const {
    const std::int64_t nx = extent(0), ny = extent(1);
    return {lo[0] + position % nx, lo[1] + position / nx % ny, lo[2] + position / nx / ny};
  }
};

[[nodiscard]] inline IndexBox intersection(const IndexBox& a, const IndexBox& b) {
  IndexBox c;
  for (std::size_t d = 0; d < 3; ++d) {
    c.lo[d] = std::max(a.lo[d], b.lo[d]);
    c.hi[d] = std::max(c.lo[d], std::min(a.hi[d], b.hi[d]));
  }
  return c;
}

// The box of all cells of a grid of n cells.
[[nodiscard]] inline IndexBox whole(const Index3& n) { return {{0, 0, 0}, n}; }

}  // namespace sculpt
