#pragma once
// Hexes of all sorts for the tests of HexField.
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "sculpt/geom/hex.hpp"
#include "sculpt/geom/trilinear.hpp"
#include "sculpt/input/material_source.hpp"

namespace sculpt {

using Random = std::mt19937_64;

inline double uniform(Random& random, double lo, double hi) {
  return std::uniform_real_distribution<double>(lo, hi)(random);
}
inline Vec3 random_point(Random& random, double lo, double hi) {
  const double x = uniform(random, lo, hi), y = uniform(random, lo, hi);
  return {x, y, uniform(random, lo, hi)};
}

inline HexCorners box_hex(const Vec3& lo, const Vec3& hi) {
  HexCorners p;
  for (std::size_t c = 0; c < 8; ++c)
    for (std::size_t d = 0; d < 3; ++d) p[c][d] = kCornerOffset[c][d] != 0 ? hi[d] : lo[d];
  return p;
}
// The same hex with another corner first: turned about its third axis, and with its axes renamed.
inline HexCorners renumbered(const HexCorners& p) { return {p[1], p[2], p[3], p[0], p[5], p[6], p[7], p[4]}; }
inline HexCorners with_cycled_axes(const HexCorners& p) {
  return {p[0], p[3], p[7], p[4], p[1], p[2], p[6], p[5]};
}

// A rotated and warped hex of about this edge around a centre.
inline HexCorners random_hex(Random& random, const Vec3& centre, double edge, double warp) {
  while (true) {
    Vec3 a = unit(random_point(random, -1, 1)), b = random_point(random, -1, 1);
    b = unit(b - dot(a, b) * a);
    const Vec3 c = cross(a, b);
    HexCorners p;
    for (std::size_t n = 0; n < 8; ++n) {
      const Vec3 at{kCornerOffset[n][0] - 0.5, kCornerOffset[n][1] - 0.5, kCornerOffset[n][2] - 0.5};
      const Vec3 moved = at + random_point(random, -warp, warp);
      p[n] = centre + edge * (moved.x * a + moved.y * b + moved.z * c);
    }
    if (is_positive_inside(p)) return p;
  }
}

// A lattice of n^3 hexes under a map of the unit cube, x fastest.
inline std::vector<HexCorners> mapped_lattice(int n, const std::function<Vec3(const Vec3&)>& map) {
  std::vector<HexCorners> hexes;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        HexCorners p;
        for (std::size_t c = 0; c < 8; ++c)
          p[c] = map({(i + kCornerOffset[c][0]) / double(n), (j + kCornerOffset[c][1]) / double(n),
                      (k + kCornerOffset[c][2]) / double(n)});
        hexes.push_back(p);
      }
  return hexes;
}

// Shares of a hex by very many points: of each material that the function names.
inline std::vector<double> shares_by_points(const HexCorners& p, int materials, int points,
                                            const std::function<std::int32_t(const Vec3&)>& material) {
  const HexLines lines(p, 2);
  std::vector<double> share(static_cast<std::size_t>(materials), 0.0);
  double whole = 0;
  for (int i = 0; i < points; ++i)
    for (int j = 0; j < points; ++j) {
      const auto line = lines.at((i + 0.5) / points, (j + 0.5) / points);
      for (int k = 0; k < points; ++k) {
        const double t = (k + 0.5) / points, volume = line.a + t * (line.b + t * line.c);
        share[static_cast<std::size_t>(material(line.from + t * line.step))] += volume;
        whole += volume;
      }
    }
  for (double& s : share) s /= whole;
  return share;
}

}  // namespace sculpt
