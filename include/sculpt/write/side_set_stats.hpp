#pragma once
// What the option compute_ss_stats tells of every side set.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sculpt/geom/shape.hpp"
#include "sculpt/mesh/hex_mesh.hpp"
#include "sculpt/write/write_mesh.hpp"

namespace sculpt {

// Of a quad, whose corners go around it: the area, the mean of those by its two diagonals, and the scaled
// Jacobian, the least sine of its corners, against the normal in the middle (1 for a rectangle, 0 or less
// where a corner is flat or turned over).
[[nodiscard]] double quad_area(const std::array<Vec3, 4>& corner);
[[nodiscard]] double quad_scaled_jacobian(const std::array<Vec3, 4>& corner);

struct SideSetStats {
  std::int64_t id = 0, faces = 0;
  double area = 0;                       // in the units of the mesh, squared
  double least = 0, mean = 0, most = 0;  // scaled Jacobian of the faces; 0 without faces
  Box bounds{};                          // of the nodes; meaningless without faces
};

// Collective. ids: of all sets, ascending; faces: of owned hexes. Sums are whole units of 2^-30 (of the area
// of a cell), so that they do not depend on the number of ranks.
[[nodiscard]] std::vector<SideSetStats> side_set_stats(const Comm& comm, const HexMesh& mesh,
                                                       std::span<const std::int64_t> ids,
                                                       std::span<const SideFace> faces);

}  // namespace sculpt
