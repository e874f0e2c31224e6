#include "sculpt/geom/plane_cut.hpp"

#include <algorithm>
#include <cmath>

namespace sculpt {

double plane_offset(double share, const Vec3& normal) {
  constexpr double kLeastSlope = 1e-4;  // keeps the cubic away from 0/0; the offset changes by less than this
  const Vec3 m{std::max(std::fabs(normal.x), kLeastSlope), std::max(std::fabs(normal.y), kLeastSlope),
               std::max(std::fabs(normal.z), kLeastSlope)};
  const auto cube = [](double x) { return x > 0 ? x * x * x : 0.0; };
  const auto below = [&](double a) {  // volume of the unit cube where m.x < a
    return (cube(a) - cube(a - m.x) - cube(a - m.y) - cube(a - m.z) + cube(a - m.x - m.y) +
            cube(a - m.x - m.z) + cube(a - m.y - m.z)) /
           (6 * m.x * m.y * m.z);
  };
  const double all = m.x + m.y + m.z;
  // By symmetry only the smaller part is measured, where the cubic loses no digits.
  const double part = std::min(share, 1 - share);
  double low = 0, high = 0.5 * all;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (below(middle) < part ? low : high) = middle;
  }
  const double offset = 0.5 * all - 0.5 * (low + high);
  return share < 0.5 ? -offset : offset;
}

}  // namespace sculpt
