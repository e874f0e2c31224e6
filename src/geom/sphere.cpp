#include "sculpt/geom/sphere.hpp"

#include <algorithm>
#include <cmath>

#include "geom/largest_axis.hpp"

namespace sculpt {

Box Sphere::bounds() const {
  const Vec3 r{radius_, radius_, radius_};
  return {center_ - r, center_ + r};
}

bool Sphere::contains(const Box& box) const {
  Vec3 farthest;
  for (std::size_t d = 0; d < 3; ++d)
    farthest[d] = std::max(std::fabs(box.lo[d] - center_[d]), std::fabs(box.hi[d] - center_[d]));
  return dot(farthest, farthest) <= radius_ * radius_;
}

bool Sphere::misses(const Box& box) const {
  Vec3 nearest;
  for (std::size_t d = 0; d < 3; ++d)
    nearest[d] = std::max({box.lo[d] - center_[d], 0.0, center_[d] - box.hi[d]});
  return dot(nearest, nearest) >= radius_ * radius_;
}

std::size_t Sphere::steepest_axis(const Vec3& point) const { return largest_axis(point - center_); }

bool Sphere::is_gentle(const Box& box) const {
  constexpr double kBoxes = 4;  // across the ball
  return kBoxes * largest(box.hi - box.lo) <= 2 * radius_;
}

void Sphere::chords(std::size_t axis, double u, std::span<const double> v, ChordRow& row) const {
  const double along = center_[axis], across = u - center_[(axis + 1) % 3],
               centre_v = center_[(axis + 2) % 3];
  const double square = radius_ * radius_ - across * across;
  const double* const at = v.data();
  const ChordRow::Layer layer = row.add_layer();
  double* const from = layer.lo.data();
  double* const to = layer.hi.data();
  const std::size_t count = v.size();
  for (std::size_t l = 0; l < count; ++l) {
    const double w = at[l] - centre_v;
    const double rest = square - w * w;
    const double half = std::sqrt(rest > 0.0 ? rest : 0.0);
    from[l] = along - half;
    to[l] = along + half;
  }
}

void Sphere::line_chords(std::span<const Vec3> from, std::span<const Vec3> step, ChordRow& row) const {
  const ChordRow::Layer layer = row.add_layer();
  const double square = radius_ * radius_;
  for (std::size_t l = 0; l < from.size(); ++l) {
    const Vec3 off = from[l] - center_;
    const double a = dot(step[l], step[l]), b = dot(off, step[l]),
                 rest = b * b - a * (dot(off, off) - square);
    const double per = a > 0 ? 1 / a : 0, half = std::sqrt(rest > 0 ? rest : 0.0);
    layer.lo[l] = (-b - half) * per;
    layer.hi[l] = (-b + half) * per;
  }
}

std::optional<Vec3> Sphere::nearest_on_surface(const Vec3& p) const {
  const Vec3 off = p - center_;
  if (!(norm(off) > 0)) return std::nullopt;
  return center_ + (radius_ / norm(off)) * off;
}

}  // namespace sculpt
