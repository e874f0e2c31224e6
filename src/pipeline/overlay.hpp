#pragma once
// The overlay mesh that a run starts from: the grid of the input, refined, coarsened or as it is, with the
// volume fractions of its cells.
#include <optional>

#include "sculpt/base/log.hpp"
#include "sculpt/deck/deck.hpp"
#include "sculpt/input/material_source.hpp"
#include "sculpt/mesh/adjacency.hpp"
#include "sculpt/mesh/hex_mesh.hpp"
#include "sculpt/pipeline/stages.hpp"

namespace sculpt {

// The overlay mesh with its materials, and its adjacency for the stages that work on it.
struct Overlay {
  HexMesh cells;
  Fractions fractions;
  MaterialTable materials;
  FaceNeighbours neighbours;
  std::optional<NodeHexes> around;
  Index3 grid{0, 0, 0};      // cells per axis, all ranks
  Index3 numbered{0, 0, 0};  // of a lattice: those of the grid that gives the cells their ids
  bool pure = true;          // on all ranks every cell of the input holds one material only
  ExactSurface exact;        // what the input knows of its surfaces
};

// Collective. Opens and reads the input of the deck. Adjacency is left for later.
[[nodiscard]] Overlay read_overlay(const Comm& comm, const Deck& deck, const Log& log, Stages& stages);

}  // namespace sculpt
