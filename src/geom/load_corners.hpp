#pragma once
// The corners of up to eight hexes, one hex per lane.
#include "sculpt/geom/hex.hpp"
#include "sculpt/geom/lanes.hpp"

namespace sculpt {

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

}  // namespace sculpt
