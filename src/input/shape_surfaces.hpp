#pragma once
// The surfaces of inserted shapes, for nodes that are to lie on them.
#include <memory>
#include <vector>

#include "input/inserted_shape.hpp"
#include "sculpt/grid/grid.hpp"
#include "sculpt/input/material_source.hpp"

namespace sculpt {

// Finds, of the shapes of either material, the nearest point of a surface that is not hidden in a shape which
// was inserted earlier or is of the same material; none farther than one and a half cells. Shapes that cannot
// tell their nearest point are passed over. The shapes live as long as the answer.
[[nodiscard]] ExactSurface surfaces_of(std::shared_ptr<const std::vector<InsertedShape>> shapes,
                                       const Grid& grid);

// The same search, answering with the shape, by its place in the order of insertion.
[[nodiscard]] std::function<std::optional<std::int32_t>(const Vec3&, std::int32_t, std::int32_t)>
nearest_shape_of(std::shared_ptr<const std::vector<InsertedShape>> shapes, const Grid& grid);

}  // namespace sculpt
