#include "sculpt/geom/solids.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>

#include "sculpt/base/error.hpp"

namespace sculpt {
namespace {

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

double radius_of(const Vec3& p) { return std::hypot(p.x, p.y); }
double square(double x) { return x * x; }

std::vector<Point2> notched() { return {{0, 0}, {4, 0}, {4, 3}, {2, 1}, {0, 3}}; }  // area 8, not convex

std::unique_ptr<Shape> drilled_box() {
  std::vector<std::shared_ptr<const Shape>> holes;
  holes.push_back(cylinder({1, 1, -1}, {1, 1, 4}, 0.5, 0));
  holes.push_back(box({1.5, 1.5, 2}, {9, 9, 9}));
  return difference(box({0, 0, 0}, {2, 2, 3}), std::move(holes));
}

const std::vector<Sample>& samples() {
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

Frame random_frame(Random& random) {
  const Vec3 z = random.direction(), x = unit(cross(z, random.direction()));
  return {random.in({{-5, -5, -5}, {5, 5, 5}}), {x, cross(z, x), z}};
}

Vec3 in_frame(const Frame& frame, const Vec3& p) {
  const Vec3 off = p - frame.origin;
  return {dot(off, frame.axis[0]), dot(off, frame.axis[1]), dot(off, frame.axis[2])};
}

Box grown(const Box& box, double by) {
  const Vec3 more = by * (box.hi - box.lo);
  return {box.lo - more, box.hi + more};
}

// A sample at the place that it is made at, or somewhere else.
struct Placed {
  std::string name;
  std::unique_ptr<Shape> shape;
  std::function<bool(const Vec3&)> inside;
};

void for_placed(const std::function<void(const Placed&, Random&)>& visit) {
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
bool has_both_sides(const std::function<bool(const Vec3&)>& inside, const Vec3& q, Random& random) {
  int in = 0;
  for (int n = 0; n < 100; ++n) in += inside(q + kSame * random.direction());
  return in > 0 && in < 100;
}

struct Piece {
  double lo, hi;
};

std::vector<Piece> pieces_of(const ChordRow& row, std::size_t line) {
  std::vector<Piece> pieces;
  for (std::size_t k = 0; k < row.layers(); ++k)
    if (row.lo(k)[line] < row.hi(k)[line]) pieces.push_back({row.lo(k)[line], row.hi(k)[line]});
  std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.lo < b.lo; });
  return pieces;
}

std::vector<Piece> pieces_on(const Shape& shape, const Vec3& from, const Vec3& step) {
  ChordRow row;
  row.begin(1);
  shape.line_chords({&from, 1}, {&step, 1}, row);
  return pieces_of(row, 0);
}

double volume_of(const Shape& shape, std::size_t axis, std::size_t lines) {
  const Box box = shape.bounds();
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
      for (std::size_t c = 0; c < lines; ++c) length += std::fmax(0.0, row.hi(k)[c] - row.lo(k)[c]);
  }
  const Vec3 size = box.hi - box.lo;
  return length * size[axis_u] * size[axis_v] / static_cast<double>(lines * lines);
}

TEST(Solids, VolumesAreThoseOfTheFormulas) {
  unsigned seed = 100;
  for (const Sample& sample : samples()) {
    Random random(seed++);
    const std::unique_ptr<Shape> shape = moved(sample.make(), random_frame(random));
    double mean = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double error = volume_of(*shape, axis, 100) / sample.volume - 1;
      EXPECT_LT(std::fabs(error), 2e-3) << sample.name << ", axis " << axis;
      mean += error / 3;
    }
    EXPECT_LT(std::fabs(mean), 1e-3) << sample.name;
  }
}

TEST(Solids, PiecesOfLinesEndWhereTheSolidDoes) {
  constexpr double kNear = 1e-7;
  for_placed([](const Placed& placed, Random& random) {
    const Box around = grown(placed.shape->bounds(), 0.1);
    for (int i = 0; i < 40; ++i) {
      const Vec3 from = random.in(around), step = random.between(0.1, 3) * random.direction();
      const auto inside = [&](double t) { return placed.inside(from + t * step); };
      const std::vector<Piece> pieces = pieces_on(*placed.shape, from, step);
      for (std::size_t k = 0; k < pieces.size(); ++k) {
        const auto [lo, hi] = pieces[k];
        if (hi - lo < 10 * kNear) continue;
        EXPECT_TRUE(inside(lo + kNear) && inside(hi - kNear));
        EXPECT_FALSE(inside(lo - kNear) || inside(hi + kNear));
        if (k > 0) EXPECT_LE(pieces[k - 1].hi, lo);
      }
      for (int n = 0; n < 50; ++n) {
        const double t = random.between(-20, 20);
        const bool in = std::any_of(pieces.begin(), pieces.end(),
                                    [&](const Piece& piece) { return piece.lo <= t && t <= piece.hi; });
        EXPECT_EQ(in, inside(t)) << "at " << t;
      }
    }
  });
}

