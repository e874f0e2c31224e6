#pragma once
// The smooth surfaces of a faceted boundary, as CAD programs draw them: facets across whose common edges the
// normal hardly turns. Pure.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sculpt/base/vec3.hpp"

namespace sculpt {

struct FacetSurfaces {
  std::vector<std::int32_t> surface;  // per facet; from 0 in the order of the first facets
  std::vector<std::int32_t> corner;   // per vertex: its number among the corners, from 0, or -1
  std::int32_t surfaces = 0, corners = 0;
};

// Local. vertex: positions; facet: three vertices each, consistently oriented. Two facets are on one surface
// when a chain of facets leads from one to the other, each sharing an edge of just two facets with the next
// and having a normal that differs by at most `angle` degrees. At a corner three surfaces meet, or more.
[[nodiscard]] FacetSurfaces divide_facets(std::span<const Vec3> vertex,
                                          std::span<const std::array<std::int32_t, 3>> facet, double angle);

}  // namespace sculpt
