#pragma once
// The faces of the finished mesh that have a hex on one side only, or hexes of two blocks: what sets are made
// of that ask for places and blocks, not for where a face comes from.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sculpt/geom/shape.hpp"
#include "sculpt/mesh/adjacency.hpp"
#include "sculpt/mesh/hex_mesh.hpp"
#include "sculpt/write/write_mesh.hpp"

namespace sculpt {

// A face on the boundary of the mesh that the files hold, where periodic meshes end at their sides.
struct BoundaryFace {
  LocalId hex;        // no image
  std::int32_t face;  // kFaces index
  std::int32_t side;  // bit number of the BoxSide that it lies on; -1: on none
};

// Local. All those at the nodes of owned hexes, some more around, ascending in (hex, face). The sides are
// told of meshes that have a box. The mesh needs one ghost layer.
[[nodiscard]] std::vector<BoundaryFace> boundary_faces(const HexMesh& mesh, const FaceNeighbours& neighbours);

// A closed box that reaches a thousandth of a cell farther than `ends` (xmin ymin zmin xmax ymax zmax): no
// node beside a plane of the mesh is that close to it.
[[nodiscard]] Box widened(const std::array<double, 6>& ends, const Vec3& cell_size);

// Local. The faces of owned hexes whose nodes all lie in a box, as faces of a set; the nodes of owned hexes
// that lie in it, ascending.
[[nodiscard]] std::vector<SideFace> faces_in(const HexMesh& mesh, std::span<const BoundaryFace> boundary,
                                             const Box& box, std::int64_t set);
[[nodiscard]] std::vector<LocalId> nodes_in(const HexMesh& mesh, std::span<const BoundaryFace> boundary,
                                            const Box& box);

// Two blocks that touch, by their dense indices, the smaller one first; one block and kNothing: where it ends
// at what is not meshed.
struct BlockPair {
  static constexpr std::int32_t kNothing = 2147483647;
  std::int32_t first, second;
  auto operator<=>(const BlockPair&) const = default;
};

// The faces between blocks, each listed once by the hex of the larger block, and those on the boundary but
// not on the sides of the box.
struct Contacts {
  std::vector<BlockPair> pairs;  // on all ranks, those of two blocks first, ascending
  std::vector<SideFace> faces;   // of owned hexes; set = index of the pair
};

// Collective. The mesh has a box.
[[nodiscard]] Contacts find_contacts(const Comm& comm, const HexMesh& mesh, const FaceNeighbours& neighbours,
                                     std::span<const BoundaryFace> boundary);

}  // namespace sculpt
