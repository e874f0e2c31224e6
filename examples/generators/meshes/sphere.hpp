#pragma once
// The cube [-1,1]^3 with a ball inside, in hexes whose faces follow the sphere.
#include "mesh.hpp"

namespace hexmesh {

struct SphereOptions {
  std::int32_t n = 8;        // hexes along an edge of the cube
  std::int32_t inside = 4;   // layers between the core of the ball and the sphere
  std::int32_t outside = 4;  // layers between the sphere and the cube
  double radius = 0.6;
};

// Seven blocks: 1 the ball (a rounded cube of n^3 hexes and six frusta around it), 2 .. 7 the frusta between
// the sphere and the sides of the cube, in the order -x +x -y +y -z +z.
[[nodiscard]] Mesh sphere_in_cube(const SphereOptions& options);

}  // namespace hexmesh
