#pragma once
// Cross sections of quads, and the hexes that they sweep out.
#include <functional>
#include <span>

#include "mesh.hpp"

namespace hexmesh {

struct Section {
  struct Point {
    double x = 0, y = 0;
  };
  std::vector<Point> point;
  std::vector<Quad> quad;          // counter-clockwise
  std::vector<std::int32_t> part;  // per quad
  std::vector<std::int32_t> rim;   // the points of the outer circle, counter-clockwise
  double start = 0.625;            // where rim[0] is, in turns: the lower left
};

// A disc about the origin: a rounded square of n x n quads in the middle and `rings` rings of 4 n quads
// around it; part 0. Where the corners of the square are, three quads meet.
[[nodiscard]] Section disc(std::int32_t n, std::int32_t rings, double radius);

// Adds rings of quads around the rim, up to the given radii.
void add_rings(Section& section, std::span<const double> radii, std::int32_t part);

// Adds one ring with twice as many quads along its outside: every other quad is split in four,
//     +--+--+--+--+
//     |  |__|  |  |
//     | /    \ |  |
//     |/______\|__|
// so that lines where five and where three quads meet run along the sweep. The rim has an even number of
// points.
void add_doubling_ring(Section& section, double radius, std::int32_t part);

// Sweeps a section along z, one layer between two heights. block_of(part, layer) is the index of the block;
// below 0 leaves the place empty. Nodes that no hex uses are left out.
[[nodiscard]] Mesh sweep(const Section& section, std::span<const double> heights,
                         const std::function<std::int32_t(std::int32_t, std::int32_t)>& block_of);

}  // namespace hexmesh
