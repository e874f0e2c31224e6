#pragma once
// Names of the numbers that every room uses.
#include <cstddef>
#include <cstdint>

namespace sculpt {

using LocalId = std::int32_t;   // index into this rank's arrays, from 0; -1 = none
using GlobalId = std::int64_t;  // index or key that does not depend on the number of ranks

inline constexpr LocalId kNone = -1;

// A local id as an index of the standard containers.
[[nodiscard]] inline constexpr std::size_t at(LocalId id) { return static_cast<std::size_t>(id); }

}  // namespace sculpt
