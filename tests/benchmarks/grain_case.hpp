#pragma once
// The case that the mesh kernels work on: n^3 cells, a grain per 1000 cells, on one rank.
#include "sculpt/input/material_source.hpp"
#include "sculpt/mesh/adjacency.hpp"
#include "sculpt/mesh/hex_mesh.hpp"
#include "sculpt/pillow/pillow.hpp"

namespace sculpt {

struct GrainCase {
  explicit GrainCase(int n);

  HexMesh cells;
  Fractions fractions;
  FaceNeighbours neighbours;
  NodeHexes around;

  [[nodiscard]] Pillowed pillowed() const;
};

}  // namespace sculpt
