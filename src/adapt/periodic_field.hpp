#pragma once
// A field whose opposite ends meet on some axes: boxes beyond an end are looked at one period away. Local.
#include <array>
#include <vector>

#include "sculpt/grid/grid.hpp"
#include "sculpt/input/material_source.hpp"

namespace sculpt {

class PeriodicField final : public MaterialField {
 public:
  PeriodicField(MaterialField& field, const Grid& grid, const std::array<bool, 3>& periodic)
      : field_(field), grid_(grid), periodic_(periodic) {}

  void measure(const Box& box, Fractions& out) override;
  std::optional<std::int32_t> sole_material(const Box& box) override;

 private:
  // Fills pieces_ with the boxes inside the ends that make up a box.
  void cut(const Box& box);
  void cut(const Box& box, std::size_t axis);

  MaterialField& field_;
  const Grid& grid_;
  std::array<bool, 3> periodic_;
  std::vector<Box> pieces_;
};

}  // namespace sculpt