// Lines through edges and corners, along faces and along the axis.
TEST(Solids, LinesThroughOddPlacesAreWhole) {
  Random random(7);
  for (const Sample& sample : samples()) {
    const std::unique_ptr<Shape> shape = sample.make();
    const auto odd = [&] { return std::floor(random.between(0, 9)) / 2; };
    for (int i = 0; i < 300; ++i) {
      const Vec3 from{odd(), odd(), odd()};
      Vec3 step{odd() - 2, odd() - 2, odd() - 2};
      if (i % 2 == 0)
        step[static_cast<std::size_t>(i / 2 % 3)] = step[static_cast<std::size_t>(i / 4 % 3)] = 0;
      if (!(norm(step) > 0)) continue;
      const std::vector<Piece> pieces = pieces_on(*shape, from, step);
      for (int n = 0; n < 20; ++n) {
        const double t = random.between(-5, 5);
        const Vec3 p = from + t * step;
        const bool in = std::any_of(pieces.begin(), pieces.end(),
                                    [&](const Piece& piece) { return piece.lo <= t && t <= piece.hi; });
        if (in != sample.inside(p))
          EXPECT_TRUE(has_both_sides(sample.inside, p, random)) << sample.name << " at " << t;
      }
    }
  }
}

TEST(Solids, PointsOfTheAxisAreInside) {
  const Vec3 on_axis{0, 0, 2};
  EXPECT_TRUE(cylinder({0, 0, 1}, {0, 0, 4}, 1, 0)->contains({on_axis, on_axis}));
  EXPECT_TRUE(cone({0, 0, 4}, {0, 0, 1}, 1, 0)->contains({on_axis, on_axis}));
  EXPECT_FALSE(cylinder({0, 0, 1}, {0, 0, 4}, 1, 0.1)->contains({on_axis, on_axis}));
  EXPECT_NEAR(pieces_on(*cylinder({0, 0, 1}, {0, 0, 4}, 1, 0), {0, 0, -1}, {0, 0, 1}).at(0).hi, 5, 1e-14);
}

TEST(Solids, LinesWithoutLengthHaveNoPiece) {
  for_placed([](const Placed& placed, Random& random) {
    EXPECT_TRUE(pieces_on(*placed.shape, random.in(placed.shape->bounds()), {}).empty());
  });
}

TEST(Solids, LinesAlongTheAxesAreLinesLikeOthers) {
  for_placed([](const Placed& placed, Random& random) {
    const Box around = placed.shape->bounds();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
      std::vector<Vec3> from;
      std::vector<double> across;
      const Vec3 start = random.in(around);
      Vec3 step;
      step[axis] = 2;
      for (int l = 0; l < 5; ++l) {
        from.push_back(start);
        from.back()[v] = random.between(around.lo[v], around.hi[v]);
        across.push_back(from.back()[v]);
      }
      ChordRow along, any;
      along.begin(7, 1, 5);
      placed.shape->chords(axis, start[u], across, along);
      any.begin(5);
      placed.shape->line_chords(from, std::vector<Vec3>(5, step), any);
      EXPECT_TRUE(pieces_of(along, 0).empty() && pieces_of(along, 6).empty());
      for (std::size_t l = 0; l < 5; ++l) {
        const std::vector<Piece> a = pieces_of(along, l + 1), b = pieces_of(any, l);
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t k = 0; k < a.size(); ++k) {
          EXPECT_NEAR(a[k].lo, start[axis] + 2 * b[k].lo, 1e-7);
          EXPECT_NEAR(a[k].hi, start[axis] + 2 * b[k].hi, 1e-7);
        }
      }
    }
  });
}

TEST(Solids, BoundsHoldAllPieces) {
  for_placed([](const Placed& placed, Random& random) {
    const Box bounds = placed.shape->bounds(), more = grown(bounds, 0.2);
    for (int n = 0; n < 1000; ++n) {
      const Vec3 p = random.in(more);
      if (!placed.inside(p)) continue;
      for (std::size_t d = 0; d < 3; ++d) EXPECT_TRUE(bounds.lo[d] <= p[d] && p[d] <= bounds.hi[d]);
    }
  });
}

