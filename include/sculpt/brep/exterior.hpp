#pragma once
// Finds the exterior of an input mesh: its boundary faces, the surfaces that they form, and what the nodes
// there may do (the report, section 2.12.5.1).
#include <cstdint>
#include <functional>
#include <span>

#include "sculpt/brep/interfaces.hpp"
#include "sculpt/mesh/adjacency.hpp"
#include "sculpt/mesh/hex_mesh.hpp"
#include "sculpt/par/comm.hpp"

namespace sculpt {

struct ExteriorOptions {
  // Degrees, measured inside: an edge is a feature, which ends surfaces, where its faces meet at less, or at
  // more than 360 minus this.
  double feature_angle = 135;
  // Nodes may slide across the edges between facets of one surface. Otherwise they move only where that
  // leaves the shape as it is: in planes and along straight edges.
  bool slides = false;
  // Local. Faces with different labels belong to different surfaces. Empty: all alike.
  std::function<std::int64_t(LocalId cell, int face)> label{};
};

// Collective. Fills cells.exterior and cells.box_sides. kept: per local cell, 1 = it stays as it is and is
// about to leave the mesh (remove_hexes); its nodes are held where they are, and the faces of other cells
// towards it become facets. May be empty. The cells need two ghost layers.
void find_exterior(const Comm& comm, HexMesh& cells, const FaceNeighbours& neighbours,
                   std::span<const std::uint8_t> kept, const ExteriorOptions& options);

// Local. Holds the nodes of faces inside the mesh, too, as if these were on the boundary: faces between cells
// for which is_held (of cells in ascending order, the same on all ranks) tells so. The materials of the cells
// are known.
void hold_inside(const Comm& comm, HexMesh& cells, const FaceNeighbours& neighbours, bool slides,
                 const std::function<bool(LocalId cell, LocalId other)>& is_held);

// Collective. Marks the facets that must stay whole, surface by surface: those of curved surfaces that
// interfaces meet, which otherwise would not keep their shape (where nodes may slide across the edges they
// need not); and those of surfaces at whose edges an interface runs along the edge, since no copy of a node
// could both keep to the edge and leave room for the layers; and all surfaces that meet one of these, or a
// kept block, without much of a bend. `exterior` is that of the cells.
void keep_whole(const Comm& comm, Exterior& exterior, const HexMesh& cells, const Interfaces& faces);

}  // namespace sculpt
