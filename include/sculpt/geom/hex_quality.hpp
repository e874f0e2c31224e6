#pragma once
// Scaled Jacobians, edges and volumes of many hexes at once. Pure.
#include <array>
#include <span>
#include <vector>

#include "sculpt/base/types.hpp"
#include "sculpt/base/vec3.hpp"
#include "sculpt/geom/hex.hpp"

namespace sculpt {

// No hex whose corners are all this good has been seen to fold inside (docs/smoothing.md).
inline constexpr double kNeverFolds = 0.6;

struct HexQuality {
  std::array<double, 8> scaled_jacobian, shortest_edge;
};
// Of up to eight hexes; entries beyond `which.size()` are meaningless. Agrees with scaled_jacobian() up to
// rounding.
[[nodiscard]] HexQuality quality_of(const std::vector<Hex>& hexes, const std::vector<Vec3>& position,
                                    std::span<const LocalId> which);

struct HexSize {
  std::array<double, 8> volume, shortest_edge;
};
// Likewise, with every coordinate multiplied by `unit` of its axis. Agrees with hex_volume() up to rounding.
[[nodiscard]] HexSize size_of(const std::vector<Hex>& hexes, const std::vector<Vec3>& position,
                              std::span<const LocalId> which, const Vec3& unit);

}  // namespace sculpt
