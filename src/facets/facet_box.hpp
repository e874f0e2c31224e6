#pragma once
// Boxes and facets.
#include "facets/crossing.hpp"
#include "sculpt/geom/shape.hpp"

namespace sculpt {

// Whether a facet reaches the inside of a box; may be true for one that passes by an edge of the box within
// rounding. One that lies in a face of the box does not.
[[nodiscard]] bool reaches(const Triangle& facet, const Box& box);

// A point of the box that lies on no plane of symmetry, so that surfaces made with a grid rarely pass it.
[[nodiscard]] Vec3 odd_point(const Box& box);

// The point of a facet nearest to p (Ericson 2005, section 5.1.5).
[[nodiscard]] Vec3 nearest_point(const Triangle& facet, const Vec3& p);

}  // namespace sculpt
