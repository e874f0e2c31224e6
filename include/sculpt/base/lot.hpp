#pragma once
// A number that an id draws: the same everywhere, without any order that spreads through a mesh (splitmix64).
// Ties that are broken by it leave no long chains of entities that wait for each other.
#include <cstdint>

namespace sculpt {

[[nodiscard]] inline std::uint64_t lot_of(std::int64_t id) {
  std::uint64_t z = static_cast<std::uint64_t>(id) + 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31);
}

}  // namespace sculpt
