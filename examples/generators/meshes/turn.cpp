#include "turn.hpp"

#include <cmath>

namespace hexmesh {
namespace {

constexpr double kPi = 3.14159265358979323846;

// Taylor series for angles up to a quarter of pi; the next terms are below 1e-17.
Direction small(double x) {
  const double q = x * x;
  double c = 1, s = 1;
  for (int n = 16; n >= 2; n -= 2) {
    c = 1 - q / (n * (n - 1)) * c;
    s = 1 - q / (n * (n + 1)) * s;
  }
  return {c, x * s};
}

// From the x axis up to the y axis; mirrored at 45 degrees.
Direction first_quarter(double turn) {
  if (turn <= 0.125) return small(2 * kPi * turn);
  const Direction d = small(2 * kPi * (0.25 - turn));
  return {d.sin, d.cos};
}

}  // namespace

Direction direction(double turn) {
  const double quarters = 4 * (turn - std::floor(turn));
  const int quarter = static_cast<int>(quarters);
  const Direction d = first_quarter((quarters - quarter) / 4);
  switch (quarter % 4) {
    case 0:
      return d;
    case 1:
      return {-d.sin, d.cos};
    case 2:
      return {-d.cos, -d.sin};
    default:
      return {d.sin, -d.cos};
  }
}

}  // namespace hexmesh
