#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "geom/analytic_solid.hpp"
#include "geom/polygon.hpp"
#include "geom/solid_input.hpp"
#include "sculpt/base/error.hpp"

namespace sculpt {
namespace {

Box bounds_around(const Polygon& section) {
  double radius = 0, lo = section.corner(0)[1], hi = lo;
  for (std::size_t i = 0; i < section.size(); ++i) {
    radius = std::max(radius, section.corner(i)[0]);
    lo = std::min(lo, section.corner(i)[1]);
    hi = std::max(hi, section.corner(i)[1]);
  }
  return {{-radius, -radius, lo}, {radius, radius, hi}};
}

// A polygon of points (distance from the axis, z), turned around the z axis: its sides become cones, tubes
// and discs.
class Revolution final : public AnalyticSolid {
 public:
  explicit Revolution(const Polygon& section) : AnalyticSolid(bounds_around(section)), section_(section) {
    for (std::size_t i = 0; i < section_.size(); ++i) {
      if (!on_axis(i)) sides_.push_back(i);
      if (is_edge(i)) edges_.push_back(section_.corner(i));
    }
    find_wall();
  }

 private:
  [[nodiscard]] static Point2 in_section(const Vec3& p) { return {length_of(p.x, p.y), p.z}; }
  [[nodiscard]] bool on_axis(std::size_t side) const {
    return section_.corner(side)[0] == 0 && section_.side_end(side)[0] == 0;
  }
  [[nodiscard]] bool is_disc(std::size_t side) const {
    return std::fabs(section_.side_end(side)[1] - section_.corner(side)[1]) <= 1e-12 * radius();
  }
  // On the axis a corner is one of the surface unless a disc ends there alone.
  [[nodiscard]] bool is_edge(std::size_t corner) const {
    if (section_.corner(corner)[0] > 0) return !section_.is_straight_at(corner);
    const std::size_t before = section_.previous(corner);
    return !(on_axis(before) && is_disc(corner)) && !(on_axis(corner) && is_disc(before)) &&
           !(on_axis(before) && on_axis(corner));
  }

  // The one side of a cylinder, cone or frustum that is no disc.
  void find_wall() {
    std::size_t walls = 0, discs = 0, wall = 0;
    for (const std::size_t side : sides_) {
      if (is_disc(side)) {
        const bool from_axis = section_.corner(side)[0] == 0 || section_.side_end(side)[0] == 0;
        discs += from_axis ? 1 : 3;
      } else {
        ++walls;
        wall = side;
      }
    }
    if (walls == 1 && discs <= 2) wall_ = wall;
  }

  void cut(const Vec3& from, const Vec3& direction, std::vector<Interval>& pieces) const override {
    if (wall_) {
      cut_cone(section_.corner(*wall_), section_.side_end(*wall_), from, direction, pieces);
      return;
    }
    std::vector<double>& places = places_for_this_thread();
    for (const std::size_t side : sides_) {
      if (is_disc(side))
        add_place((section_.corner(side)[1] - from.z) / direction.z, places);
      else
        add_crossings(side, from, direction, places);
    }
    add_inside(from, direction, places, pieces);
  }

  // What is within the wall and between its ends: r^2 <= (w + s dw)^2 along the line, and the slab.
  void cut_cone(const Point2& end1, const Point2& end2, const Vec3& p, const Vec3& d,
                std::vector<Interval>& pieces) const {
    const double slope = (end2[0] - end1[0]) / (end2[1] - end1[1]);
    const double low = std::min(end1[1], end2[1]), high = std::max(end1[1], end2[1]);
    Interval slab{-2 * radius(), 2 * radius()};
    if (d.z != 0) {
      const double s1 = (low - p.z) / d.z, s2 = (high - p.z) / d.z;
      slab = {std::max(slab.lo, std::min(s1, s2)), std::min(slab.hi, std::max(s1, s2))};
    } else if (p.z < low || p.z > high) {
      return;
    }
    const auto add = [&](double lo, double hi) {
      lo = std::max(lo, slab.lo);
      hi = std::min(hi, slab.hi);
      if (lo < hi) pieces.push_back({lo, hi});
    };
    constexpr double kNoSquare = 1e-14;
    const double w = end1[0] + slope * (p.z - end1[1]), dw = slope * d.z;
    const double a = d.x * d.x + d.y * d.y - dw * dw, b = p.x * d.x + p.y * d.y - w * dw,
                 c = p.x * p.x + p.y * p.y - w * w;
    if (std::fabs(a) <= kNoSquare) {
      if (b != 0)
        b > 0 ? add(slab.lo, -c / (2 * b)) : add(-c / (2 * b), slab.hi);
      else if (c <= 0)
        add(slab.lo, slab.hi);
      return;
    }
    const double rest = b * b - a * c;
    if (rest <= 0) {
      if (a < 0) add(slab.lo, slab.hi);
      return;
    }
    const double root = std::sqrt(rest), s1 = (-b - root) / a, s2 = (-b + root) / a;
    if (a > 0) {
      add(s1, s2);
    } else {  // outside of the roots; the mirror image of the cone lies beyond the slab
      add(slab.lo, s2);
      add(s1, slab.hi);
    }
  }

