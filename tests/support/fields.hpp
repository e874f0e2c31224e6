#pragma once
// Made-up materials that can be measured in any box, and the refined grids that follow from them.
#include <cstdint>
#include <memory>
#include <vector>

#include "sculpt/adapt/criteria.hpp"
#include "sculpt/adapt/forest.hpp"
#include "sculpt/distribute/block_parts.hpp"
#include "sculpt/input/material_source.hpp"
#include "support/cases.hpp"
#include "support/stages.hpp"

namespace sculpt::test {

inline constexpr std::array<bool, 3> kNotPeriodic{false, false, false};

[[nodiscard]] Grid unit_grid(const Index3& cells);

struct Ball {
  Vec3 centre;
  double radius;
  std::int32_t material;
};

// Material 1 where x[axis] > at, 0 elsewhere; exact.
[[nodiscard]] std::unique_ptr<MaterialField> half_space_field(std::size_t axis, double at);
// The same for any unit normal of which no component is near 0; exact up to rounding.
[[nodiscard]] std::unique_ptr<MaterialField> half_space_field(const Vec3& normal, double distance);
// Balls, the first one where they overlap, in material 0, as the reader of diatom files measures them.
[[nodiscard]] std::unique_ptr<MaterialField> balls_field(const Grid& grid, const std::vector<Ball>& balls);
// What a run knows of the surfaces of balls that do not touch.
[[nodiscard]] ExactSurface balls_surface(std::vector<Ball> balls);
// The cells of a case as data.
[[nodiscard]] std::unique_ptr<MaterialField> data_field_of(const Case& input);

// All blocks on rank 0.
[[nodiscard]] BlockParts alone(const Forest& forest);
// A closed forest of the cells that the criterion asks for.
[[nodiscard]] Forest marked(const Grid& grid, int levels, MaterialField& field,
                            const AdaptCriterion& criterion);
// Cells of the finest level by chance; closed.
[[nodiscard]] Forest random_forest(const Index3& cells, int levels, double share, std::uint64_t seed);
// Collective. The cells of a closed forest with the fractions of a field and their materials, not filtered.
[[nodiscard]] Overlay refined_overlay(const Comm& comm, const Grid& grid, const Forest& forest,
                                      const BlockParts& parts, MaterialField& field, int layers = 2);

}  // namespace sculpt::test
