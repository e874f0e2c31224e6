#include "input/cell_meter.hpp"

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "input_fixture.hpp"
#include "sculpt/geom/solids.hpp"

namespace sculpt {
namespace {

using Random = std::mt19937_64;
using Inside = std::function<bool(const Vec3&)>;

double uniform(Random& random, double lo, double hi) {
  return std::uniform_real_distribution<double>(lo, hi)(random);
}
Vec3 point(Random& random) {
  return {uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
}

// A turned frame with its origin near the middle of the unit cell.
Frame random_frame(Random& random) {
  Frame frame;
  const Vec3 x = point(random), y = point(random);
  frame.axis[0] = (1 / norm(x)) * x;
  const Vec3 z = cross(frame.axis[0], y);
  frame.axis[2] = (1 / norm(z)) * z;
  frame.axis[1] = cross(frame.axis[2], frame.axis[0]);
  frame.origin = Vec3{0.5, 0.5, 0.5} + 0.4 * point(random);
  return frame;
}
Vec3 local(const Frame& frame, const Vec3& p) {
  const Vec3 off = p - frame.origin;
  return {dot(off, frame.axis[0]), dot(off, frame.axis[1]), dot(off, frame.axis[2])};
}

const Box kCell{{0, 0, 0}, {1, 1, 1}};

double share_of(std::unique_ptr<Shape> shape) {
  std::vector<InsertedShape> shapes;
  shapes.push_back({std::move(shape), 0});
  CellMeter meter(shapes, 1);
  Fractions fractions;
  const std::vector<std::int32_t> candidates{0};
  meter.measure(kCell, candidates, fractions);
  return fraction_of(fractions, 0, 0);
}

// By a regular grid of points in the cell.
double brute_force(const Frame& frame, const Inside& inside) {
  constexpr int kPoints = 64;
  std::int64_t count = 0;
  for (int k = 0; k < kPoints; ++k)
    for (int j = 0; j < kPoints; ++j)
      for (int i = 0; i < kPoints; ++i)
        count += inside(local(frame, (1.0 / kPoints) * Vec3{i + 0.5, j + 0.5, k + 0.5})) ? 1 : 0;
  return static_cast<double>(count) / (static_cast<double>(kPoints) * kPoints * kPoints);
}

struct Solid {
  const char* name;
  std::function<std::unique_ptr<Shape>()> make;
  Inside inside;
};

double round(const Vec3& p) { return std::hypot(p.x, p.y); }

// In their own frame, edges and corners near the origin.
const std::vector<Solid> kSolids{
    {"corner of a box",
     [] {
       return box({0, 0, 0}, {3, 3, 3});
     },
     [](const Vec3& p) { return p.x >= 0 && p.y >= 0 && p.z >= 0; }},
    {"thin plate",
     [] {
       return box({-2, -2, -0.05}, {2, 2, 0.05});
     },
     [](const Vec3& p) { return std::fabs(p.z) <= 0.05; }},
    {"rod",
     [] {
       return cylinder({0, 0, 0}, {0, 0, 3}, 0.3, 0);
     },
     [](const Vec3& p) { return p.z >= 0 && round(p) <= 0.3; }},
    {"tube",
     [] {
       return cylinder({0, 0, -3}, {0, 0, 0.1}, 0.4, 0.3);
     },
     [](const Vec3& p) { return p.z <= 0.1 && round(p) <= 0.4 && round(p) >= 0.3; }},
    {"tip of a cone",
     [] {
       return cone({0, 0, 0}, {0, 0, 3}, 0, 1.5);
     },
     [](const Vec3& p) { return p.z >= 0 && round(p) <= 0.5 * p.z; }},
    {"torus",
     [] {
       return torus({0, 0, 0}, {0, 0, 1}, 0.5, 0.2);
     },
     [](const Vec3& p) { return std::hypot(round(p) - 0.5, p.z) <= 0.2; }},
    {"ellipsoid",
     [] {
       return ellipsoid({0, 0, 0}, {0.8, 0.5, 0.6});
     },
     [](const Vec3& p) {
       return norm(Vec3{p.x / 0.8, p.y / 0.5, p.z / 0.6}) <= 1;
     }},
};

TEST(CellMeter, MeasuresEdgesCornersAndThinPartsAtAnyOrientation) {
  Random random(11);
  for (const Solid& solid : kSolids)
    for (int n = 0; n < 3; ++n) {
      const Frame frame = random_frame(random);
      EXPECT_NEAR(share_of(moved(solid.make(), frame)), brute_force(frame, solid.inside), 1e-3)
          << solid.name << ", case " << n;
    }
}

TEST(CellMeter, MeasuresBoxesAlongTheAxes) {
  Random random(12);
  for (int n = 0; n < 30; ++n) {
    Vec3 lo = point(random), hi = point(random);
    double volume = 1;
    for (std::size_t d = 0; d < 3; ++d) {
      if (lo[d] > hi[d]) std::swap(lo[d], hi[d]);
      hi[d] += 0.8;
      volume *= std::max(0.0, std::min(hi[d], 1.0) - std::max(lo[d], 0.0));
    }
    EXPECT_NEAR(share_of(box(lo, hi)), volume, 1e-3) << n;
  }
}

// Edges of the first shape and faces of the second: together they fill what each of them fills.
TEST(CellMeter, SharesACellBetweenBoxes) {
  std::vector<InsertedShape> shapes;
  shapes.push_back({box({-1, -1, -1}, {2, 2, 0.4}), 0});
  shapes.push_back({box({-1, -1, -1}, {0.61, 2, 2}), 1});
  CellMeter meter(shapes, 2);
  Fractions fractions;
  const std::vector<std::int32_t> candidates{0, 1};
  meter.measure(kCell, candidates, fractions);
  EXPECT_NEAR(fraction_of(fractions, 0, 0), 0.4, 1e-3);
  EXPECT_NEAR(fraction_of(fractions, 0, 1), 0.6 * 0.61, 1e-3);
  EXPECT_NEAR(fraction_of(fractions, 0, 2), 0.6 * 0.39, 1e-3);
}

// A hex with an edge moved, and boxes whose part of it is one of their corners.
TEST(CellMeter, MeasuresEdgesInHexes) {
  const HexCorners hex{
      {{0, 0, 0}, {1, 0, 0}, {1.2, 1.1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1.2, 1.1, 1}, {0, 1, 1}}};
  Random random(13);
  for (int n = 0; n < 50; ++n) {
    const Vec3 hi{uniform(random, 0.1, 0.95), uniform(random, 0.1, 0.95), uniform(random, 0.1, 0.95)};
    std::vector<InsertedShape> shapes;
    shapes.push_back({box({-1, -1, -1}, hi), 0});
    CellMeter meter(shapes, 1);
    Fractions fractions;
    meter.measure(hex, std::vector<std::int32_t>{0}, fractions);
    EXPECT_NEAR(fraction_of(fractions, 0, 0), hi.x * hi.y * hi.z / hex_volume(hex), 1e-3) << n;
  }
}

}  // namespace
}  // namespace sculpt
