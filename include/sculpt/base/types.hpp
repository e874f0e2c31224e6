#pragma once
// Names of the numbers that every room uses.
#include <cstdint>

namespace sculpt {

using LocalId = std::int32_t;   // index into this rank's arrays, from 0; -1 = none
using GlobalId = std::int64_t;  // index or key that does not depend on the number of ranks

inline constexpr LocalId kNone = -1;

}  // namespace sculpt
