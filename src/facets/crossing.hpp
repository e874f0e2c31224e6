#pragma once
// Where lines cross facets. A line runs parallel to an axis a at u on axis (a+1)%3 and v on axis (a+2)%3. It
// passes just beyond its coordinates: a vertex at u or v exactly is below it. Crossings with edges are
// computed from the lower end on, so that all facets at an edge get the same bits: a line that enters a
// closed surface leaves it.
#include <array>
#include <cstddef>
#include <optional>

#include "sculpt/base/vec3.hpp"

namespace sculpt {

using Triangle = std::array<Vec3, 3>;

// Where a plane u cuts a facet: from `in` to `out`; the solid is on the side of smaller t where v grows.
struct PlaneCut {
  double v_in, t_in, v_out, t_out;
};

inline std::optional<PlaneCut> cut(const Triangle& facet, std::size_t axis, double u) {
  const std::size_t axis_u = (axis + 1) % 3, axis_v = (axis + 2) % 3;
  const std::array<bool, 3> below{facet[0][axis_u] <= u, facet[1][axis_u] <= u, facet[2][axis_u] <= u};
  if (below[0] == below[1] && below[1] == below[2]) return std::nullopt;
  PlaneCut c{};
  for (std::size_t e = 0; e < 3; ++e) {
    const std::size_t f = (e + 1) % 3;
    if (below[e] == below[f]) continue;
    const Vec3 &low = facet[below[e] ? e : f], &high = facet[below[e] ? f : e];
    const double s = (u - low[axis_u]) / (high[axis_u] - low[axis_u]);
    const double v = low[axis_v] + s * (high[axis_v] - low[axis_v]),
                 t = low[axis] + s * (high[axis] - low[axis]);
    if (below[e]) {
      c.v_in = v;
      c.t_in = t;
    } else {
      c.v_out = v;
      c.t_out = t;
    }
  }
  return c;
}

// A crossing of a line: its place, and 1 where the line leaves the solid, -1 where it enters.
struct FacetCrossing {
  double t;
  int exit;
};

// With the line v of the plane.
inline std::optional<FacetCrossing> cross_v(const PlaneCut& c, double v) {
  const bool in_below = c.v_in <= v, out_below = c.v_out <= v;
  if (in_below == out_below) return std::nullopt;
  const double s = in_below ? (v - c.v_in) / (c.v_out - c.v_in) : (v - c.v_out) / (c.v_in - c.v_out);
  const double t = in_below ? c.t_in + s * (c.t_out - c.t_in) : c.t_out + s * (c.t_in - c.t_out);
  return FacetCrossing{t, in_below ? 1 : -1};
}

// With the line t of the plane, along which v grows.
inline std::optional<FacetCrossing> cross_t(const PlaneCut& c, double t) {
  return cross_v({c.t_out, c.v_out, c.t_in, c.v_in}, t);
}

inline std::optional<FacetCrossing> cross_line(const Triangle& facet, std::size_t axis, double u, double v) {
  const std::optional<PlaneCut> c = cut(facet, axis, u);
  return c ? cross_v(*c, v) : std::nullopt;
}

// What the winding number grows by on the way from a to b: leaving the solid takes one away.
inline int change(const FacetCrossing& c, double a, double b) {
  if (a < c.t && c.t <= b) return -c.exit;
  return b < c.t && c.t <= a ? c.exit : 0;
}

}  // namespace sculpt
