#pragma once
// A closed bumpy surface of triangles with a hollow in it, as an STL file.
#include <cstdint>
#include <string>

namespace microstructure {

struct PebbleOptions {
  std::int64_t level = 4;  // 8 * 4^level triangles of the outside, and as many of the hollow
  std::uint64_t seed = 1;
};

// Writes a binary STL file: a pebble about the origin with a radius from 1 to about 1.4, hollow within 0.5.
// Calculates with +, -, *, / and square roots only.
void write_pebble(const std::string& path, const PebbleOptions& options);

}  // namespace microstructure
