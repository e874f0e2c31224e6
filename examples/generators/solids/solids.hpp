#pragma once
// Closed surfaces of facets, as CAD programs write them into STL files. Outward normals by the right-hand
// rule, vertices of neighbours at the same coordinates.
#include <array>
#include <string>
#include <vector>

#include "sculpt/base/vec3.hpp"

namespace sculpt::examples {

using Facet = std::array<Vec3, 3>;
using Facets = std::vector<Facet>;

// The unit sphere around the origin: an octahedron whose facets are cut into four `levels` times.
[[nodiscard]] Facets sphere(int levels);
// The box from -half to half.
[[nodiscard]] Facets box(const Vec3& half);
// Axis z, around the origin; `sides` facets around.
[[nodiscard]] Facets cylinder(double radius, double half_height, int sides);
// Two plates at right angles, 0.35 thick, each with a hole: 2 x 1.2 along x and y, 1.2 x 1.8 along y and z,
// from the origin. sides: around each hole, a multiple of 4.
[[nodiscard]] Facets bracket(int sides);

// Turned about z, then about x; degrees.
void turn(Facets& facets, double about_z, double about_x);

[[nodiscard]] std::string ascii_stl(const Facets& facets, const std::string& name);
[[nodiscard]] std::string binary_stl(const Facets& facets, const std::string& header);

}  // namespace sculpt::examples
