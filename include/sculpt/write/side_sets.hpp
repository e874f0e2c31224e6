#pragma once
// The side sets that the option gen_sidesets asks for. They are made on the overlay mesh, while it exists,
// from the cells' faces (SidePlan, in proportion to the interfaces and the sides of the box), and handed to
// the hexes of the final mesh by their ids, which tell the cell and the face that each hex stems from
// (pillow.hpp).
//
//   fixed     1 = faces on the sides of the box, 2 = faces of materials towards cells that are no part of
//             the mesh, 3 = faces between two materials
//   variable  one set per surface (brep.hpp): those on the sides of the box, those towards unmeshed cells,
//             and those between materials; ids from 1 in the order in which real Sculpt meets them: a
//             surface's first face is the one with the smallest (axis of its normal, grid plane, cell),
//             and the first faces ascend (of an input mesh: the smallest (cell, face))
//   rve       1..6 = the sides xmin, xmax, ymin, ymax, zmin, zmax of the box
//   rve_variable  these, and from 7 on the sets of `variable` that are not on the box, in the same order
//   geometric_surfaces, geometric_sidesets  faces between materials and towards cells that are no part of the
//             mesh, by a set that is told for each of them; faces on the box are in none
//   input_mesh_and_stl  the same
//   input_mesh_and_free_surfaces  one set per surface towards cells that are no part of the mesh (faces on
//             the exterior are none), in the order of `variable`
//
// A face between two meshed materials is listed once, by the cell of the larger dense material index. A set
// without faces does not appear. In a periodic mesh the sides of the box are the faces that have a partner
// one period away (docs/periodic.md): they count as sides of the box whatever material lies beyond. Where
// nothing is meshed beyond, the faces are exterior ones; a surface of `variable` that has lost all its faces
// so leaves a gap in the ids.
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "sculpt/brep/brep.hpp"
#include "sculpt/mesh/hex_mesh.hpp"
#include "sculpt/write/write_mesh.hpp"

namespace sculpt {

// What the owned cells contribute.
struct SidePlan {
  struct Item {
    GlobalId cell;
    std::int32_t at;  // inner: kFaces index; box: bit number of the BoxSide
    std::int64_t set;
  };
  std::vector<Item> inner;        // faces towards another material or an unmeshed cell
  std::vector<Item> box;          // faces on the sides of the box
  std::vector<Item> beside;       // faces of ghost cells on an exterior: parts of them may be of owned hexes
  std::vector<std::int64_t> ids;  // of its sets, on all ranks, ascending
  std::map<std::int64_t, std::string> names;  // of those that have one
};

// What the sets are made of. All of it lives while plan_side_sets() runs.
struct SideSetWish {
  int gen_sidesets = 0;  // a value of GenSidesets (deck.hpp); kSidesetsOff gives an empty plan
  // Cells per axis of the Cartesian grid that the ids are made of (numbered_grid), all 0 when the overlay
  // mesh is none (the planes of one axis then count as one).
  std::array<GlobalId, 3> grid{0, 0, 0};
  std::int64_t after = 0;         // ids up to this one are taken: those of the input mesh
  const HexMesh* kept = nullptr;  // hexes beside the cells that stay as they are
  // The set of a face, 0 = none; called for faces whose listed cell is owned. Of the values that need it.
  std::function<std::int64_t(const InterfaceQuad& quad)> set_of{};
};

// Collective. Fills plan.beside. Comes after the rest of the plan.
void share_exterior_faces(const HexMesh& cells, SidePlan& plan);

// Collective. drop: per cell, 1 = no part of the mesh; all of these have one material that no other cell has.
// brep is used where surfaces are told apart.
[[nodiscard]] SidePlan plan_side_sets(const Comm& comm, const HexMesh& cells,
                                      const FaceNeighbours& neighbours, const Interfaces& faces,
                                      const Brep& brep, std::span<const std::uint8_t> drop,
                                      const SideSetWish& wish);

// A face of a hex that is a part of a cell's face on the exterior.
struct ExteriorPart {
  GlobalId cell;
  std::int32_t at;  // kFaces index
  GlobalId hex;
  std::int32_t face;
  auto operator<=>(const ExteriorPart&) const = default;
};
// Local. Those of owned hexes of a mesh that has its exterior still, ascending.
[[nodiscard]] std::vector<ExteriorPart> exterior_parts(const HexMesh& mesh);

// Local. The faces of owned hexes of the final mesh, each once. stages: how often pillow() was called. parts:
// exterior_parts() before the mesh lost its exterior (join_hexes).
[[nodiscard]] std::vector<SideFace> side_faces(const SidePlan& plan, const HexMesh& mesh, int stages,
                                               std::span<const ExteriorPart> parts = {});

}  // namespace sculpt