TEST(Solids, BoxesInsideAndOutsideAreToldApart) {
  std::size_t held = 0, missed = 0;
  for_placed([&](const Placed& placed, Random& random) {
    const Box around = grown(placed.shape->bounds(), 0.1);
    const double size = largest(around.hi - around.lo);
    for (int n = 0; n < 200; ++n) {
      const Vec3 middle = random.in(around);
      const Vec3 half = random.between(0.01, 0.1) * size * random.in({{0.2, 0.2, 0.2}, {1, 1, 1}});
      const Box box{middle - half, middle + half};
      const bool contains = placed.shape->contains(box), misses = placed.shape->misses(box);
      held += contains;
      missed += misses;
      EXPECT_FALSE(contains && misses);
      for (int k = 0; k < 8; ++k) {
        const Vec3 corner{k & 1 ? box.lo.x : box.hi.x, k & 2 ? box.lo.y : box.hi.y,
                          k & 4 ? box.lo.z : box.hi.z};
        for (const Vec3& p : {corner, random.in(box)}) {
          if (contains) EXPECT_TRUE(placed.inside(p));
          if (misses) EXPECT_FALSE(placed.inside(p));
        }
      }
      if (contains || misses) continue;
      const std::optional<Vec3> near = placed.shape->nearest_on_surface(middle);
      if (near) EXPECT_LE(norm(*near - middle), 2 * norm(half));
    }
  });
  EXPECT_GT(held, 300U);
  EXPECT_GT(missed, 2000U);
}

TEST(Solids, PointsAreBoxes) {
  for_placed([](const Placed& placed, Random& random) {
    for (int n = 0; n < 100; ++n) {
      const Vec3 p = random.in(placed.shape->bounds());
      EXPECT_EQ(placed.shape->contains({p, p}), placed.inside(p));
      EXPECT_EQ(placed.shape->misses({p, p}), !placed.inside(p));
    }
  });
}

// The line from q to `within` enters or leaves the solid at q.
bool ends_at(const Shape& shape, const Vec3& q, const Vec3& within) {
  const std::vector<Piece> pieces = pieces_on(shape, q, within - q);
  return std::any_of(pieces.begin(), pieces.end(), [](const Piece& piece) {
    return std::fabs(piece.lo) < kSame || std::fabs(piece.hi) < kSame;
  });
}

TEST(Solids, NoPointOfTheSurfaceIsNearerThanTheNearest) {
  for_placed([](const Placed& placed, Random& random) {
    const Box around = grown(placed.shape->bounds(), 0.3);
    std::vector<Vec3> surface;
    Vec3 within;
    while (surface.size() < 300) {
      const Vec3 from = random.in(placed.shape->bounds()), step = random.direction();
      for (const auto& [lo, hi] : pieces_on(*placed.shape, from, step)) {
        surface.push_back(from + lo * step);
        surface.push_back(from + hi * step);
        within = from + 0.5 * (lo + hi) * step;
      }
    }
    int told = 0;
    for (int n = 0; n < 40; ++n) {
      const Vec3 p = random.in(around);
      const std::optional<Vec3> near = placed.shape->nearest_on_surface(p);
      if (!near) continue;
      ++told;
      const double distance = norm(*near - p);
      for (const Vec3& q : surface) EXPECT_GE(norm(q - p), distance - kSame);
      EXPECT_TRUE(ends_at(*placed.shape, *near, within) || has_both_sides(placed.inside, *near, random))
          << "not on the surface";
    }
    EXPECT_GE(told, 20);
  });
}

