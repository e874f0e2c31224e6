#pragma once
// Volume fractions of analytic shapes in boxes, the cells of a grid among them.
#include <functional>
#include <memory>
#include <vector>

#include "input/inserted_shape.hpp"
#include "sculpt/grid/grid.hpp"
#include "sculpt/input/material_source.hpp"

namespace sculpt {

// How cells that several materials may share are measured: as CellMeter or as PointMeter says.
enum class FractionMethod { kLines, kPoints };

// Local. The field of MaterialSource for shapes; `outside` is the material of what no shape covers. Boxes
// that one material fills are exact, the others are measured. The grid tells where most
// boxes will be.
[[nodiscard]] std::unique_ptr<MaterialField> shape_field(
    std::shared_ptr<const std::vector<InsertedShape>> shapes, const Grid& grid, std::int32_t outside,
    FractionMethod method = FractionMethod::kLines);

// Local. The field of MaterialSource for shapes in hexes; the grid tells where most hexes will be. Box hexes
// get what shape_field() says of the box, to the last bit.
[[nodiscard]] std::unique_ptr<HexField> shape_hex_field(
    std::shared_ptr<const std::vector<InsertedShape>> shapes, const Grid& grid, std::int32_t outside,
    FractionMethod method = FractionMethod::kLines);

using MakeField = std::function<std::unique_ptr<MaterialField>()>;

// Local. The fractions of the cells of a box of the grid, x fastest, measured by so many threads with a field
// each; they are the same for any number of threads. make_field may be called by several threads at once.
[[nodiscard]] Fractions measure_cells(const Grid& grid, const IndexBox& box, const MakeField& make_field,
                                      int threads);

}  // namespace sculpt
