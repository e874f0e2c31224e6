#pragma once
// Primal contouring (the report, section 2.9): where the interface crosses the line between two cell centres,
// and where the nodes of the interface go.
#include <vector>

#include "sculpt/brep/interfaces.hpp"
#include "sculpt/input/material_source.hpp"
#include "sculpt/mesh/hex_mesh.hpp"

namespace sculpt {

// A point of the interface and its unit normal, which points from the smaller material to the larger.
struct Crossing {
  Vec3 point, normal;
};

// Position in [0,1] of the zero of the cubic with end values g0 >= 0 >= g1 and end slopes m0, m1
// (equations 2.5-2.6, slopes limited so that the cubic is monotone). Equal zeros at both ends: 1/2.
[[nodiscard]] double hermite_root(double g0, double g1, double m0, double m1);

// Local. Crossing of every quad whose two cells are at most in the first ghost layer; others are left zero.
// Gradients: least squares over the cells that share a node, mirrored at the box (equation 2.1).
[[nodiscard]] std::vector<Crossing> edge_crossings(const HexMesh& mesh, const Interfaces& faces,
                                                   const Fractions& fractions, const NodeHexes& around);

// Local. The point of the interface that an interface node at p belongs to: on surfaces the weighted mean of
// the projections to the crossing planes around the node, on curves and at vertices the mean of the
// projections to the pairwise intersections. Box sides are not considered. Right at owned nodes.
[[nodiscard]] Vec3 onto_interface(const HexMesh& mesh, const Interfaces& faces,
                                  const std::vector<Crossing>& crossings, std::size_t interface_node,
                                  const Vec3& p);

// Local. As onto_interface, but a surface node goes to the exact surface where the input knows it.
[[nodiscard]] Vec3 onto_geometry(const HexMesh& mesh, const Interfaces& faces,
                                 const std::vector<Crossing>& crossings, const ExactSurface& exact,
                                 std::size_t interface_node, const Vec3& p);

// Local. A point of the interface as far as the node may go there from its place in the overlay grid: along
// its box sides, and at most 0.7 of a cell per axis (0.45 on the box).
[[nodiscard]] Vec3 within_reach(const HexMesh& mesh, LocalId node, const Vec3& grid_position,
                                const Vec3& point);

// Collective. Moves every interface node of the mesh, from its place in the overlay grid, onto the interface
// within its reach.
void place_nodes(HexMesh& mesh, const Interfaces& faces, const std::vector<Crossing>& crossings);

}  // namespace sculpt