  // With the cone (dz r)^2 = (dz r1 + dr (z - z1))^2, and its mirror image, where they are as high as the
  // side.
  void add_crossings(std::size_t side, const Vec3& p, const Vec3& d, std::vector<double>& places) const {
    const auto [r1, z1] = section_.corner(side);
    const auto [r2, z2] = section_.side_end(side);
    const double dr = r2 - r1, dz = z2 - z1, w = dz * r1 + dr * (p.z - z1), dw = dr * d.z;
    const double a = dz * dz * (d.x * d.x + d.y * d.y) - dw * dw,
                 b = dz * dz * (p.x * d.x + p.y * d.y) - w * dw,
                 c = dz * dz * (p.x * p.x + p.y * p.y) - w * w;
    const double rest = b * b - a * c;
    if (!(rest >= 0)) return;
    const double q = -(b + std::copysign(std::sqrt(rest), b));
    for (const double s : {q / a, c / q}) {
      const double z = p.z + s * d.z;
      if (z >= std::min(z1, z2) - slack() && z <= std::max(z1, z2) + slack()) add_place(s, places);
    }
  }

  [[nodiscard]] bool inside(const Vec3& p) const override { return section_.inside(in_section(p)); }

  [[nodiscard]] Vec3 nearest(const Vec3& p) const override {
    const Point2 at = in_section(p);
    Point2 best{};
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t side : sides_) {
      const Point2 q = section_.nearest_on_side(side, at);
      if (!(distance(q, at) < least)) continue;
      least = distance(q, at);
      best = q;
    }
    if (!(at[0] > 0)) return {best[0], 0, best[1]};
    return {best[0] * (p.x / at[0]), best[0] * (p.y / at[0]), best[1]};
  }

  [[nodiscard]] double edge_distance(const Vec3& p) const override {
    double least = std::numeric_limits<double>::infinity();
    for (const Point2& edge : edges_) least = std::min(least, distance(edge, in_section(p)));
    return least;
  }

  [[nodiscard]] bool turns_little(const Vec3& p, double reach, double least_radius) const override {
    const Point2 at = in_section(p);
    std::size_t faces = 0;
    for (const std::size_t side : sides_) {
      if (distance(section_.nearest_on_side(side, at), at) > reach) continue;
      if (!is_disc(side) && at[0] - reach < least_radius) return false;
      ++faces;
    }
    return faces <= 1;
  }

  Polygon section_;
  std::vector<std::size_t> sides_;   // those that are not on the axis
  std::optional<std::size_t> wall_;  // of a solid that is one convex cone or tube between two discs
  std::vector<Point2> edges_;        // the corners of the section that are edges or corners of the surface
};

std::unique_ptr<Shape> turned(std::string_view what, const Frame& frame, std::span<const Point2> corners) {
  return moved(std::make_unique<Revolution>(Polygon(what, corners)), frame);
}

}  // namespace

std::unique_ptr<Shape> cylinder(const Vec3& end1, const Vec3& end2, double radius, double inner_radius) {
  expect_positive("the radius of a cylinder", radius);
  if (!(inner_radius >= 0) || !(inner_radius < radius))
    throw Error(
        fmt::format("a cylinder of radius {} has the inner radius {}, expected 0 or more and less than "
                    "its radius",
                    radius, inner_radius));
  const double height = norm(end2 - end1);
  const std::array<Point2, 4> section{
      {{inner_radius, 0}, {radius, 0}, {radius, height}, {inner_radius, height}}};
  return turned("a cylinder", frame_between("a cylinder", end1, end2), section);
}

std::unique_ptr<Shape> cone(const Vec3& end1, const Vec3& end2, double radius1, double radius2) {
  for (const double radius : {radius1, radius2})
    if (!(radius >= 0) || !std::isfinite(radius))
      throw Error(fmt::format("a radius of a cone is {}, expected 0 or more", radius));
  if (radius1 == 0 && radius2 == 0) throw Error("a cone has the radii 0 and 0, expected one above 0");
  const Frame frame = frame_between("a cone", end1, end2);
  const double height = norm(end2 - end1);
  std::vector<Point2> section{{0, 0}};
  if (radius1 > 0) section.push_back({radius1, 0});
  if (radius2 > 0) section.push_back({radius2, height});
  section.push_back({0, height});
  return turned("a cone", frame, section);
}

std::unique_ptr<Shape> revolution(const Vec3& end1, const Vec3& end2, std::span<const Point2> polygon) {
  constexpr std::string_view kWhat = "a solid of revolution";
  for (std::size_t i = 0; i < polygon.size(); ++i)
    if (polygon[i][0] < 0)
      throw Error(fmt::format("{}: corner {} is at {} from the axis, expected 0 or more", kWhat, i + 1,
                              polygon[i][0]));
  return turned(kWhat, frame_between(kWhat, end1, end2), polygon);
}

}  // namespace sculpt
