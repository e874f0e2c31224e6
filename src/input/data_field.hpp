#pragma once
// Materials known as fractions of the cells of a grid, asked for in boxes that need not be its cells.
#include <memory>

#include "sculpt/grid/grid.hpp"
#include "sculpt/input/material_source.hpp"

namespace sculpt {

// The field of MaterialSource for data. `fractions`: of the cells of the box `known` of the grid, x fastest.
// Holds 4 bytes per cell where each cell has one material, what `fractions` holds otherwise.
[[nodiscard]] std::unique_ptr<MaterialField> data_field(const Grid& grid, const IndexBox& known,
                                                        Fractions fractions);

}  // namespace sculpt
