#include "contour/curve_rules.hpp"

namespace sculpt {
namespace {

// The point of the circle through a, x, b halfway between a and b, on the side of x.
Vec3 middle_of_arc(const Vec3& a, const Vec3& x, const Vec3& b) {
  const Vec3 chord = b - a, middle = 0.5 * (a + b);
  const double length = norm(chord);
  const Vec3 along = unit(chord), off = (x - middle) - dot(x - middle, along) * along;
  const double height = norm(off), s = dot(x - middle, along);
  if (height < 1e-12 * length) return middle;
  // Centre at middle + c * up, equidistant from a and x; the radius cancels c where the arc is flat.
  const double quarter = 0.25 * length * length, c = (s * s + height * height - quarter) / (2 * height);
  const double radius = std::sqrt(c * c + quarter);
  return middle + (c < 0 ? quarter / (radius - c) : c + radius) * unit(off);
}

}  // namespace

Vec3 curve_move(CurveRule rule, const CurveNeighbourhood& n) {
  const Vec3 middle = 0.5 * (n.a + n.b);
  switch (rule) {
    case CurveRule::kOff:
    case CurveRule::kNeighbourSurfaceNormal:
      return {};
    case CurveRule::kLinear:
      return middle - n.x;
    case CurveRule::kHermite: {
      // Hermite midpoint with tangents of one edge length (the report's 2.25, signs by orientation a to b).
      const Vec3 da = n.ends_at_a ? n.x - n.a : 0.5 * (n.x - n.before),
                 db = n.ends_at_b ? n.b - n.x : 0.5 * (n.after - n.x);
      return middle + 0.25 * (da - db) - n.x;
    }
    case CurveRule::kAverageTangent: {
      // The same midpoint with tangents that know directions only: the mean direction of the two segments at
      // a and at b, as long as the chord.
      const Vec3 ta = n.ends_at_a ? unit(n.x - n.a) : unit(unit(n.a - n.before) + unit(n.x - n.a)),
                 tb = n.ends_at_b ? unit(n.b - n.x) : unit(unit(n.b - n.x) + unit(n.after - n.b));
      return middle + (0.125 * norm(n.b - n.a)) * (ta - tb) - n.x;
    }
    case CurveRule::kCircle:
      return middle_of_arc(n.a, n.x, n.b) - n.x;
    case CurveRule::kVfrac: {
      const Vec3 along = unit(n.b - n.a);
      return dot(middle - n.x, along) * along;
    }
  }
  return {};
}

}  // namespace sculpt
