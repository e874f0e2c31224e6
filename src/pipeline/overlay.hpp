#pragma once
// The overlay mesh that a run starts from: the grid of the input, refined, coarsened or as it is, with the
// volume fractions of its cells.
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sculpt/base/log.hpp"
#include "sculpt/deck/deck.hpp"
#include "sculpt/geom/features.hpp"
#include "sculpt/input/material_source.hpp"
#include "sculpt/mesh/adjacency.hpp"
#include "sculpt/mesh/hex_mesh.hpp"
#include "sculpt/pipeline/stages.hpp"
#include "sculpt/write/side_sets.hpp"

namespace sculpt {

// Sets of an input mesh that are carried over (gen_sidesets = input_mesh and those that add to it).
struct InputSets {
  struct Set {
    std::int64_t id;
    std::string name;
  };
  bool wanted = false;
  std::vector<Set> side_sets, node_sets;
  std::vector<SidePlan::Item> faces;         // of local cells
  std::vector<std::vector<GlobalId>> nodes;  // per node set: ids in the overlay mesh, ascending, of all ranks
};

// The overlay mesh with its materials, and its adjacency for the stages that work on it.
struct Overlay {
  HexMesh cells;
  Fractions fractions;
  MaterialTable materials;
  FaceNeighbours neighbours;
  std::optional<NodeHexes> around;
  Index3 grid{0, 0, 0};                     // cells per axis, all ranks; 0: no Cartesian grid
  std::optional<std::array<Vec3, 3>> axes;  // directions of the grid's axes in space, where it is turned
  Index3 numbered{0, 0, 0};                 // of a lattice: those of the grid that gives the cells their ids
  bool pure = true;                         // on all ranks every cell of the input holds one material only
  ExactSurface exact;                       // what the input knows of its surfaces
  std::shared_ptr<const GeometryFeatures> features;  // and of their edges and corners; null: nothing
  GeometrySurfaces geometry;                         // empty unless side sets are made of it
  // Of an input mesh.
  std::optional<HexMesh> kept;  // hexes that stay as they are; cells has the others
  std::map<std::int64_t, std::string> block_names;
  std::vector<std::uint8_t>
      is_block;  // per material: 1 = a block whose interfaces with others stay; may be empty
  InputSets sets;
};

// Collective. Opens and reads the input of the deck. Adjacency is left for later.
[[nodiscard]] Overlay read_overlay(const Comm& comm, const Deck& deck, const Log& log, Stages& stages);
// Local. The surfaces of the geometry; empty unless gen_sidesets asks for them.
[[nodiscard]] GeometrySurfaces wanted_surfaces(const Deck& deck, const MaterialSource& source);
// As read_overlay for a source that is open, on its grid.
[[nodiscard]] Overlay read_on_grid(const Comm& comm, const Deck& deck, MaterialSource& source, const Log& log,
                                   Stages& stages);

}  // namespace sculpt
