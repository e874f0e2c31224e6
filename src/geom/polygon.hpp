#pragma once
// A polygon without crossings in a plane: the section of extrusions and solids of revolution.
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace sculpt {

using Point2 = std::array<double, 2>;

class Polygon {
 public:
  // At least three corners, in either sense, the last one joined to the first. Throws Error, whose text names
  // `what`, when neighbours are equal or sides touch others than their neighbours.
  Polygon(std::string_view what, std::span<const Point2> corners);

  [[nodiscard]] std::size_t size() const { return corners_.size(); }
  [[nodiscard]] const Point2& corner(std::size_t i) const { return corners_[i]; }
  // Side i leads from corner i to the next one.
  [[nodiscard]] const Point2& side_end(std::size_t i) const { return corners_[next(i)]; }
  [[nodiscard]] Point2 nearest_on_side(std::size_t i, const Point2& p) const;
  // Points of a side that has the inside at larger coordinates [0] count as inside.
  [[nodiscard]] bool inside(const Point2& p) const;
  // The neighbouring sides are parts of one line.
  [[nodiscard]] bool is_straight_at(std::size_t corner) const;
  [[nodiscard]] std::size_t next(std::size_t i) const { return i + 1 < corners_.size() ? i + 1 : 0; }
  [[nodiscard]] std::size_t previous(std::size_t i) const { return (i > 0 ? i : corners_.size()) - 1; }

 private:
  [[nodiscard]] bool sides_touch(std::size_t a, std::size_t b) const;

  std::vector<Point2> corners_;
};

[[nodiscard]]  // Of a vector; coordinates are far from the limits of doubles.
[[nodiscard]] inline double
length_of(double x, double y) {
  return std::sqrt(x * x + y * y);
}
double distance(const Point2& a, const Point2& b);

}  // namespace sculpt
