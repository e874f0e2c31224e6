#pragma once
// The share of a box behind a surface that is one gentle sheet there.
#include <optional>

#include "sculpt/geom/shape.hpp"

namespace sculpt {

// Of a box in which the shape is gentle. The surface is known as heights over a face of the box, from 5 x 5
// lines of the shape along its steepest axis; between them they are interpolated. Nothing where four more
// lines, or a line without the sheet, show that this would not do. Error below 5e-4 of the box.
[[nodiscard]] std::optional<double> sheet_share(const Shape& shape, const Box& box);

}  // namespace sculpt
