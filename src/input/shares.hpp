#pragma once
// What the materials get of one cell.
#include <algorithm>
#include <cstdint>
#include <vector>

#include "sculpt/input/material_source.hpp"

namespace sculpt {

// Adds up what each material gets, and tells it in ascending order.
class Shares {
 public:
  explicit Shares(std::int32_t materials) : sum_(static_cast<std::size_t>(materials), 0.0) {}

  // share > 0
  void add(std::int32_t material, double share) {
    double& sum = sum_[static_cast<std::size_t>(material)];
    if (sum == 0) present_.push_back(material);
    sum += share;
  }
  // Appends the shares as a cell and forgets them; those that are not above `least` are rounding.
  void move_to(Fractions& out, double least = 0) {
    std::sort(present_.begin(), present_.end());
    double whole = 0;
    for (const std::int32_t m : present_) whole += counted(m, least);
    for (const std::int32_t m : present_) {
      if (counted(m, least) > 0) out.add(m, counted(m, least) / whole);
      sum_[static_cast<std::size_t>(m)] = 0;
    }
    out.end_cell();
    present_.clear();
  }

 private:
  [[nodiscard]] double counted(std::int32_t m, double least) const {
    const double sum = sum_[static_cast<std::size_t>(m)];
    return sum > least ? sum : 0;
  }

  std::vector<double> sum_;  // by material; 0: not present
  std::vector<std::int32_t> present_;
};

}  // namespace sculpt
