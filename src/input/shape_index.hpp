#pragma once
// Which shapes are near: uniform bins over space, fine enough that a bin holds few shapes.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "input/inserted_shape.hpp"
#include "sculpt/grid/grid.hpp"

namespace sculpt {

// The box of a grid.
[[nodiscard]] Box space_of(const Grid& grid);

// Shapes are told by their position in the order of insertion, ascending. Immutable.
class ShapeIndex {
 public:
  // `space`: where most questions will be asked; answers are right everywhere. A shape is near what its
  // bounds, grown by `reach` on all sides, overlap.
  ShapeIndex(std::span<const InsertedShape> shapes, const Box& space, double reach);

  // Replaces `found` by the shapes that are near the box (sharing faces is not enough).
  void find(const Box& box, std::vector<std::int32_t>& found) const;
  // The shapes near the point and some more.
  [[nodiscard]] std::span<const std::int32_t> around(const Vec3& p) const { return bin(number(bin_of(p))); }
  [[nodiscard]] bool is_near(std::int32_t shape, const Vec3& p) const {
    const Box& b = bounds_[static_cast<std::size_t>(shape)];
    return b.lo.x <= p.x && p.x <= b.hi.x && b.lo.y <= p.y && p.y <= b.hi.y && b.lo.z <= p.z && p.z <= b.hi.z;
  }

 private:
  // Lays bins of about this width over the space.
  void divide(const Box& space, double width);
  [[nodiscard]] std::size_t bins() const {
    return static_cast<std::size_t>(count_[0] * count_[1] * count_[2]);
  }
  [[nodiscard]] Index3 bin_of(const Vec3& p) const;  // the nearest one, for points beyond all bins
  [[nodiscard]] IndexBox bins_of(const Box& box) const;
  [[nodiscard]] std::size_t number(const Index3& b) const {
    return static_cast<std::size_t>(b[0] + count_[0] * (b[1] + count_[1] * b[2]));
  }
  [[nodiscard]] std::span<const std::int32_t> bin(std::size_t b) const {
    const auto from = static_cast<std::size_t>(offset_[b]), to = static_cast<std::size_t>(offset_[b + 1]);
    return {shape_.data() + from, to - from};
  }
  void fill();

  std::vector<Box> bounds_;  // grown
  Vec3 lo_, per_length_;     // corner of the first bin, bins per length
  Index3 count_{1, 1, 1};
  std::vector<std::int64_t> offset_;  // CSR over the bins, x fastest
  std::vector<std::int32_t> shape_;
};

}  // namespace sculpt
