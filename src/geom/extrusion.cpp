#include <algorithm>
#include <cmath>
#include <limits>

#include "geom/analytic_solid.hpp"
#include "geom/polygon.hpp"
#include "geom/solid_input.hpp"

namespace sculpt {
namespace {

Box bounds_of(const Polygon& section, double height) {
  Point2 lo = section.corner(0), hi = lo;
  for (std::size_t i = 0; i < section.size(); ++i)
    for (std::size_t d = 0; d < 2; ++d) {
      lo[d] = std::min(lo[d], section.corner(i)[d]);
      hi[d] = std::max(hi[d], section.corner(i)[d]);
    }
  return {{lo[0], lo[1], 0}, {hi[0], hi[1], height}};
}

// A polygon of points (x, y) from z = 0 to the height.
class Extrusion final : public AnalyticSolid {
 public:
  Extrusion(const Polygon& section, double height)
      : AnalyticSolid(bounds_of(section, height)), section_(section), height_(height) {}

 private:
  [[nodiscard]] static Point2 in_section(const Vec3& p) { return {p.x, p.y}; }

  void cut(const Vec3& from, const Vec3& direction, std::vector<Interval>& pieces) const override {
    std::vector<double>& places = places_for_this_thread();
    for (const double z : {0.0, height_}) add_place((z - from.z) / direction.z, places);
    for (std::size_t side = 0; side < section_.size(); ++side) add_crossing(side, from, direction, places);
    add_inside(from, direction, places, pieces);
  }

  void add_crossing(std::size_t side, const Vec3& p, const Vec3& d, std::vector<double>& places) const {
    const Point2 &a = section_.corner(side), &b = section_.side_end(side);
    const double du = b[0] - a[0], dv = b[1] - a[1];
    const double s = (du * (a[1] - p.y) - dv * (a[0] - p.x)) / (du * d.y - dv * d.x);
    const Point2 at{p.x + s * d.x, p.y + s * d.y};
    if (distance(section_.nearest_on_side(side, at), at) <= slack()) add_place(s, places);
  }

  [[nodiscard]] bool inside(const Vec3& p) const override {
    return p.z >= 0 && p.z <= height_ && section_.inside(in_section(p));
  }

  [[nodiscard]] Vec3 nearest(const Vec3& p) const override {
    Vec3 best;
    double least = std::numeric_limits<double>::infinity();
    const auto offer = [&](const Vec3& q) {
      if (!(norm(q - p) < least)) return;
      least = norm(q - p);
      best = q;
    };
    for (std::size_t side = 0; side < section_.size(); ++side) {
      const Point2 q = section_.nearest_on_side(side, in_section(p));
      offer({q[0], q[1], std::clamp(p.z, 0.0, height_)});
    }
    if (section_.inside(in_section(p)))
      for (const double z : {0.0, height_}) offer({p.x, p.y, z});
    return best;
  }

  [[nodiscard]] double edge_distance(const Vec3& p) const override {
    const double beyond = p.z - std::clamp(p.z, 0.0, height_),
                 to_end = std::min(std::fabs(p.z), std::fabs(height_ - p.z));
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < section_.size(); ++i) {
      const double to_side = distance(section_.nearest_on_side(i, in_section(p)), in_section(p));
      least = std::min(least, std::hypot(to_side, to_end));
      if (!section_.is_straight_at(i))
        least = std::min(least, std::hypot(distance(section_.corner(i), in_section(p)), beyond));
    }
    return least;
  }

  [[nodiscard]] bool turns_little(const Vec3& p, double reach, double) const override {
    std::size_t faces = 0;
    for (std::size_t side = 0; side < section_.size(); ++side)
      if (distance(section_.nearest_on_side(side, in_section(p)), in_section(p)) <= reach) ++faces;
    for (const double z : {0.0, height_})
      if (std::fabs(p.z - z) <= reach) ++faces;
    return faces <= 1;
  }

  Polygon section_;
  double height_;
};

}  // namespace

std::unique_ptr<Shape> extrusion(const Vec3& end1, const Vec3& end2, const Vec3& u_axis,
                                 std::span<const Point2> polygon) {
  constexpr std::string_view kWhat = "an extrusion";
  const Frame frame = frame_between(kWhat, end1, end2, u_axis);
  return moved(std::make_unique<Extrusion>(Polygon(kWhat, polygon), norm(end2 - end1)), frame);
}

}  // namespace sculpt
