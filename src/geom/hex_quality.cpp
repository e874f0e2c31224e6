#include "sculpt/geom/hex_quality.hpp"

#include <limits>

#include "geom/load_corners.hpp"

namespace sculpt {
namespace {

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

}  // namespace

HexQuality quality_of(const std::vector<Hex>& hexes, const std::vector<Vec3>& position,
                      std::span<const LocalId> which) {
  HexQuality quality;
  measure(hexes.data(), position.data(), which.data(), which.size(), quality);
  return quality;
}

}  // namespace sculpt
