#pragma once
// Records about ids 0 .. count-1 that are kept by ranks, in equal ranges: who keeps those of an id.
#include <algorithm>

#include "sculpt/base/types.hpp"

namespace sculpt {

class IdRanges {
 public:
  IdRanges(GlobalId count, int ranks)
      : count_(count), width_(std::max<GlobalId>(1, (count + ranks - 1) / ranks)) {}
  [[nodiscard]] bool contains(GlobalId id) const { return id >= 0 && id < count_; }
  [[nodiscard]] std::size_t rank(GlobalId id) const { return static_cast<std::size_t>(id / width_); }
  // The ids of a rank begin here; the last ranks may have none.
  [[nodiscard]] GlobalId first(int rank) const { return std::min(count_, rank * width_); }
  [[nodiscard]] std::size_t size(int rank) const {
    return static_cast<std::size_t>(first(rank + 1) - first(rank));
  }

 private:
  GlobalId count_, width_;
};

}  // namespace sculpt
