#pragma once
// A field whose opposite ends meet on some axes. Local.
#include <array>

#include "sculpt/grid/grid.hpp"
#include "sculpt/input/material_source.hpp"

namespace sculpt {

class PeriodicField final : public MaterialField {
 public:
  PeriodicField(MaterialField& field, const Grid& grid, const std::array<bool, 3>& periodic)
      : field_(field), grid_(grid), periodic_(periodic) {}

  void measure(const Box& box, Fractions& out) override { field_.measure(wrapped(box), out); }
  std::optional<std::int32_t> sole_material(const Box& box) override {
    for (std::size_t d = 0; d < 3; ++d)  // a box across the end would have to be looked at in pieces
      if (periodic_[d] && box.lo[d] < grid_.planes[d].back() && box.hi[d] > grid_.planes[d].back())
        return std::nullopt;
    for (std::size_t d = 0; d < 3; ++d)
      if (periodic_[d] && box.lo[d] < grid_.planes[d].front() && box.hi[d] > grid_.planes[d].front())
        return std::nullopt;
    return field_.sole_material(wrapped(box));
  }

 private:
  // Moves a box whose middle is outside by one period.
  [[nodiscard]] Box wrapped(Box box) const {
    for (std::size_t d = 0; d < 3; ++d) {
      if (!periodic_[d]) continue;
      const double lo = grid_.planes[d].front(), hi = grid_.planes[d].back(),
                   middle = 0.5 * (box.lo[d] + box.hi[d]);
      const double move = middle < lo ? hi - lo : middle > hi ? lo - hi : 0;
      if (move == 0) continue;
      box.lo[d] += move;
      box.hi[d] += move;
    }
    return box;
  }

  MaterialField& field_;
  const Grid& grid_;
  std::array<bool, 3> periodic_;
};

}  // namespace sculpt
