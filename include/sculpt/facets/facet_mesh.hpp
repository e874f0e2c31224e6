#pragma once
// A surface of triangles, as STL files give it, and what may be wrong with it. Local; lengths in the units of
// the file.
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sculpt/base/types.hpp"
#include "sculpt/base/vec3.hpp"
#include "sculpt/geom/shape.hpp"

namespace sculpt {

// Triangles are counter-clockwise seen from outside, once the surface has been repaired.
struct FacetMesh {
  std::vector<Vec3> vertices;  // no two at the same place
  std::vector<std::array<LocalId, 3>> triangles;
  std::vector<std::int64_t> facet;      // of each triangle: its number in the file, from 1, ascending
  std::vector<std::int32_t> part;       // of each triangle: its solid in the file, from 0
  std::vector<std::string> part_names;  // of each solid; may be empty
  // Filled by divide_facets().
  std::vector<std::int32_t> surface;  // of each triangle: its smooth surface, from 0
  std::vector<std::int32_t> corner;   // of each vertex: its number among the corners, or -1
  std::int32_t surfaces = 0, corners = 0;
};

[[nodiscard]] Box bounds_of(const FacetMesh& mesh);
// A vertex p comes to (p . axes[0], p . axes[1], p . axes[2]).
void turn_facets(FacetMesh& mesh, const std::array<Vec3, 3>& axes);

// What the triangles of a facet mesh share: each edge of two triangles or more joins them in a ring.
// next[t][e]: the triangle after t around the edge from its corner e to corner e + 1, ascending with the
// smallest after the largest; t itself where the edge is open.
using FacetNeighbours = std::vector<std::array<LocalId, 3>>;
[[nodiscard]] FacetNeighbours facet_neighbours(const FacetMesh& mesh);

// The facets of an STL file. The text is ASCII, of any number of solids, or binary: that is told by its size,
// as binary files may begin with the word solid. A file of no facets gives an empty mesh. Vertices with the
// same coordinates are one; degenerate facets are there. Throws Error with path and line or facet number.
[[nodiscard]] FacetMesh parse_stl(std::string_view text, const std::string& path);

// Defects of one kind: how many, and the first one.
struct Defects {
  std::int64_t count = 0;
  std::int64_t facet = 0;  // number in the file, from 1
  Vec3 place;              // its centre, or the middle of the edge
};

// What repair() found.
struct FacetReport {
  Defects degenerate;           // facets without area: dropped
  Defects duplicate;            // facets that were there already: dropped
  Defects flipped;              // facets turned round, so that all normals point outwards
  Defects welded;               // vertices moved onto another one that was almost there
  Defects open;                 // edges of one facet: there the surface is not closed
  Defects non_manifold;         // edges of more than two facets
  Defects inconsistent;         // edges of two facets that cannot be turned the same way
  std::int64_t components = 0;  // parts of the surface that hang together
};

// Drops, welds and turns facets as the report says. Facets of a component turn together; a component inside
// no other has its normals outwards; one inside another keeps its sense relative to that one, so that the
// inner surface of a hollow body stays one.
[[nodiscard]] FacetReport repair(FacetMesh& mesh);

// Figures of the triangles, for the console.
struct FacetSizes {
  double side_min = 0, side_max = 0;
  double angle_min = 0, angle_max = 0;  // degrees
  double area_min = 0, area_max = 0;
  double volume = 0;  // by the divergence theorem
};
[[nodiscard]] FacetSizes sizes_of(const FacetMesh& mesh);

}  // namespace sculpt