TEST(Solids, EdgesAreWhereTheFacesMeet) {
  for (const Sample& sample : samples()) {
    const std::unique_ptr<Shape> shape = sample.make();
    EXPECT_EQ(shape->has_edges(shape->bounds()), sample.has_edges) << sample.name;
  }
  const auto can = cylinder({0, 0, 0}, {0, 0, 4}, 2, 0);
  EXPECT_FALSE(can->has_edges({{1.9, -0.1, 1.9}, {2.1, 0.1, 2.1}})) << "on its wall";
  EXPECT_FALSE(can->has_edges({{-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}})) << "on its end";
  EXPECT_TRUE(can->has_edges({{1.9, -0.1, -0.1}, {2.1, 0.1, 0.1}})) << "on its rim";
  const auto tip = cone({0, 0, 0}, {0, 0, 4}, 2, 0);
  EXPECT_TRUE(tip->has_edges({{-0.1, -0.1, 3.9}, {0.1, 0.1, 4.1}}));
  EXPECT_FALSE(tip->has_edges({{-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}}));
  const auto cube = box({0, 0, 0}, {4, 4, 4});
  EXPECT_TRUE(cube->has_edges({{-0.1, -0.1, 1}, {0.1, 0.1, 1.2}}));
  EXPECT_FALSE(cube->has_edges({{-0.1, 2, 2}, {0.1, 2.2, 2.2}}));
  const auto prism = extrusion({0, 0, 0}, {0, 0, 4}, {1, 0, 0}, notched());
  EXPECT_TRUE(prism->has_edges({{1.9, 0.9, 2}, {2.1, 1.1, 2.2}})) << "in its notch";
  EXPECT_TRUE(prism->has_edges({{0.9, -0.1, -0.1}, {1.1, 0.1, 0.1}})) << "on its rim";
  EXPECT_FALSE(prism->has_edges({{0.9, -0.1, 1}, {1.1, 0.1, 1.2}}));
}

TEST(Solids, EdgesArePlacesWhereADifferenceHasTwoSurfaces) {
  const auto drilled = drilled_box();
  EXPECT_TRUE(drilled->has_edges({{1.4, 0.9, 2.9}, {1.6, 1.1, 3.1}})) << "the rim of the hole";
  EXPECT_FALSE(drilled->has_edges({{1.45, 0.95, 1}, {1.55, 1.05, 1.1}})) << "its wall";
  EXPECT_TRUE(drilled->is_gentle({{1.45, 0.95, 1}, {1.55, 1.05, 1.1}}));
  EXPECT_FALSE(drilled->is_gentle({{1.4, 0.9, 2.9}, {1.6, 1.1, 3.1}}));
  EXPECT_FALSE(drilled->has_edges({{0.9, 0.9, 2.9}, {1.1, 1.1, 3.1}})) << "the edge lies in the hole";
}

TEST(Solids, GentleSurfacesTurnLittleWithinABox) {
  const auto at = [](const Vec3& p, double size) {
    const Vec3 half{size / 2, size / 2, size / 2};
    return Box{p - half, p + half};
  };
  const auto ball = ellipsoid({0, 0, 0}, {2, 2, 2});
  EXPECT_TRUE(ball->is_gentle(at({2, 0, 0}, 0.99)));
  EXPECT_FALSE(ball->is_gentle(at({2, 0, 0}, 1.01)));
  const auto ring = torus({0, 0, 0}, {0, 0, 1}, 4, 1);
  EXPECT_TRUE(ring->is_gentle(at({5, 0, 0}, 0.49)));
  EXPECT_FALSE(ring->is_gentle(at({5, 0, 0}, 0.51)));
  const auto can = cylinder({0, 0, 0}, {0, 0, 4}, 2, 0);
  EXPECT_TRUE(can->is_gentle(at({2, 0, 2}, 0.5)));
  EXPECT_FALSE(can->is_gentle(at({2, 0, 2}, 1.1)));
  EXPECT_TRUE(can->is_gentle(at({0, 0, 0}, 1))) << "its end is flat";
  EXPECT_FALSE(can->is_gentle(at({2, 0, 0}, 0.1))) << "its rim";
  const auto thin = box({0, 0, 0}, {9, 9, 0.1});
  EXPECT_FALSE(thin->is_gentle(at({4, 4, 0}, 1))) << "two faces";
  EXPECT_TRUE(thin->is_gentle(at({4, 4, 0}, 0.05)));
}

TEST(Solids, BoxesMeetBoxesExactly) {
  const auto brick = box({0.1, 0.2, 0.3}, {0.7, 0.8, 0.9});
  EXPECT_TRUE(brick->contains({{0.1, 0.2, 0.3}, {0.7, 0.8, 0.9}}));
  EXPECT_FALSE(brick->contains({{0.1, 0.2, 0.3}, {0.7, 0.8, 0.9000001}}));
  EXPECT_TRUE(brick->misses({{0.7, 0.2, 0.3}, {5, 5, 5}}));
  EXPECT_FALSE(brick->misses({{0.6999999, 0.2, 0.3}, {5, 5, 5}}));
  EXPECT_TRUE(brick->misses({{0, 0, 0}, {0.1, 1, 1}}));
}

