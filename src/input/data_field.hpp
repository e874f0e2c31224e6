#pragma once
// Materials known as fractions of the cells of a grid, asked for in boxes that need not be its cells.
#include <memory>

#include "input/shares.hpp"
#include "sculpt/grid/grid.hpp"
#include "sculpt/input/material_source.hpp"

namespace sculpt {

// A field that can also be asked for single cells of its grid, those that are known (BrokenPromise
// otherwise).
class VoxelField : public MaterialField {
 public:
  using MaterialField::sole_material;
  // Adds the materials of a cell, times the weight.
  virtual void add(const Index3& cell, double weight, Shares& shares) const = 0;
  // The material that fills all cells of a box that is not empty; nothing when several do.
  [[nodiscard]] virtual std::optional<std::int32_t> sole_material(const IndexBox& cells) const = 0;
};

// The field of MaterialSource for data. `fractions`: of the cells of the box `known` of the grid, x fastest.
// Holds 4 bytes per cell where each cell has one material, what `fractions` holds otherwise.
[[nodiscard]] std::unique_ptr<VoxelField> data_field(const Grid& grid, const IndexBox& known,
                                                     Fractions fractions);

}  // namespace sculpt
