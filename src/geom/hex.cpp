#include "sculpt/geom/hex.hpp"

#include <algorithm>
#include <limits>

namespace sculpt {
namespace {

using Coefficients = std::array<double, 27>;  // Bezier coefficients of degree 2 per axis, x fastest

// Jacobian determinant of the trilinear map at (u,v,w) in [0,1]^3.
double jacobian(const HexCorners& p, double u, double v, double w) {
  std::array<Vec3, 3> d{};
  for (std::size_t c = 0; c < 8; ++c) {
    const auto& o = kCornerOffset[c];
    const double a = o[0] ? u : 1 - u, b = o[1] ? v : 1 - v, e = o[2] ? w : 1 - w;
    d[0] += ((o[0] ? 1.0 : -1.0) * b * e) * p[c];
    d[1] += ((o[1] ? 1.0 : -1.0) * a * e) * p[c];
    d[2] += ((o[2] ? 1.0 : -1.0) * a * b) * p[c];
  }
  return dot(d[0], cross(d[1], d[2]));
}

// From values at 0, 1/2, 1 to Bezier coefficients of degree 2, along one axis of the 3x3x3 array.
void to_bezier(Coefficients& c, std::size_t stride) {
  for (std::size_t line = 0; line < 27; ++line) {
    if (line / stride % 3 != 0) continue;
    const double a = c[line], m = c[line + stride], b = c[line + 2 * stride];
    c[line + stride] = 2 * m - 0.5 * (a + b);
  }
}

// De Casteljau at 1/2 along one axis.
void halves(const Coefficients& c, std::size_t stride, Coefficients& low, Coefficients& high) {
  for (std::size_t line = 0; line < 27; ++line) {
    if (line / stride % 3 != 0) continue;
    const double a = c[line], m = c[line + stride], b = c[line + 2 * stride];
    const double am = 0.5 * (a + m), mb = 0.5 * (m + b), mid = 0.5 * (am + mb);
    low[line] = a;
    low[line + stride] = am;
    low[line + 2 * stride] = high[line] = mid;
    high[line + stride] = mb;
    high[line + 2 * stride] = b;
  }
}

bool all_positive(const Coefficients& c, int depth) {
  if (*std::min_element(c.begin(), c.end()) > 0) return true;
  for (const std::size_t corner : {0, 2, 6, 8, 18, 20, 24, 26})
    if (!(c[corner] > 0)) return false;  // a corner coefficient is a value
  if (depth == 0) return false;
  std::array<Coefficients, 8> part;
  Coefficients low, high;
  halves(c, 1, low, high);
  std::array<Coefficients, 4> quarter;
  halves(low, 3, quarter[0], quarter[1]);
  halves(high, 3, quarter[2], quarter[3]);
  for (std::size_t q = 0; q < 4; ++q) halves(quarter[q], 9, part[2 * q], part[2 * q + 1]);
  return std::all_of(part.begin(), part.end(),
                     [&](const Coefficients& s) { return all_positive(s, depth - 1); });
}

}  // namespace

double corner_determinant(const HexCorners& p, int corner) {
  const auto c = static_cast<std::size_t>(corner);
  const auto& n = kCornerNeighbours[c];
  const Vec3 a = p[static_cast<std::size_t>(n[0])] - p[c], b = p[static_cast<std::size_t>(n[1])] - p[c],
             d = p[static_cast<std::size_t>(n[2])] - p[c];
  return dot(a, cross(b, d));
}

double corner_scaled_jacobian(const HexCorners& p, int corner) {
  const auto c = static_cast<std::size_t>(corner);
  const auto& n = kCornerNeighbours[c];
  const Vec3 a = p[static_cast<std::size_t>(n[0])] - p[c], b = p[static_cast<std::size_t>(n[1])] - p[c],
             d = p[static_cast<std::size_t>(n[2])] - p[c];
  const double lengths = std::sqrt(dot(a, a) * dot(b, b) * dot(d, d));
  return lengths > 0 ? dot(a, cross(b, d)) / lengths : 0.0;
}

double scaled_jacobian(const HexCorners& p) {
  double worst = 2;
  for (int c = 0; c < 8; ++c) worst = std::min(worst, corner_scaled_jacobian(p, c));
  return worst;
}

double hex_volume(const HexCorners& p) {
  const double g = 0.5 / std::sqrt(3.0);
  double volume = 0;
  for (int s = 0; s < 8; ++s)
    volume += jacobian(p, s & 1 ? 0.5 + g : 0.5 - g, s & 2 ? 0.5 + g : 0.5 - g, s & 4 ? 0.5 + g : 0.5 - g);
  return volume / 8;
}

bool is_positive_inside(const HexCorners& at, int depth) {
  HexCorners p = at;  // relative to a corner, so that a translation without rounding changes nothing
  for (Vec3& corner : p) corner = corner - at[0];
  Coefficients c;
  for (std::size_t i = 0; i < 27; ++i)
    c[i] = jacobian(p, 0.5 * static_cast<double>(i % 3), 0.5 * static_cast<double>(i / 3 % 3),
                    0.5 * static_cast<double>(i / 9));
  to_bezier(c, 1);
  to_bezier(c, 3);
  to_bezier(c, 9);
  return all_positive(c, depth);
}

double shortest_edge(const HexCorners& p) {
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < 8; ++c)
    for (const int n : kCornerNeighbours[c])
      shortest = std::min(shortest, norm(p[static_cast<std::size_t>(n)] - p[c]));
  return shortest;
}

}  // namespace sculpt