TEST(Solids, SteepestAxisIsThatOfTheNormal) {
  const auto brick = box({0, 0, 0}, {4, 4, 4});
  EXPECT_EQ(brick->steepest_axis({3.9, 2, 2}), 0U);
  EXPECT_EQ(brick->steepest_axis({2, -0.5, 2}), 1U);
  EXPECT_EQ(brick->steepest_axis({2, 2, 4}), 2U) << "on the surface";
  EXPECT_EQ(brick->steepest_axis({2, 4, 2}), 1U) << "on the surface";
  const auto can = cylinder({0, 0, 0}, {9, 0, 0}, 2, 0);
  EXPECT_EQ(can->steepest_axis({4, 0, 2}), 2U) << "on the surface";
  EXPECT_EQ(can->steepest_axis({0, 1, 0}), 0U) << "on the surface";
  EXPECT_EQ(can->steepest_axis({4, 2.5, 0.1}), 1U);
  EXPECT_EQ(drilled_box()->steepest_axis({1, 0.55, 1}), 1U);
}

TEST(Solids, MovesFollowOneAnother) {
  // First a quarter turn around z and a step along x, then a step along y.
  const auto once = moved(box({1, 0, 0}, {3, 1, 1}), {{10, 0, 0}, {{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}}});
  EXPECT_EQ(once->bounds().lo, (Vec3{9, 1, 0}));
  EXPECT_EQ(once->bounds().hi, (Vec3{10, 3, 1}));
  const auto twice =
      moved(moved(box({1, 0, 0}, {3, 1, 1}), {{10, 0, 0}, {{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}}}),
            {{0, 0, 5}, {{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}}});
  EXPECT_EQ(twice->bounds().lo, (Vec3{9, -1, 6}));
  EXPECT_EQ(twice->bounds().hi, (Vec3{10, 0, 8}));
}

// Tells its chords only within a box: a stand-in for solids with many facets.
class Searched final : public Shape {
 public:
  explicit Searched(std::unique_ptr<Shape> shape) : shape_(std::move(shape)) {}
  [[nodiscard]] Box bounds() const override { return shape_->bounds(); }
  [[nodiscard]] bool contains(const Box& box) const override { return shape_->contains(box); }
  [[nodiscard]] bool misses(const Box& box) const override { return shape_->misses(box); }
  [[nodiscard]] bool is_gentle(const Box& box) const override { return shape_->is_gentle(box); }
  [[nodiscard]] bool has_edges(const Box& box) const override { return shape_->has_edges(box); }
  [[nodiscard]] std::size_t steepest_axis(const Vec3& p) const override { return shape_->steepest_axis(p); }
  void chords(std::size_t, double, std::span<const double>, ChordRow&) const override {
    FAIL() << "a search";
  }
  void line_chords(std::span<const Vec3>, std::span<const Vec3>, ChordRow&) const override {
    FAIL() << "a search";
  }
  [[nodiscard]] const Shape& within(const Box& box, std::unique_ptr<Shape>& storage) const override {
    EXPECT_FALSE(shape_->misses(box));
    storage.reset();
    return *shape_;
  }

 private:
  std::unique_ptr<Shape> shape_;
};

TEST(Solids, SearchesAreLeftToTheShapesWithin) {
  std::vector<std::shared_ptr<const Shape>> slot;
  slot.push_back(box({1.5, -9, -9}, {2, 9, 9}));
  const Frame quarter{{0, 0, 5}, {{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}}};
  const auto shape =
      moved(difference(std::make_unique<Searched>(samples()[1].make()), std::move(slot)), quarter);
  std::unique_ptr<Shape> storage;
  for (int cell = 0; cell < 2; ++cell) {  // the second one finds the storage of the first
    const Shape& local = shape->within({{-1, 1, 6}, {0, 3, 8}}, storage);
    const std::vector<Piece> pieces = pieces_on(local, {-0.5, 0, 7}, {0, 1, 0});
    ASSERT_EQ(pieces.size(), 2U);
    EXPECT_DOUBLE_EQ(pieces[0].lo, 1);
    EXPECT_DOUBLE_EQ(pieces[0].hi, 1.5);
    EXPECT_DOUBLE_EQ(pieces[1].lo, 2);
    EXPECT_DOUBLE_EQ(pieces[1].hi, 3);
  }
}

