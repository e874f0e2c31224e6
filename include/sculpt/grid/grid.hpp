#pragma once
// The overlay grid: a Cartesian box of cells, given by its grid planes (the report, section 2.4). Cell
// (i,j,k) has the global id i + nx (j + ny k); node (i,j,k) has i + (nx+1)(j + (ny+1) k).
#include <array>
#include <vector>

#include "sculpt/base/types.hpp"
#include "sculpt/base/vec3.hpp"
#include "sculpt/grid/index_box.hpp"

namespace sculpt {

struct Grid {
  Index3 cells{0, 0, 0};
  std::array<std::vector<double>, 3> planes;  // cells[d]+1 ascending coordinates per axis

  [[nodiscard]] Vec3 cell_size() const {
    Vec3 h;
    for (std::size_t d = 0; d < 3; ++d)
      h[d] = (planes[d].back() - planes[d].front()) / static_cast<double>(cells[d]);
    return h;
  }
  [[nodiscard]] GlobalId cell_id(const Index3& c) const { return c[0] + cells[0] * (c[1] + cells[1] * c[2]); }
  [[nodiscard]] GlobalId node_id(const Index3& n) const {
    return n[0] + (cells[0] + 1) * (n[1] + (cells[1] + 1) * n[2]);
  }
  // Where planes meet; each index is that of a plane.
  [[nodiscard]] Vec3 corner(const Index3& n) const {
    return {planes[0][static_cast<std::size_t>(n[0])], planes[1][static_cast<std::size_t>(n[1])],
            planes[2][static_cast<std::size_t>(n[2])]};
  }
  [[nodiscard]] GlobalId cell_count() const { return cells[0] * cells[1] * cells[2]; }
};

// A grid of equal cells: planes[d][i] = origin[d] + i * size[d] (one multiplication, one addition).
[[nodiscard]] Grid uniform_grid(const Index3& cells, const Vec3& origin, const Vec3& size);
// A grid of equal cells between two corners: the outer planes are lo and hi to the last bit.
[[nodiscard]] Grid box_grid(const Index3& cells, const Vec3& lo, const Vec3& hi);

}  // namespace sculpt
