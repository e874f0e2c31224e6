#pragma once
// The boundary representation of the overlay mesh (the report, section 2.8): which cells make up a volume,
// which quads a surface, which edges a curve, over all ranks. Numbers run from 0 and do not depend on the
// number of ranks.
//
//   volume   cells of one material that are connected through faces; the void is a material like others
//   surface  interface quads that are connected through edges where exactly two quads of one part meet; so
//            it lies between one pair of volumes, and two volumes may meet in several surfaces
//   curve    edges where other than two interface quads meet, or two of different parts, connected through
//   nodes of class kCurve;
//            a closed curve may have no vertex, a closed surface no curve
//   vertex   a node of class kVertex
#include <cstdint>
#include <vector>

#include "sculpt/brep/interfaces.hpp"
#include "sculpt/par/comm.hpp"

namespace sculpt {

struct Brep {
  std::vector<std::int32_t> volume;   // per local cell; ascending in (material, smallest cell id)
  std::vector<std::int32_t> surface;  // per interface quad; ascending in the smallest (cell id, face)
  std::int64_t volumes = 0, surfaces = 0, curves = 0, vertices = 0;  // on all ranks
};

// Collective. The cells need two ghost layers. Work: one pass over the cells, the rest in proportion to the
// interfaces.
[[nodiscard]] Brep build_brep(const Comm& comm, const HexMesh& cells, const FaceNeighbours& neighbours,
                              const Interfaces& faces);

// The bit number of the BoxSide between the domain and an image; where several are, that across the first
// axis; -1 for what is no image.
[[nodiscard]] int side_towards(const Image& image);

// Local. The bit number of the BoxSide that a face of a cell lies on, which may also be one of a periodic
// axis (there the neighbour is an image); -1 inside the box, for outer faces of the last ghost layer, and for
// images. Of a mesh with an exterior: the number of the surface.
[[nodiscard]] int side_of_box(const HexMesh& cells, const FaceNeighbours& neighbours, LocalId cell, int face);

// The faces of cells on the sides of the box, and the surfaces they form: those of one volume and one side of
// the box that are connected through edges.
struct BoxFaces {
  struct Face {
    LocalId cell;
    std::int32_t face;  // kFaces index
    std::int32_t side;  // bit number of the BoxSide, or number of the surface of the exterior
  };
  std::vector<Face> faces;            // of owned and ghost cells but images, ascending in (cell, face)
  std::vector<std::int32_t> surface;  // per face; ascending in the smallest (cell id, face)
  std::int64_t surfaces = 0;          // on all ranks
};

// Collective.
[[nodiscard]] BoxFaces trace_box_faces(const Comm& comm, const HexMesh& cells,
                                       const FaceNeighbours& neighbours,
                                       const std::vector<std::int32_t>& volume);

}  // namespace sculpt