TEST(Solids, CornersOfADifferenceAreNotGuessed) {
  std::vector<std::shared_ptr<const Shape>> hole;
  hole.push_back(cylinder({2, 2, 0}, {2, 2, 4}, 1, 0));  // its ends lie in faces of the box
  const auto drilled = difference(box({0, 0, 0}, {4, 4, 4}), std::move(hole));
  EXPECT_FALSE(drilled->nearest_on_surface({2, 2, 4.25})) << "the open end of the hole is no surface";
  EXPECT_EQ(drilled->nearest_on_surface({0.5, 0.75, 4.25}), (Vec3{0.5, 0.75, 4}));
  EXPECT_EQ(drilled->nearest_on_surface({3.25, 2, 2}), (Vec3{3, 2, 2}));
}

std::string message_of(const std::function<void()>& make) {
  try {
    make();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Solids, WhatIsNoSolidIsRefused) {
  const double nan = std::nan("");
  const auto expect = [](const std::string& text, const std::function<void()>& make) {
    const std::string message = message_of(make);
    EXPECT_NE(message.find(text), std::string::npos) << message;
    EXPECT_NE(message.find("expected"), std::string::npos) << message;
  };
  const Vec3 o{0, 0, 0}, z{0, 0, 1};
  expect("radius of an ellipsoid is 0", [&] { (void)ellipsoid(o, {1, 0, 1}); });
  expect("center of an ellipsoid", [&] { (void)ellipsoid({nan, 0, 0}, {1, 1, 1}); });
  expect("side of a box is 0", [&] { (void)box(o, {1, 0, 1}); });
  expect("corner of a box", [&] { (void)box(o, {1, nan, 1}); });
  expect("radius of a cylinder is -1", [&] { (void)cylinder(o, z, -1, 0); });
  expect("radius of a cylinder is nan", [&] { (void)cylinder(o, z, nan, 0); });
  expect("inner radius 2", [&] { (void)cylinder(o, z, 2, 2); });
  expect("inner radius -1", [&] { (void)cylinder(o, z, 2, -1); });
  expect("both ends of its axis", [&] { (void)cylinder(z, z, 2, 1); });
  expect("radii 0 and 0", [&] { (void)cone(o, z, 0, 0); });
  expect("radius of a cone is -1", [&] { (void)cone(o, z, 1, -1); });
  expect("both ends of its axis", [&] { (void)cone(o, o, 1, 1); });
  expect("larger major radius", [&] { (void)torus(o, z, 1, 1); });
  expect("axis of a torus", [&] { (void)torus(o, o, 2, 1); });
  expect("minor radius of a torus is 0", [&] { (void)torus(o, z, 2, 0); });
  expect("3 corners", [&] { (void)polyhedron(std::vector<Vec3>{o, z, {1, 0, 0}}); });
  expect("lie in one plane", [&] {
    (void)polyhedron(std::vector<Vec3>{o, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}});
  });
  expect("point 5 of a polyhedron", [&] {
    (void)polyhedron(std::vector<Vec3>{o, z, {0, 1, 0}, {1, 0, 0}, {0.1, 0.1, 0.1}});
  });
  expect("point 5 of a polyhedron", [&] {
    (void)polyhedron(std::vector<Vec3>{o, z, {0, 1, 0}, {1, 0, 0}, {0.5, 0, 0}});
  });
  const std::vector<HalfSpace> open{{o, {-1, 0, 0}}, {o, {0, -1, 0}}, {o, {0, 0, -1}}, {z, {1, 1, 0}}};
  expect("infinity", [&] { (void)planes(open); });
  expect("infinity", [&] { (void)planes({}); });
  std::vector<HalfSpace> empty = open;
  empty.push_back({{-1, -1, -1}, {1, 1, 1}});
  expect("no volume", [&] { (void)planes(empty); });
  const std::vector<Point2> bow{{0, 0}, {2, 2}, {2, 0}, {0, 2}}, two{{0, 0}, {1, 1}},
      same{{0, 0}, {1, 0}, {1, 0}, {0, 1}}, back{{0, 0}, {2, 0}, {1, 0}}, left{{-1, 0}, {1, 0}, {1, 1}};
  expect("touch", [&] { (void)revolution(o, z, bow); });
  expect("2 corners", [&] { (void)revolution(o, z, two); });
  expect("corner 1 is at -1", [&] { (void)revolution(o, z, left); });
  expect("touch", [&] { (void)extrusion(o, z, {1, 0, 0}, bow); });
  expect("touch", [&] { (void)extrusion(o, z, {1, 0, 0}, back); });
  expect("corners 2 and 3", [&] { (void)extrusion(o, z, {1, 0, 0}, same); });
  expect("direction of u", [&] { (void)extrusion(o, z, {0, 0, 2}, left); });
}

}  // namespace
}  // namespace sculpt
