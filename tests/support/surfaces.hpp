#pragma once
// Made-up surfaces of triangles, as lists of facets and as STL files.
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sculpt/facets/facet_mesh.hpp"

namespace sculpt::test {

using Facets = std::vector<std::array<Vec3, 3>>;  // normals outwards

[[nodiscard]] Facets box_facets(const Vec3& lo, const Vec3& hi);
// About the origin, with the given radius towards each direction (a unit vector).
[[nodiscard]] Facets ball_facets(int slices, const std::function<double(const Vec3&)>& radius);
[[nodiscard]] Facets turned(Facets facets);
[[nodiscard]] Facets moved(Facets facets, const Vec3& by);
[[nodiscard]] Facets operator+(Facets a, const Facets& b);

[[nodiscard]] std::string binary_stl(const Facets& facets, const std::string& header = "");
[[nodiscard]] std::string ascii_stl(const Facets& facets, const std::string& name = "part");
// The repaired mesh of the facets.
[[nodiscard]] FacetMesh mesh_of(const Facets& facets);

// How often the facets go round a point, by their solid angles (van Oosterom and Strackee 1983).
[[nodiscard]] double winding_by_angles(const Facets& facets, const Vec3& p);

}  // namespace sculpt::test
