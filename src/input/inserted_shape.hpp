#pragma once
// A shape of the input in its place in the order of insertion. Where shapes overlap, the one inserted first
// wins.
#include <cstdint>
#include <memory>

#include "sculpt/geom/shape.hpp"

namespace sculpt {

struct InsertedShape {
  std::unique_ptr<Shape> shape;
  std::int32_t material = 0;  // dense index
};

}  // namespace sculpt
