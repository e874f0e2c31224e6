#include "input/placement.hpp"

#include <numbers>

namespace sculpt {
namespace {

struct CosineSine {
  double cosine, sine;
};

CosineSine cosine_sine(double degrees) {
  constexpr std::array<CosineSine, 4> kQuarters{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  const double quarters = std::fmod(degrees, 360) / 90;
  if (quarters == std::rint(quarters)) return kQuarters[static_cast<std::size_t>(quarters + 4) % 4];
  const double angle = std::fmod(degrees, 360) * std::numbers::pi / 180;
  return {std::cos(angle), std::sin(angle)};
}

}  // namespace

Placement Placement::after(const Placement& inner) const {
  Placement both{scale * inner.scale, {placed(inner.frame.origin)}};
  for (std::size_t a = 0; a < 3; ++a) both.frame.axis[a] = turned(inner.frame.axis[a]);
  return both;
}

// Rodrigues' formula.
Placement rotation(double degrees, const Vec3& axis, const Vec3& through) {
  const auto [cosine, sine] = cosine_sine(degrees);
  const Vec3 k = unit(axis);
  Placement turn;
  for (Vec3& a : turn.frame.axis) a = cosine * a + sine * cross(k, a) + ((1 - cosine) * dot(k, a)) * k;
  turn.frame.origin = through - turn.turned(through);
  return turn;
}

Placement translation(const Vec3& by) { return {1, {by}}; }

Placement magnification(double factor) { return {factor, {}}; }

}  // namespace sculpt
