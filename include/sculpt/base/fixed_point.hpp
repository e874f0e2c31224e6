#pragma once
// Sums that do not depend on the order of their terms: whole numbers of 2^-30. Up to 2^33 terms of size 1.
#include <cmath>
#include <cstdint>

namespace sculpt {

inline constexpr double kUnits = 1073741824.0;  // 2^30

[[nodiscard]] inline std::int64_t to_units(double value) { return std::llround(kUnits * value); }
[[nodiscard]] inline double from_units(std::int64_t units) { return static_cast<double>(units) / kUnits; }

}  // namespace sculpt
