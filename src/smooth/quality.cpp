#include "smooth/quality.hpp"

#include <limits>

#include "smooth/lanes.hpp"

namespace sculpt {
namespace {

SCULPT_KERNEL void measure(const Hex* hexes, const Vec3* position, const LocalId* which, std::size_t count,
                           HexQuality& out) {
  Vec3Lanes corner[8];
  for (std::size_t c = 0; c < 8; ++c) {
    const Vec3* p[8];
    for (std::size_t l = 0; l < 8; ++l) p[l] = position + hexes[which[l < count ? l : 0]][c];
    corner[c] = {Lanes{p[0]->x, p[1]->x, p[2]->x, p[3]->x, p[4]->x, p[5]->x, p[6]->x, p[7]->x},
                 Lanes{p[0]->y, p[1]->y, p[2]->y, p[3]->y, p[4]->y, p[5]->y, p[6]->y, p[7]->y},
                 Lanes{p[0]->z, p[1]->z, p[2]->z, p[3]->z, p[4]->z, p[5]->z, p[6]->z, p[7]->z}};
  }
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
