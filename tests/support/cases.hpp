#pragma once
// Made-up inputs: a grid and, for every cell, fractions that depend on the cell's global indices and a seed
// only, so that any rank can ask for any box.
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sculpt/grid/grid.hpp"
#include "sculpt/input/material_source.hpp"

namespace sculpt::test {

struct Case {
  std::string name;
  Grid grid;
  std::int32_t materials = 1;
  std::function<void(const Index3&, Fractions&)> fill;  // adds the entries of one cell, not its end
  bool pure = false;                                    // one material per cell
  // Of cells of several sizes the level of a grid node, and the cell size at level 0. The mesh of such a case
  // is no lattice.
  std::function<std::uint8_t(const Index3&)> level{};
  Vec3 cell_size{};
  std::array<bool, 3> periodic{false, false, false};    // axes
};
// The same input, periodic in some axes.
[[nodiscard]] Case periodic(Case input, const std::array<bool, 3>& axes = {true, true, true});

// Fractions of the cells of a box, x fastest.
[[nodiscard]] Fractions fractions_in(const Case& input, const IndexBox& box);

// A number that depends on its arguments only, evenly spread over 64 bits.
[[nodiscard]] std::uint64_t scatter(std::uint64_t seed, std::uint64_t item);
// The same in [0,1).
[[nodiscard]] double scatter_unit(std::uint64_t seed, std::uint64_t item);

// One material per cell.
[[nodiscard]] Case voxels(const std::string& name, const Index3& cells, std::int32_t materials,
                          const std::function<std::int32_t(const Index3&)>& material);
// The same from a list, x fastest.
[[nodiscard]] Case voxels(const Index3& cells, const std::vector<std::int32_t>& material);
// Every cell on its own: the hardest input there is.
[[nodiscard]] Case noise(const Index3& cells, std::int32_t materials, std::uint64_t seed);
// Cells belong to the nearest of `grains` random points; several grains may share a material.
[[nodiscard]] Case grains(const Index3& cells, int grains, std::int32_t materials, std::uint64_t seed);
// Two materials whose fractions are random in every cell.
[[nodiscard]] Case two_phase_fractions(const Index3& cells, std::uint64_t seed);
// A ball of material 1 in material 0, in cells; fractions from 8^3 points per cell.
[[nodiscard]] Case ball(const Index3& cells, const Vec3& centre, double radius);
// Part of the unit cube at `corner` where n.x > distance; no component of n near 0.
[[nodiscard]] double part_above(const Vec3& corner, Vec3 n, double distance);
// Material 1 where normal . x > distance, exact fractions. Unit cells; no component of the unit normal near
// 0.
[[nodiscard]] Case half_space(const Index3& cells, const Vec3& normal, double distance);

// The same on a mesh that is no lattice, whose nodes all have this level.
[[nodiscard]] Case at_level(Case input, int level);
// Material 1 where inside(point), by 8^3 points per cell. Unit cells up to the index `fine` of each axis,
// cells of half that size beyond.
[[nodiscard]] Case graded(const Index3& cells, std::int64_t fine,
                          const std::function<bool(const Vec3&)>& inside);

}  // namespace sculpt::test
