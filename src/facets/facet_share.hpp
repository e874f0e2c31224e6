#pragma once
// The mean winding number in a box, exactly.
#include <span>

#include "facets/crossing.hpp"
#include "sculpt/geom/shape.hpp"

namespace sculpt {

// `facets`: those that reach the box; `winding`: the number at `start`, a point of the box on no facet.
[[nodiscard]] double mean_winding(std::span<const Triangle> facets, const Box& box, const Vec3& start,
                                  int winding);

}  // namespace sculpt
