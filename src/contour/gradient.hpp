#pragma once
// Least-squares gradients of volume fractions at cell centres (equation 2.1 of the report). Local.
#include <vector>

#include "sculpt/input/material_source.hpp"
#include "sculpt/mesh/adjacency.hpp"

namespace sculpt {

// Gradients of the fractions of all materials around one cell after another; keeps its working storage.
class GradientStencil {
 public:
  GradientStencil(const HexMesh& mesh, const Fractions& fractions, const NodeHexes& around)
      : mesh_(mesh), fractions_(fractions), around_(around) {}

  struct Entry {
    std::int32_t material;
    Vec3 gradient;
  };
  // Every material in the cell or a cell that shares a node with it, ascending. The stencil is mirrored at
  // the sides of a box (not at an exterior), so that interfaces leave it at right angles; a direction without
  // neighbours gets no gradient. In a lattice all neighbours weigh the same, in other meshes by the inverse
  // square of their distance: there some are much nearer than others.
  const std::vector<Entry>& at(LocalId cell);

 private:
  struct Neighbour {
    LocalId cell;
    std::uint8_t sides;  // of the box, across which it is an image
    Vec3 offset;
    double weight;
  };
  [[nodiscard]] Vec3 centre(LocalId cell) const;
  void find_cells(LocalId cell);
  void gather(LocalId cell);
  void mirror(LocalId cell);
  void weigh();
  [[nodiscard]] bool share_node_on(LocalId cell, LocalId other, std::uint8_t sides) const;

  const HexMesh& mesh_;
  const Fractions& fractions_;
  const NodeHexes& around_;
  std::vector<LocalId> cells_;
  std::vector<Neighbour> neighbours_;
  std::vector<Entry> entries_;
};

}  // namespace sculpt
