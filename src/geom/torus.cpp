#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geom/analytic_solid.hpp"
#include "geom/polygon.hpp"
#include "geom/solid_input.hpp"
#include "sculpt/base/error.hpp"

namespace sculpt {
namespace {

// Coefficients of a polynomial, the constant first.
template <std::size_t N>
using Polynomial = std::array<double, N>;

template <std::size_t N>
double value(const Polynomial<N>& p, double s) {
  double sum = p[N - 1];
  for (std::size_t i = N - 1; i-- > 0;) sum = sum * s + p[i];
  return sum;
}

template <std::size_t N>
Polynomial<N - 1> derivative(const Polynomial<N>& p) {
  Polynomial<N - 1> d;
  for (std::size_t i = 1; i < N; ++i) d[i - 1] = static_cast<double>(i) * p[i];
  return d;
}

// The root between lo and hi, where p has different signs: Newton's method, bisection where it leaves the
// bracket.
template <std::size_t N>
double root_between(const Polynomial<N>& p, double lo, double hi) {
  constexpr int kMostSteps = 100;
  const auto slope = derivative(p);
  const bool rises = value(p, lo) < 0;
  double s = 0.5 * (lo + hi);
  for (int step = 0; step < kMostSteps; ++step) {
    const double at = value(p, s);
    if (at == 0) return s;
    ((at < 0) == rises ? lo : hi) = s;
    double next = s - at / value(slope, s);
    if (!(lo < next && next < hi)) next = 0.5 * (lo + hi);
    if (next == s || next == lo || next == hi) return next;
    s = next;
  }
  return s;
}

// Where p changes its sign between lo and hi, ascending.
template <std::size_t N>
void add_roots(const Polynomial<N>& p, double lo, double hi, std::vector<double>& roots) {
  std::vector<double> turns;
  if constexpr (N > 2) add_roots(derivative(p), lo, hi, turns);
  turns.push_back(hi);
  double from = lo;
  for (const double to : turns) {
    if ((value(p, from) < 0) != (value(p, to) < 0)) roots.push_back(root_between(p, from, to));
    from = to;
  }
}

// Around the z axis.
class Torus final : public AnalyticSolid {
 public:
  Torus(double major, double minor)
      : AnalyticSolid({{-major - minor, -major - minor, -minor}, {major + minor, major + minor, minor}}),
        major_(major),
        minor_(minor) {}

 private:
  // (|p|^2 + R^2 - r^2)^2 = 4 R^2 (x^2 + y^2), where |p|^2 = |from|^2 + s^2.
  void cut(const Vec3& from, const Vec3& direction, std::vector<Interval>& pieces) const override {
    const double square = dot(from, from), four = 4 * major_ * major_,
                 c = square + (major_ - minor_) * (major_ + minor_);
    const Polynomial<5> surface{c * c - four * (from.x * from.x + from.y * from.y),
                                2 * four * from.z * direction.z,
                                2 * c - four * (1 - direction.z * direction.z), 0, 1};
    std::vector<double>& places = places_for_this_thread();
    add_roots(surface, -2 * radius(), 2 * radius(), places);
    add_inside(from, direction, places, pieces);
  }

  [[nodiscard]] bool inside(const Vec3& p) const override {
    return length_of(length_of(p.x, p.y) - major_, p.z) <= minor_;
  }

  [[nodiscard]] Vec3 nearest(const Vec3& p) const override {
    const double r = length_of(p.x, p.y);
    const Vec3 outward = r > 0 ? Vec3{p.x / r, p.y / r, 0} : Vec3{1, 0, 0};
    const Vec3 middle = major_ * outward, off = p - middle;
    return middle + minor_ * (norm(off) > 0 ? direction_of(off) : outward);
  }

  [[nodiscard]] double edge_distance(const Vec3&) const override {
    return std::numeric_limits<double>::infinity();
  }

  [[nodiscard]] bool turns_little(const Vec3&, double, double least_radius) const override {
    return least_radius <= std::min(minor_, major_ - minor_);
  }

  double major_, minor_;
};

}  // namespace

std::unique_ptr<Shape> torus(const Vec3& center, const Vec3& axis, double major, double minor) {
  expect_positive("the minor radius of a torus", minor);
  expect_positive("the major radius of a torus", major);
  if (!(major > minor))
    throw Error(
        fmt::format("a torus has the major radius {} and the minor radius {}, expected a larger major "
                    "radius",
                    major, minor));
  expect_finite("the axis of a torus", axis);
  expect_finite("the center of a torus", center);
  if (!(norm(axis) > 0)) throw Error("the axis of a torus is (0 0 0), expected a direction");
  Frame frame = frame_between("the axis of a torus", {}, axis);
  frame.origin = center;
  return moved(std::make_unique<Torus>(major, minor), frame);
}

}  // namespace sculpt
