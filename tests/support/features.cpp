#include "support/features.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sculpt::test {

Vec3 BoxFeatures::local(const Vec3& p) const {
  const Vec3 off = p - centre_;
  return {dot(off, axes_[0]), dot(off, axes_[1]), dot(off, axes_[2])};
}

Vec3 BoxFeatures::world(const Vec3& q) const {
  return centre_ + q.x * axes_[0] + q.y * axes_[1] + q.z * axes_[2];
}

Vec3 BoxFeatures::clamped(const Vec3& q) const {
  Vec3 c;
  for (std::size_t d = 0; d < 3; ++d) c[d] = std::clamp(q[d], -half_[d], half_[d]);
  return c;
}

double BoxFeatures::side(std::int32_t surface) const {
  const auto d = static_cast<std::size_t>(surface / 2);
  return surface % 2 == 1 ? half_[d] : -half_[d];
}

bool BoxFeatures::inside(const Vec3& p) const {
  const Vec3 q = local(p);
  return clamped(q) == q;
}

double BoxFeatures::from_edges(const Vec3& p) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::int32_t a = 0; a < 4; ++a)
    for (std::int32_t b = a + 1; b < 6; ++b)
      if (const auto q = on_curve(a, b, p)) least = std::min(least, norm(*q - p));
  return least;
}

std::optional<GeometryFeatures::SurfacePoint> BoxFeatures::nearest(const Vec3& p, std::int32_t,
                                                                   std::int32_t) const {
  SurfacePoint best{0, *on_surface(0, p)};
  for (std::int32_t s = 1; s < 6; ++s)
    if (const Vec3 q = *on_surface(s, p); norm(q - p) < norm(best.point - p)) best = {s, q};
  return best;
}

std::optional<Vec3> BoxFeatures::on_surface(std::int32_t surface, const Vec3& p) const {
  Vec3 q = clamped(local(p));
  q[static_cast<std::size_t>(surface / 2)] = side(surface);
  return world(q);
}

std::optional<Vec3> BoxFeatures::on_curve(std::int32_t a, std::int32_t b, const Vec3& p) const {
  if (a / 2 == b / 2) return std::nullopt;
  Vec3 q = clamped(local(p));
  for (const std::int32_t s : {a, b}) q[static_cast<std::size_t>(s / 2)] = side(s);
  return world(q);
}

std::optional<GeometryFeatures::Corner> BoxFeatures::at_corner(std::span<const std::int32_t> surfaces,
                                                               const Vec3&) const {
  Vec3 q;
  std::int32_t number = 0;
  if (surfaces.size() != 3) return std::nullopt;
  for (std::size_t d = 0; d < 3; ++d) {
    if (surfaces[d] / 2 != static_cast<std::int32_t>(d)) return std::nullopt;
    q[d] = side(surfaces[d]);
    number |= surfaces[d] % 2 << static_cast<int>(d);
  }
  return Corner{number, world(q)};
}

std::shared_ptr<const BoxFeatures> turned_box(const Vec3& centre, const Vec3& half) {
  const Vec3 x = unit({0.9, 0.4, 0.2}), z = unit(cross(x, {-0.3, 0.9, 0.25}));
  return std::make_shared<BoxFeatures>(centre, std::array{x, cross(z, x), z}, half);
}

Case box_case(const Index3& cells, const BoxFeatures& box) {
  constexpr int kPoints = 8;
  Case input;
  input.name = "box";
  input.grid = uniform_grid(cells, {0, 0, 0}, {1, 1, 1});
  input.materials = 2;
  input.fill = [box](const Index3& c, Fractions& f) {
    int in = 0;
    for (int k = 0; k < kPoints; ++k)
      for (int j = 0; j < kPoints; ++j)
        for (int i = 0; i < kPoints; ++i)
          in += box.inside({static_cast<double>(c[0]) + (i + 0.5) / kPoints,
                            static_cast<double>(c[1]) + (j + 0.5) / kPoints,
                            static_cast<double>(c[2]) + (k + 0.5) / kPoints});
    const double share = static_cast<double>(in) / (kPoints * kPoints * kPoints);
    if (share < 1) f.add(0, 1 - share);
    if (share > 0) f.add(1, share);
  };
  return input;
}

}  // namespace sculpt::test
