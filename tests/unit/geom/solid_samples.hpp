#pragma once
// Solids of all sorts for the tests of solids.hpp, where they are made and elsewhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "sculpt/geom/solids.hpp"

namespace sculpt {

constexpr double kPi = std::numbers::pi;
using Point2 = std::array<double, 2>;

// A solid in its own frame, and what is known of it without its class.
struct Sample {
  std::string name;
  std::function<std::unique_ptr<Shape>()> make;
  std::function<bool(const Vec3&)> inside;
  double volume;
  bool has_edges;
};

inline double radius_of(const Vec3& p) { return std::hypot(p.x, p.y); }
inline double square(double x) { return x * x; }

inline std::vector<Point2> notched() {
  return {{0, 0}, {4, 0}, {4, 3}, {2, 1}, {0, 3}};
}  // area 8, not convex

inline std::unique_ptr<Shape> drilled_box() {
  std::vector<std::shared_ptr<const Shape>> holes;
  holes.push_back(cylinder({1, 1, -1}, {1, 1, 4}, 0.5, 0));
  holes.push_back(box({1.5, 1.5, 2}, {9, 9, 9}));
  return difference(box({0, 0, 0}, {2, 2, 3}), std::move(holes));
}

inline const std::vector<Sample>& samples() {
  static const std::vector<Sample> all{
      {"ellipsoid",
       [] {
         return ellipsoid({1, 2, 3}, {2, 1, 0.5});
       },
       [](const Vec3& p) { return square((p.x - 1) / 2) + square(p.y - 2) + square((p.z - 3) / 0.5) <= 1; },
       4 * kPi / 3, false},
      {"box",
       [] {
         return box({3, 0, 1}, {1, 1, 3});
       },
       [](const Vec3& p) { return p.x >= 1 && p.x <= 3 && p.y >= 0 && p.y <= 1 && p.z >= 1 && p.z <= 3; }, 4,
       true},
      {"cylinder",
       [] {
         return cylinder({0, 0, 1}, {0, 0, 4}, 1, 0);
       },
       [](const Vec3& p) { return radius_of(p) <= 1 && p.z >= 1 && p.z <= 4; }, 3 * kPi, true},
      {"tube",
       [] {
         return cylinder({0, 0, 1}, {0, 0, 4}, 1, 0.6);
       },
       [](const Vec3& p) { return radius_of(p) <= 1 && radius_of(p) >= 0.6 && p.z >= 1 && p.z <= 4; },
       3 * kPi * 0.64, true},
      {"cone",
       [] {
         return cone({0, 0, 3}, {0, 0, 1}, 0, 1.5);
       },
       [](const Vec3& p) { return p.z >= 1 && p.z <= 3 && radius_of(p) <= 0.75 * (3 - p.z); }, 1.5 * kPi,
       true},
      {"frustum",
       [] {
         return cone({0, 0, 0}, {0, 0, 2}, 2, 1);
       },
       [](const Vec3& p) { return p.z >= 0 && p.z <= 2 && radius_of(p) <= 2 - 0.5 * p.z; }, 14 * kPi / 3,
       true},
      {"torus",
       [] {
         return torus({0, 0, 1}, {0, 0, 2}, 2, 0.7);
       },
       [](const Vec3& p) { return square(radius_of(p) - 2) + square(p.z - 1) <= 0.49; },
       2 * kPi * kPi * 2 * 0.49, false},
      {"tetrahedron",
       [] {
         return polyhedron(std::vector<Vec3>{{0, 0, 0}, {3, 0, 0}, {0, 2, 0}, {0, 0, 1}});
       },
       [](const Vec3& p) { return p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x / 3 + p.y / 2 + p.z <= 1; }, 1,
       true},
      {"octahedron",
       [] {
         return polyhedron(
             std::vector<Vec3>{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}});
       },
       [](const Vec3& p) { return std::fabs(p.x) + std::fabs(p.y) + std::fabs(p.z) <= 1; }, 4.0 / 3, true},
      {"planes",
       [] {
         return planes(std::vector<HalfSpace>{{{1, 1, 0}, {0, 0, -2}},
                                              {{1, 1, 2}, {0, 0, 1}},
                                              {{0, 0, 1}, {-1, 0, 0}},
                                              {{0, 0, 1}, {0, -3, 0}},
                                              {{1, 0, 0}, {1, 1, 0}},
                                              {{9, 0, 0}, {1, 0, 0}}});
       },
       [](const Vec3& p) { return p.z >= 0 && p.z <= 2 && p.x >= 0 && p.y >= 0 && p.x + p.y <= 1; }, 1, true},
      {"revolution",
       [] {
         return revolution({0, 0, 0}, {0, 0, 1}, notched());
       },
       [](const Vec3& p) {
         const double r = radius_of(p);
         return p.z >= 0 && r <= 4 && p.z <= (r < 2 ? 3 - r : r - 1);
       },
       32 * kPi, true},  // 2 pi times the integral of r z(r)
      {"extrusion",
       [] {
         return extrusion({0, 0, 1}, {0, 0, 3}, {1, 0, 0.5}, notched());
       },
       [](const Vec3& p) {
         return p.z >= 1 && p.z <= 3 && p.x >= 0 && p.x <= 4 && p.y >= 0 &&
                p.y <= (p.x < 2 ? 3 - p.x : p.x - 1);
       },
       16, true},
      {"difference", drilled_box,
       [](const Vec3& p) {
         const bool in = p.x >= 0 && p.x <= 2 && p.y >= 0 && p.y <= 2 && p.z >= 0 && p.z <= 3;
         const bool in_hole = std::hypot(p.x - 1, p.y - 1) < 0.5 || (p.x > 1.5 && p.y > 1.5 && p.z > 2);
         return in && !in_hole;
       },
       12 - 3 * kPi / 4 - 0.25, true},
  };
  return all;
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double lo, double hi) {
    return lo + (hi - lo) * (static_cast<double>(engine_()) / 4294967295.0);
  }
  Vec3 in(const Box& box) {
    return {between(box.lo.x, box.hi.x), between(box.lo.y, box.hi.y), between(box.lo.z, box.hi.z)};
  }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = in({{-1, -1, -1}, {1, 1, 1}});
      if (norm(v) > 0.1 && norm(v) <= 1) return unit(v);
    }
  }

 private:
  std::mt19937 engine_;
};

