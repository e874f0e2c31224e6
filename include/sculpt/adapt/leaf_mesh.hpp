#pragma once
// The mesh of a refined overlay grid: the cells of all leaves of a forest, conforming, no node hanging, with
// layers of ghost cells. The ranks own boxes of blocks of level 0 with everything that these were refined
// into.
#include <optional>
#include <vector>

#include "sculpt/adapt/forest.hpp"
#include "sculpt/distribute/block_parts.hpp"
#include "sculpt/grid/grid.hpp"
#include "sculpt/mesh/hex_mesh.hpp"
#include "sculpt/par/comm.hpp"

namespace sculpt {

// A block of cells of one level. A block beside refined ones is in transition: its hexes are not cubes.
struct Leaf {
  std::int32_t level = 0;
  Index3 block{0, 0, 0};  // of its level
  bool transition = false;
  LocalId first = 0, end = 0;  // its hexes in the mesh
};

struct LeafMesh {
  HexMesh cells;             // materials are left unset
  std::vector<Leaf> leaves;  // those whose hexes are owned, in the order of these
};

// Collective. The cells of a closed forest on a grid. Ids do not depend on the parts. Nodes of cells that are
// cubes of one level have the parity of their lattice position as colour, all others a colour of 8 or more.
// `high` is the upper corner of the domain where the grid ends beyond it.
// Throws AgreedError where ids or local indices would overflow.
[[nodiscard]] LeafMesh leaf_mesh(const Comm& comm, const Grid& grid, const Forest& forest,
                                 const BlockParts& parts, int layers,
                                 const std::optional<Vec3>& high = std::nullopt);

// Local. How many hexes a block of level 0 of a closed forest becomes.
[[nodiscard]] std::int64_t hexes_in(const Forest& forest, const Index3& base_block);

// Corners of a cell of a level, between the planes of the grid.
[[nodiscard]] Vec3 grid_point(const Grid& grid, int level, const Index3& corner);

}  // namespace sculpt
