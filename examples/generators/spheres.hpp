#pragma once
// A packing of balls of several sizes, as shapes.
#include <cstdint>
#include <string>

namespace microstructure {

struct SphereOptions {
  std::int64_t box = 1000;  // edge of the cube [0,box]^3 that holds their centres
  std::int64_t count = 100;
  std::uint64_t seed = 1;
};

// Writes a diatom file of balls of material 1 that do not overlap; together they would fill 0.3 of the box if
// none reached out of it. Throws where there is no room for so many in so small a box.
void write_spheres(const std::string& path, const SphereOptions& options);

}  // namespace microstructure
