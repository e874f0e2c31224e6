#include <limits>

#include "geom/load_corners.hpp"
#include "sculpt/geom/hex_quality.hpp"

namespace sculpt {
namespace {

SCULPT_INLINE Lanes determinant(const Vec3Lanes& a, const Vec3Lanes& b, const Vec3Lanes& c) {
  return dot(a, cross(b, c));
}

// Volume: Grandy (1997), exact for the trilinear hex.
SCULPT_KERNEL void measure_size(const Hex* hexes, const Vec3* position, const LocalId* which,
                                std::size_t count, const Vec3& unit, HexSize& out) {
  Corners p;
  load(hexes, position, which, count, p);
  for (auto& v : p) v = {v.x * unit.x, v.y * unit.y, v.z * unit.z};
  Lanes shortest = splat(std::numeric_limits<double>::infinity());
  for (std::size_t c = 0; c < 8; ++c)
    for (const int n : kCornerNeighbours[c]) {
      const Vec3Lanes edge = p[n] - p[c];
      shortest = smallest(shortest, dot(edge, edge));
    }
  shortest = root(shortest);
  const Vec3Lanes a = p[6] - p[1], b = p[7] - p[0], d = p[6] - p[3], e = p[2] - p[0], f = p[5] - p[0],
                  g = p[6] - p[4];
  const Lanes volume = (determinant(a + b, d, e) + determinant(b, d + f, g) + determinant(a, f, g + e)) / 12;
  for (std::size_t l = 0; l < 8; ++l) {
    out.volume[l] = volume[l];
    out.shortest_edge[l] = shortest[l];
  }
}

}  // namespace

HexSize size_of(const std::vector<Hex>& hexes, const std::vector<Vec3>& position,
                std::span<const LocalId> which, const Vec3& unit) {
  HexSize size;
  measure_size(hexes.data(), position.data(), which.data(), which.size(), unit, size);
  return size;
}

}  // namespace sculpt
