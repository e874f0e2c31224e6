#pragma once
// The share of a box behind a surface that is one gentle sheet there.
#include <optional>

#include "sculpt/geom/shape.hpp"

namespace sculpt {

// Of a box that no edge of the shape reaches. The surface is known as heights over a face of the box, from 4
// x 4 lines of the shape along its steepest axis; between them they are interpolated. Nothing where four more
// lines, a line without the sheet or one that meets another sheet show that this would not do. Error below
// 5e-4 of the box.
[[nodiscard]] std::optional<double> sheet_share(const Shape& shape, const Box& box);

}  // namespace sculpt
