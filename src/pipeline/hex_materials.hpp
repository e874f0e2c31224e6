#pragma once
// The materials of the hexes of an input mesh: from its element variables, or from a geometry source that is
// asked hex by hex; and the blocks of the mesh among them.
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sculpt/base/log.hpp"
#include "sculpt/deck/deck.hpp"
#include "sculpt/geom/hex.hpp"
#include "sculpt/input/material_source.hpp"
#include "sculpt/par/comm.hpp"

namespace sculpt {

// This rank's hexes that want materials.
struct HexList {
  std::size_t size = 0;
  std::function<HexCorners(std::size_t)> corners;
};

struct HexMaterials {
  MaterialTable table;
  bool void_added = false;  // the void of the table is no material of the input
  Fractions owned;          // of this rank's hexes, in their order
  ExactSurface exact;       // what the input knows of its surfaces
  GeometrySurfaces geometry;
  bool pure = true;  // on all ranks every hex holds one material only
};

// Collective. From a fraction per element variable. element: numbers of the hexes; value: one per variable of
// each hex. path: of the mesh, for messages. Throws AgreedError: no variables, or fractions that are none.
[[nodiscard]] HexMaterials materials_of_variables(const Comm& comm, const std::string& path,
                                                  std::span<const std::string> variables,
                                                  std::span<const GlobalId> element,
                                                  std::span<const double> value);

// Collective. From the geometry source of the deck. Space that it knows nothing of is void.
[[nodiscard]] HexMaterials materials_of_source(const Comm& comm, const Deck& deck, const HexList& hexes,
                                               const Log& log);

// The blocks of an input mesh that are materials of their own.
struct BlockMaterials {
  std::vector<std::int64_t> id;    // per block
  std::vector<std::uint8_t> kept;  // per block: it stays as it is
  std::vector<std::int32_t>
      block_of_hex;  // of each of this rank's hexes, when void belongs to the blocks; else empty
};

// Collective. Puts the blocks that are kept, or that what is void belongs to, among the materials; those
// materials of the source whose ids are taken by blocks get the next free ones. An added void that no hex
// holds goes. Materials ascend in id afterwards. Answers with the material of each block, kNone for blocks
// that are none.
[[nodiscard]] std::vector<std::int32_t> add_blocks(const Comm& comm, const Deck& deck,
                                                   HexMaterials& materials, const BlockMaterials& blocks,
                                                   const Log& log);

// A source of data that are known for the hexes of a Cartesian grid, on whichever ranks. cell: of each of
// this rank's hexes, in the numbering of the grid.
[[nodiscard]] std::unique_ptr<MaterialSource> grid_of_hexes(Grid grid, std::vector<GlobalId> cell,
                                                            HexMaterials materials);

}  // namespace sculpt
