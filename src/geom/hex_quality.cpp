#include "sculpt/geom/hex_quality.hpp"

#include <limits>

#include "sculpt/geom/lanes.hpp"

namespace sculpt {
namespace {

using Corners = Vec3Lanes[8];

SCULPT_INLINE void load(const Hex* hexes, const Vec3* position, const LocalId* which, std::size_t count,
                        Corners& corner) {
  for (std::size_t c = 0; c < 8; ++c) {
    const Vec3* p[8];
    for (std::size_t l = 0; l < 8; ++l) p[l] = position + hexes[which[l < count ? l : 0]][c];
    corner[c] = {Lanes{p[0]->x, p[1]->x, p[2]->x, p[3]->x, p[4]->x, p[5]->x, p[6]->x, p[7]->x},
                 Lanes{p[0]->y, p[1]->y, p[2]->y, p[3]->y, p[4]->y, p[5]->y, p[6]->y, p[7]->y},
                 Lanes{p[0]->z, p[1]->z, p[2]->z, p[3]->z, p[4]->z, p[5]->z, p[6]->z, p[7]->z}};
  }
}

SCULPT_KERNEL void measure(const Hex* hexes, const Vec3* position, const LocalId* which, std::size_t count,
                           HexQuality& out) {
  Corners corner;
  load(hexes, position, which, count, corner);
  Lanes worst = splat(2), shortest = splat(std::numeric_limits<double>::infinity());
  for (std::size_t c = 0; c < 8; ++c) {
    const auto& n = kCornerNeighbours[c];
    const Vec3Lanes a = corner[n[0]] - corner[c], b = corner[n[1]] - corner[c], d = corner[n[2]] - corner[c];
    const Lanes aa = dot(a, a), bb = dot(b, b), dd = dot(d, d), lengths = root(aa * bb * dd);
    worst = smallest(worst, lengths > 0 ? dot(a, cross(b, d)) / lengths : splat(0));
    shortest = smallest(shortest, smallest(smallest(aa, bb), dd));
  }
  shortest = root(shortest);
  for (std::size_t l = 0; l < 8; ++l) {
    out.scaled_jacobian[l] = worst[l];
    out.shortest_edge[l] = shortest[l];
  }
}

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

HexQuality quality_of(const std::vector<Hex>& hexes, const std::vector<Vec3>& position,
                      std::span<const LocalId> which) {
  HexQuality quality;
  measure(hexes.data(), position.data(), which.data(), which.size(), quality);
  return quality;
}

HexSize size_of(const std::vector<Hex>& hexes, const std::vector<Vec3>& position,
                std::span<const LocalId> which, const Vec3& unit) {
  HexSize size;
  measure_size(hexes.data(), position.data(), which.data(), which.size(), unit, size);
  return size;
}

}  // namespace sculpt
