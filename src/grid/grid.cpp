#include "sculpt/grid/grid.hpp"

namespace sculpt {

Grid uniform_grid(const Index3& cells, const Vec3& origin, const Vec3& size) {
  Grid grid;
  grid.cells = cells;
  for (std::size_t d = 0; d < 3; ++d) {
    grid.planes[d].resize(static_cast<std::size_t>(cells[d] + 1));
    for (std::size_t i = 0; i < grid.planes[d].size(); ++i)
      grid.planes[d][i] = origin[d] + static_cast<double>(i) * size[d];
  }
  return grid;
}

Grid box_grid(const Index3& cells, const Vec3& lo, const Vec3& hi) {
  Vec3 size;
  for (std::size_t d = 0; d < 3; ++d) size[d] = (hi[d] - lo[d]) / static_cast<double>(cells[d]);
  Grid grid = uniform_grid(cells, lo, size);
  for (std::size_t d = 0; d < 3; ++d) grid.planes[d].back() = hi[d];
  return grid;
}

}  // namespace sculpt
