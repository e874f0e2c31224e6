#include "geom/polygon.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sculpt/base/error.hpp"

namespace sculpt {
namespace {

// Twice the area of the triangle; positive when it turns left.
double turn(const Point2& a, const Point2& b, const Point2& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

double along(const Point2& from, const Point2& to, const Point2& p) {
  return (p[0] - from[0]) * (to[0] - from[0]) + (p[1] - from[1]) * (to[1] - from[1]);
}

bool on_segment(const Point2& a, const Point2& b, const Point2& p) {
  return turn(a, b, p) == 0 && along(a, b, p) >= 0 && along(b, a, p) >= 0;
}

std::string text(const Point2& p) { return fmt::format("({} {})", p[0], p[1]); }

}  // namespace

double distance(const Point2& a, const Point2& b) { return length_of(a[0] - b[0], a[1] - b[1]); }

Polygon::Polygon(std::string_view what, std::span<const Point2> corners)
    : corners_(corners.begin(), corners.end()) {
  if (size() < 3)
    throw Error(fmt::format("{}: its polygon has {} corners, expected at least 3", what, size()));
  for (std::size_t i = 0; i < size(); ++i) {
    if (!std::isfinite(corner(i)[0]) || !std::isfinite(corner(i)[1]))
      throw Error(fmt::format("{}: corner {} is {}, expected finite numbers", what, i + 1, text(corner(i))));
    if (corner(i) == side_end(i))
      throw Error(fmt::format("{}: corners {} and {} are both {}, expected different points", what, i + 1,
                              next(i) + 1, text(corner(i))));
  }
  for (std::size_t a = 0; a < size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (sides_touch(a, b))
        throw Error(
            fmt::format("{}: the sides of its polygon from corner {} and from corner {} touch, expected a "
                        "polygon without "
                        "crossings",
                        what, b + 1, a + 1));
}

// Neighbours: whether they have more than their corner in common.
bool Polygon::sides_touch(std::size_t a, std::size_t b) const {
  const Point2 &a1 = corner(a), &a2 = side_end(a), &b1 = corner(b), &b2 = side_end(b);
  if (next(b) == a) return on_segment(a1, a2, b1) || on_segment(b1, b2, a2);
  if (next(a) == b) return on_segment(a1, a2, b2) || on_segment(b1, b2, a1);
  if (on_segment(a1, a2, b1) || on_segment(a1, a2, b2) || on_segment(b1, b2, a1) || on_segment(b1, b2, a2))
    return true;
  return (turn(a1, a2, b1) > 0) != (turn(a1, a2, b2) > 0) && (turn(b1, b2, a1) > 0) != (turn(b1, b2, a2) > 0);
}

Point2 Polygon::nearest_on_side(std::size_t i, const Point2& p) const {
  const Point2 &a = corner(i), &b = side_end(i);
  const double t = std::clamp(along(a, b, p) / along(a, b, b), 0.0, 1.0);
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
}

bool Polygon::inside(const Point2& p) const {
  bool in = false;
  for (std::size_t i = 0; i < size(); ++i) {
    const Point2 &a = corner(i), &b = side_end(i);
    if ((a[1] > p[1]) == (b[1] > p[1])) continue;
    if ((a[1] < b[1] ? turn(a, b, p) : turn(b, a, p)) > 0) in = !in;
  }
  return in;
}

bool Polygon::is_straight_at(std::size_t i) const {
  constexpr double kSine = 1e-9;
  const Point2 &a = corner(previous(i)), &b = corner(i), &c = side_end(i);
  return std::fabs(turn(a, b, c)) <= kSine * distance(a, b) * distance(b, c);
}

}  // namespace sculpt
