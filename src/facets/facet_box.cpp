#include "facets/facet_box.hpp"

#include <algorithm>
#include <cmath>

namespace sculpt {
namespace {

constexpr double kRounding = 1e-12;

bool is_inside(const Vec3& p, const Box& box) {
  return box.lo.x < p.x && p.x < box.hi.x && box.lo.y < p.y && p.y < box.hi.y && box.lo.z < p.z &&
         p.z < box.hi.z;
}

// Whether the corners p, seen from the centre of a box of these half sizes, are all beyond it along an axis.
// slack: rounding of coordinates.
bool is_apart(const Triangle& p, const Vec3& half, const Vec3& axis, double slack) {
  const double a = dot(p[0], axis), b = dot(p[1], axis), c = dot(p[2], axis);
  const Vec3 size{std::fabs(axis.x), std::fabs(axis.y), std::fabs(axis.z)};
  const double reach = dot(half, size) + slack * (size.x + size.y + size.z);
  return std::min(a, std::min(b, c)) > reach || std::max(a, std::max(b, c)) < -reach;
}

}  // namespace

// Separating axes (Akenine-Moeller 2001): those of the box, the normal, edges times axes.
bool reaches(const Triangle& facet, const Box& box) {
  for (std::size_t d = 0; d < 3; ++d) {
    const double a = facet[0][d], b = facet[1][d], c = facet[2][d];
    if (std::max(a, std::max(b, c)) <= box.lo[d] || std::min(a, std::min(b, c)) >= box.hi[d]) return false;
  }
  for (const Vec3& corner : facet)
    if (is_inside(corner, box)) return true;
  const Vec3 centre = 0.5 * (box.lo + box.hi), half = 0.5 * (box.hi - box.lo);
  const Triangle p{facet[0] - centre, facet[1] - centre, facet[2] - centre};
  const double slack =
      kRounding * (largest(half) + std::max(largest(p[0]), std::max(largest(p[1]), largest(p[2]))));
  const std::array<Vec3, 3> edge{p[1] - p[0], p[2] - p[1], p[0] - p[2]};
  if (is_apart(p, half, cross(edge[0], edge[1]), slack)) return false;
  for (const Vec3& e : edge)
    if (is_apart(p, half, {0, e.z, -e.y}, slack) || is_apart(p, half, {-e.z, 0, e.x}, slack) ||
        is_apart(p, half, {e.y, -e.x, 0}, slack))
      return false;
  return true;
}

Vec3 odd_point(const Box& box) {
  constexpr Vec3 kShare{0.41421356237309505, 0.57721566490153286, 0.61803398874989485};
  return box.lo + scaled(kShare, box.hi - box.lo);
}

Vec3 nearest_point(const Triangle& facet, const Vec3& p) {
  const auto& [a, b, c] = facet;
  const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp),
               d6 = dot(ac, cp);
  if (d1 <= 0 && d2 <= 0) return a;
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + (d1 / (d1 - d3)) * ab;
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + (d2 / (d2 - d6)) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (c - b);
  const double whole = 1 / (va + vb + vc);
  return a + (vb * whole) * ab + (vc * whole) * ac;
}

}  // namespace sculpt
