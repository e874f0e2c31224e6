// The number at a point follows from that at the start on a way along y, then z, then x: each facet that the
// way crosses changes it for all points behind the crossing. So a facet adds to the integral what lies behind
// it along x, behind its cut with the plane of the start along z, and behind its crossing with the line of
// the start along y.
#include "facets/facet_share.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace sculpt {
namespace {

constexpr std::size_t kX = 0, kY = 1, kZ = 2;

// An interval that a way passes from its start to both ends.
struct Reach {
  double lo, start, hi;
  // What a crossing at x where the way leaves the solid adds to the integral of the winding number.
  [[nodiscard]] double behind(double x, bool after_start) const { return after_start ? x - hi : x - lo; }
};

double behind_points(std::span<const Triangle> facets, const Vec3& start, const Reach& y) {
  double sum = 0;
  for (const Triangle& f : facets)
    if (const auto c = cross_line(f, kY, start[kZ], start[kX]); c && y.lo < c->t && c->t < y.hi)
      sum += c->exit * y.behind(c->t, c->t > y.start);
  return sum;
}

// Of a segment from (y0, z0) to (y1, z1).
double behind_segment(const PlaneCut& c, const Reach& y, const Reach& z) {
  const double dy = c.v_out - c.v_in, dz = c.t_out - c.t_in;
  std::array<double, 7> at{0, 1, 1, 1, 1, 1, 1};  // the end stands for splits that there are not
  std::size_t count = 2;
  const auto split = [&](double from, double step, double x) {
    const double s = (x - from) / step;
    if (s > 0 && s < 1) at[count++] = s;
  };
  for (const double x : {y.lo, y.hi}) split(c.v_in, dy, x);
  for (const double x : {z.lo, z.start, z.hi}) split(c.t_in, dz, x);
  std::sort(at.begin(), at.end());
  double sum = 0;
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    const double middle = 0.5 * (at[i] + at[i + 1]), y_middle = c.v_in + middle * dy,
                 z_middle = c.t_in + middle * dz;
    if (y.lo < y_middle && y_middle < y.hi && z.lo < z_middle && z_middle < z.hi)
      sum += (at[i + 1] - at[i]) * dy * z.behind(z_middle, z_middle > z.start);
  }
  return sum;
}

using Polygon = std::vector<Vec3>;

// What lies at or above x along an axis (sense = 1), or at or below it (-1).
Polygon clipped(const Polygon& polygon, std::size_t axis, double x, double sense) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double over_a = sense * (a[axis] - x), over_b = sense * (b[axis] - x);
    if (over_a >= 0) kept.push_back(a);
    if ((over_a >= 0) != (over_b >= 0)) kept.push_back(a + (over_a / (over_a - over_b)) * (b - a));
  }
  return kept;
}

double behind_polygon(const Polygon& polygon, const Reach& x, bool after_start) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Vec3 &a = polygon[0], &b = polygon[i], &c = polygon[i + 1];
    const double area = 0.5 * ((b.y - a.y) * (c.z - a.z) - (b.z - a.z) * (c.y - a.y));
    sum += area * x.behind((a.x + b.x + c.x) / 3, after_start);
  }
  return sum;
}

double behind_facet(const Triangle& facet, const Box& box, const Reach& x) {
  Polygon p(facet.begin(), facet.end());
  for (const std::size_t axis : {kX, kY, kZ})
    p = clipped(clipped(p, axis, box.lo[axis], 1), axis, box.hi[axis], -1);
  return behind_polygon(clipped(p, kX, x.start, -1), x, false) +
         behind_polygon(clipped(p, kX, x.start, 1), x, true);
}

}  // namespace

double mean_winding(std::span<const Triangle> facets, const Box& box, const Vec3& start, int winding) {
  const auto reach = [&](std::size_t axis) { return Reach{box.lo[axis], start[axis], box.hi[axis]}; };
  const Vec3 size = box.hi - box.lo;
  double planes = 0, volumes = 0;
  for (const Triangle& f : facets) {
    if (const auto c = cut(f, kZ, start[kX])) planes += behind_segment(*c, reach(kY), reach(kZ));
    volumes += behind_facet(f, box, reach(kX));
  }
  const double lines = behind_points(facets, start, reach(kY));
  return winding + lines / size.y + planes / (size.y * size.z) + volumes / (size.x * size.y * size.z);
}

}  // namespace sculpt
