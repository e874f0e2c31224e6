#include "contour/gradient.hpp"

#include <algorithm>

#include "sculpt/vfrac/fractions.hpp"

namespace sculpt {
namespace {

struct Symmetric {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
};

// Solves the normal equations by Cholesky; directions without extent (zero pivots) get a zero component.
Vec3 solve(const Symmetric& a, const Vec3& b) {
  const double cut = 1e-10 * (a.xx + a.yy + a.zz);
  const double lx = a.xx > cut ? std::sqrt(a.xx) : 0, ix = lx > 0 ? 1 / lx : 0;
  const double lyx = a.xy * ix, lzx = a.xz * ix;
  const double y = a.yy - lyx * lyx, ly = y > cut ? std::sqrt(y) : 0, iy = ly > 0 ? 1 / ly : 0;
  const double lzy = (a.yz - lzx * lyx) * iy;
  const double z = a.zz - lzx * lzx - lzy * lzy, iz = z > cut ? 1 / std::sqrt(z) : 0;
  const double u = b.x * ix, v = (b.y - lyx * u) * iy, w = (b.z - lzx * u - lzy * v) * iz;
  Vec3 g;
  g.z = w * iz;
  g.y = (v - lzy * g.z) * iy;
  g.x = (u - lyx * g.y - lzx * g.z) * ix;
  return g;
}

}  // namespace

Vec3 GradientStencil::centre(LocalId cell) const {
  const Hex& hex = mesh_.hexes[static_cast<std::size_t>(cell)];
  if (mesh_.lattice[0] != 0)
    return 0.5 * (mesh_.position[static_cast<std::size_t>(hex[0])] +
                  mesh_.position[static_cast<std::size_t>(hex[6])]);
  Vec3 sum;
  for (const LocalId n : hex) sum += mesh_.position[static_cast<std::size_t>(n)];
  return 0.125 * sum;
}

// The cells that share a node with this one, and itself, ascending. In a lattice: the 3x3x3 block around it.
void GradientStencil::find_cells(LocalId cell) {
  cells_.clear();
  const auto [nx, ny, nz] = mesh_.lattice;
  if (nx != 0) {
    const LocalId i = cell % nx, j = cell / nx % ny, k = cell / nx / ny;
    for (LocalId c = std::max(k - 1, 0); c <= std::min(k + 1, nz - 1); ++c)
      for (LocalId b = std::max(j - 1, 0); b <= std::min(j + 1, ny - 1); ++b)
        for (LocalId a = std::max(i - 1, 0); a <= std::min(i + 1, nx - 1); ++a)
          cells_.push_back(a + nx * (b + ny * c));
    return;
  }
  for (const LocalId n : mesh_.hexes[static_cast<std::size_t>(cell)])
    for (const std::int32_t item : around_[n]) cells_.push_back(item / 8);
  std::sort(cells_.begin(), cells_.end());
  cells_.erase(std::unique(cells_.begin(), cells_.end()), cells_.end());
}

void GradientStencil::gather(LocalId cell) {
  find_cells(cell);
  const Vec3 here = centre(cell);
  neighbours_.clear();
  for (const LocalId c : cells_) neighbours_.push_back({c, 0, centre(c) - here, 1});
}

// Whether two cells have a node in common that is on all of these sides of the box.
bool GradientStencil::share_node_on(LocalId cell, LocalId other, std::uint8_t sides) const {
  const Hex& hex = mesh_.hexes[sculpt::at(cell)];
  for (const LocalId n : mesh_.hexes[sculpt::at(other)])
    if ((mesh_.box_sides[sculpt::at(n)] & sides) == sides &&
        std::find(hex.begin(), hex.end(), n) != hex.end())
      return true;
  return false;
}

// Images of the cells that would share a node with the cell if the mesh went on, mirrored, beyond the sides
// of the box: for every set of sides those that share a node on all of them. (No node is on opposite sides,
// so images across one are no neighbours across the other.)
void GradientStencil::mirror(LocalId cell) {
  if (!mesh_.exterior.empty()) return;
  const Hex& hex = mesh_.hexes[static_cast<std::size_t>(cell)];
  for (std::size_t d = 0; d < 3; ++d)
    for (const std::uint8_t side :
         {static_cast<std::uint8_t>(1U << (2 * d)), static_cast<std::uint8_t>(2U << (2 * d))}) {
      const auto on_side = [&](LocalId n) {
        return (mesh_.box_sides[static_cast<std::size_t>(n)] & side) != 0;
      };
      const auto touch = std::find_if(hex.begin(), hex.end(), on_side);
      if (touch == hex.end()) continue;
      const double plane = mesh_.position[static_cast<std::size_t>(*touch)][d] - centre(cell)[d];
      const std::size_t before = neighbours_.size();
      for (std::size_t i = 0; i < before; ++i) {
        Neighbour image = neighbours_[i];
        image.sides |= side;
        if (!share_node_on(cell, image.cell, image.sides)) continue;
        image.offset[d] = 2 * plane - image.offset[d];
        neighbours_.push_back(image);
      }
    }
}

void GradientStencil::weigh() {
  const Vec3 in_cells{1 / mesh_.cell_size.x, 1 / mesh_.cell_size.y, 1 / mesh_.cell_size.z};
  for (Neighbour& n : neighbours_) {
    const Vec3 d = scaled(n.offset, in_cells);
    n.weight = dot(d, d) > 0 ? 1 / dot(d, d) : 0;  // the cell itself tells nothing
  }
}

const std::vector<GradientStencil::Entry>& GradientStencil::at(LocalId cell) {
  gather(cell);
  entries_.clear();
  for (const LocalId c : cells_) {
    const auto first = fractions_.offset[static_cast<std::size_t>(c)],
               last = fractions_.offset[static_cast<std::size_t>(c) + 1];
    for (auto e = first; e < last; ++e) {
      const std::int32_t m = fractions_.material[static_cast<std::size_t>(e)];
      if (std::none_of(entries_.begin(), entries_.end(), [m](const Entry& x) { return x.material == m; }))
        entries_.push_back({m, {}});
    }
  }
  std::sort(entries_.begin(), entries_.end(),
            [](const Entry& a, const Entry& b) { return a.material < b.material; });
  mirror(cell);
  if (mesh_.lattice[0] == 0) weigh();

  Symmetric matrix;
  for (const Neighbour& n : neighbours_) {
    const Vec3 &d = n.offset, w = n.weight * d;
    matrix.xx += w.x * d.x;
    matrix.xy += w.x * d.y;
    matrix.xz += w.x * d.z;
    matrix.yy += w.y * d.y;
    matrix.yz += w.y * d.z;
    matrix.zz += w.z * d.z;
  }
  for (Entry& entry : entries_) {
    const double here = fraction_of(fractions_, cell, entry.material);
    Vec3 side;
    for (const Neighbour& n : neighbours_)
      side += (n.weight * (fraction_of(fractions_, n.cell, entry.material) - here)) * n.offset;
    entry.gradient = solve(matrix, side);
  }
  return entries_;
}

}  // namespace sculpt
