#pragma once
// The trilinear hexahedron: numbering (Exodus), quality and volume. Scaled Jacobian: equations 2.7 and 2.8 of
// the report, the minimum over the eight corners.
#include <array>

#include "sculpt/base/types.hpp"
#include "sculpt/base/vec3.hpp"

namespace sculpt {

using Hex = std::array<LocalId, 8>;
using HexCorners = std::array<Vec3, 8>;

// Edge neighbours of each corner, ordered so that a right-handed hex has positive determinants.
inline constexpr std::array<std::array<int, 3>, 8> kCornerNeighbours{
    {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}}};

// Corners of each face, outward by the right-hand rule, in the order of the Exodus sides 1..6:
//   0: -y  1: +x  2: +y  3: -x  4: -z  5: +z   (of the unit cell)
inline constexpr std::array<std::array<int, 4>, 6> kFaces{
    {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {0, 4, 7, 3}, {0, 3, 2, 1}, {4, 5, 6, 7}}};

// Axis and sign of each face of a lattice cell.
inline constexpr std::array<int, 6> kFaceAxis{1, 0, 1, 0, 2, 2};
inline constexpr std::array<int, 6> kFaceSign{-1, 1, 1, -1, -1, 1};

// Corner (dx,dy,dz) of a lattice cell.
inline constexpr std::array<std::array<int, 3>, 8> kCornerOffset{
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};

// Scaled Jacobian at one corner, in [-1,1]; 0 when an edge there has no length.
[[nodiscard]] double corner_scaled_jacobian(const HexCorners& p, int corner);
// Minimum over the eight corners.
[[nodiscard]] double scaled_jacobian(const HexCorners& p);
// Determinant of the three edges at a corner (8 times the Jacobian there for the unit reference cube).
[[nodiscard]] double corner_determinant(const HexCorners& p, int corner);
// Exact volume of the trilinear hex (2x2x2 Gauss points).
[[nodiscard]] double hex_volume(const HexCorners& p);
// Whether the Jacobian is positive everywhere in the hex: by its 27 Bezier coefficients, subdividing where
// they do not decide (Johnen, Weill, Remacle 2017). Undecided after `depth` subdivisions counts as not
// positive.
[[nodiscard]] bool is_positive_inside(const HexCorners& p, int depth = 4);
[[nodiscard]] double shortest_edge(const HexCorners& p);

}  // namespace sculpt