inline Frame random_frame(Random& random) {
  const Vec3 z = random.direction(), x = unit(cross(z, random.direction()));
  return {random.in({{-5, -5, -5}, {5, 5, 5}}), {x, cross(z, x), z}};
}

inline Vec3 in_frame(const Frame& frame, const Vec3& p) {
  const Vec3 off = p - frame.origin;
  return {dot(off, frame.axis[0]), dot(off, frame.axis[1]), dot(off, frame.axis[2])};
}

inline Box grown(const Box& box, double by) {
  const Vec3 more = by * (box.hi - box.lo);
  return {box.lo - more, box.hi + more};
}

// A sample at the place that it is made at, or somewhere else.
struct Placed {
  std::string name;
  std::unique_ptr<Shape> shape;
  std::function<bool(const Vec3&)> inside;
};

inline void for_placed(const std::function<void(const Placed&, Random&)>& visit) {
  unsigned seed = 1;
  for (const Sample& sample : samples())
    for (int place = 0; place < 3; ++place) {
      Random random(seed++);
      Placed placed{sample.name + " " + std::to_string(place), sample.make(), sample.inside};
      if (place > 0) {
        const Frame frame = random_frame(random);
        placed.shape = moved(std::move(placed.shape), frame);
        placed.inside = [&sample, frame](const Vec3& p) { return sample.inside(in_frame(frame, p)); };
      }
      SCOPED_TRACE(placed.name);
      visit(placed, random);
    }
}

constexpr double kSame = 1e-8;

// q lies on the surface.
inline bool has_both_sides(const std::function<bool(const Vec3&)>& inside, const Vec3& q, Random& random) {
  int in = 0;
  for (int n = 0; n < 100; ++n) in += inside(q + kSame * random.direction());
  return in > 0 && in < 100;
}

struct Piece {
  double lo, hi;
};

inline std::vector<Piece> pieces_of(const ChordRow& row, std::size_t line) {
  std::vector<Piece> pieces;
  for (std::size_t k = 0; k < row.layers(); ++k)
    if (row.lo(k)[line] < row.hi(k)[line]) pieces.push_back({row.lo(k)[line], row.hi(k)[line]});
  std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.lo < b.lo; });
  return pieces;
}

inline std::vector<Piece> pieces_on(const Shape& shape, const Vec3& from, const Vec3& step) {
  ChordRow row;
  row.begin(1);
  shape.line_chords({&from, 1}, {&step, 1}, row);
  return pieces_of(row, 0);
}

// The share of a box that lies in the shape, by lines x lines lines along an axis.
inline double share_of(const Shape& shape, const Box& box, std::size_t axis, std::size_t lines) {
  const std::size_t axis_u = (axis + 1) % 3, axis_v = (axis + 2) % 3;
  const auto at = [&](std::size_t a, std::size_t l) {
    return box.lo[a] + (static_cast<double>(l) + 0.5) / static_cast<double>(lines) * (box.hi[a] - box.lo[a]);
  };
  std::vector<double> v;
  for (std::size_t l = 0; l < lines; ++l) v.push_back(at(axis_v, l));
  double length = 0;
  ChordRow row;
  for (std::size_t l = 0; l < lines; ++l) {
    row.begin(lines);
    shape.chords(axis, at(axis_u, l), v, row);
    for (std::size_t k = 0; k < row.layers(); ++k)
      for (std::size_t c = 0; c < lines; ++c) {
        const double lo = std::max(row.lo(k)[c], box.lo[axis]), hi = std::min(row.hi(k)[c], box.hi[axis]);
        length += std::max(0.0, hi - lo);
      }
  }
  return length / (static_cast<double>(lines * lines) * (box.hi[axis] - box.lo[axis]));
}

}  // namespace sculpt
