#include <algorithm>
#include <cmath>
#include <limits>

#include "geom/analytic_solid.hpp"
#include "geom/solid_input.hpp"

namespace sculpt {
namespace {

// Scaled by its radii it is the unit ball, and boxes stay boxes.
class Ellipsoid final : public AnalyticSolid {
 public:
  Ellipsoid(const Vec3& center, const Vec3& radii)
      : AnalyticSolid({center - radii, center + radii}),
        center_(center),
        radii_(radii),
        per_radius_{1 / radii.x, 1 / radii.y, 1 / radii.z} {}

  [[nodiscard]] bool contains(const Box& box) const override {
    Vec3 farthest;
    for (std::size_t d = 0; d < 3; ++d)
      farthest[d] = std::max(std::fabs(box.lo[d] - center_[d]), std::fabs(box.hi[d] - center_[d]));
    const Vec3 q = scaled(farthest, per_radius_);
    return dot(q, q) <= 1;
  }

  [[nodiscard]] bool misses(const Box& box) const override {
    Vec3 closest;
    for (std::size_t d = 0; d < 3; ++d)
      closest[d] = std::max({box.lo[d] - center_[d], 0.0, center_[d] - box.hi[d]});
    const Vec3 q = scaled(closest, per_radius_);
    return dot(q, q) >= 1;
  }

 private:
  void cut(const Vec3& from, const Vec3& direction, std::vector<Interval>& pieces) const override {
    const Vec3 p = scaled(from - center_, per_radius_), d = scaled(direction, per_radius_);
    const double a = dot(d, d), b = dot(p, d), rest = b * b - a * (dot(p, p) - 1);
    if (!(rest > 0)) return;
    const double half = std::sqrt(rest);
    pieces.push_back({(-b - half) / a, (-b + half) / a});
  }

  [[nodiscard]] bool inside(const Vec3& p) const override { return contains({p, p}); }

  // The point q with q[d] = r[d]^2 p[d] / (t + r[d]^2) on the surface, for the largest such t (Eberly,
  // "Distance from a point to an ellipse, an ellipsoid, or a hyperellipsoid").
  [[nodiscard]] Vec3 nearest(const Vec3& p) const override {
    constexpr double kOffPlane =
        1e-13;  // keeps the point off the planes of symmetry, where t is a double root
    const Vec3 off = p - center_;
    Vec3 q;
    for (std::size_t d = 0; d < 3; ++d) q[d] = std::max(std::fabs(off[d]), kOffPlane * radii_[d]);
    const double least = std::min({radii_.x, radii_.y, radii_.z});
    const Vec3 weighted = scaled(q, radii_);
    const auto stretched = [&](double t) {  // t is counted from -least^2
      Vec3 at;
      for (std::size_t d = 0; d < 3; ++d)
        at[d] = weighted[d] / (t + (radii_[d] - least) * (radii_[d] + least));
      return at;
    };
    double lo = 0, hi = norm(weighted);
    for (double t = 0.5 * hi; lo < t && t < hi; t = 0.5 * (lo + hi)) {
      const Vec3 at = stretched(t);
      (dot(at, at) > 1 ? lo : hi) = t;
    }
    const Vec3 on_ball = direction_of(stretched(hi));
    Vec3 found;
    for (std::size_t d = 0; d < 3; ++d) found[d] = center_[d] + std::copysign(on_ball[d] * radii_[d], off[d]);
    return found;
  }

  [[nodiscard]] double edge_distance(const Vec3&) const override {
    return std::numeric_limits<double>::infinity();
  }

  [[nodiscard]] bool turns_little(const Vec3&, double, double least_radius) const override {
    const double least = std::min({radii_.x, radii_.y, radii_.z});
    return least_radius * largest(radii_) <= least * least;
  }

  Vec3 center_, radii_, per_radius_;
};

}  // namespace

std::unique_ptr<Shape> ellipsoid(const Vec3& center, const Vec3& radii) {
  expect_finite("the center of an ellipsoid", center);
  for (std::size_t d = 0; d < 3; ++d) expect_positive("a radius of an ellipsoid", radii[d]);
  return std::make_unique<Ellipsoid>(center, radii);
}

}  // namespace sculpt
