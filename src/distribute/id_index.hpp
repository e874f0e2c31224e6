#pragma once
// Distinct node numbers of some hexes and the way back from a number to its position among them.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sculpt/base/types.hpp"

namespace sculpt {

class IdIndex {
 public:
  explicit IdIndex(std::span<const std::array<GlobalId, 8>> corners);
  [[nodiscard]] const std::vector<GlobalId>& ids() const { return ids_; }  // ascending
  [[nodiscard]] LocalId index(GlobalId id) const;                          // kNone for others

 private:
  std::vector<GlobalId> ids_;
  // Where the numbers lie so close that it takes less memory than they do: a bit for each number from
  // start_ on, and how many are set before each word.
  GlobalId start_ = 0;
  std::vector<std::uint64_t> bits_;
  std::vector<LocalId> before_;
};

}  // namespace sculpt
