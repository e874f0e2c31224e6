#pragma once
// Volume fractions of analytic shapes on the cells of a grid. Where shapes overlap, the one inserted first
// wins.
#include <memory>
#include <span>
#include <vector>

#include "sculpt/geom/shape.hpp"
#include "sculpt/grid/grid.hpp"
#include "sculpt/input/material_source.hpp"

namespace sculpt {

struct InsertedShape {
  std::unique_ptr<Shape> shape;
  std::int32_t material = 0;  // dense index
};

// Local. The fractions of the cells of the box, x fastest; `outside` is the material of what no shape covers.
// Cells that one material fills are exact; the others are within about 1e-4 of the cell. A cell's values do
// not depend on the box.
[[nodiscard]] Fractions shape_fractions(const Grid& grid, const IndexBox& box,
                                        std::span<const InsertedShape> shapes, std::int32_t outside);

// The field of MaterialSource for shapes. A cell of a grid gets bitwise what shape_fractions() gives it.
[[nodiscard]] std::unique_ptr<MaterialField> shape_field(
    std::shared_ptr<const std::vector<InsertedShape>> shapes, std::int32_t outside);

}  // namespace sculpt
