#include "solid_samples.hpp"

namespace sculpt {
namespace {

double volume_of(const Shape& shape, std::size_t axis) {
  const Vec3 size = shape.bounds().hi - shape.bounds().lo;
  return share_of(shape, shape.bounds(), axis, 100) * size.x * size.y * size.z;
}

TEST(SolidLines, VolumesAreThoseOfTheFormulas) {
  unsigned seed = 100;
  for (const Sample& sample : samples()) {
    Random random(seed++);
    const std::unique_ptr<Shape> shape = moved(sample.make(), random_frame(random));
    double mean = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double error = volume_of(*shape, axis) / sample.volume - 1;
      EXPECT_LT(std::fabs(error), 2e-3) << sample.name << ", axis " << axis;
      mean += error / 3;
    }
    EXPECT_LT(std::fabs(mean), 1e-3) << sample.name;
  }
}

TEST(SolidLines, PiecesOfLinesEndWhereTheSolidDoes) {
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
TEST(SolidLines, LinesThroughOddPlacesAreWhole) {
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

TEST(SolidLines, PointsOfTheAxisAreInside) {
  const Vec3 on_axis{0, 0, 2};
  EXPECT_TRUE(cylinder({0, 0, 1}, {0, 0, 4}, 1, 0)->contains({on_axis, on_axis}));
  EXPECT_TRUE(cone({0, 0, 4}, {0, 0, 1}, 1, 0)->contains({on_axis, on_axis}));
  EXPECT_FALSE(cylinder({0, 0, 1}, {0, 0, 4}, 1, 0.1)->contains({on_axis, on_axis}));
  EXPECT_NEAR(pieces_on(*cylinder({0, 0, 1}, {0, 0, 4}, 1, 0), {0, 0, -1}, {0, 0, 1}).at(0).hi, 5, 1e-14);
}

TEST(SolidLines, LinesWithoutLengthHaveNoPiece) {
  for_placed([](const Placed& placed, Random& random) {
    EXPECT_TRUE(pieces_on(*placed.shape, random.in(placed.shape->bounds()), {}).empty());
  });
}

TEST(SolidLines, LinesAlongTheAxesAreLinesLikeOthers) {
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

TEST(SolidLines, BoundsHoldAllPieces) {
  for_placed([](const Placed& placed, Random& random) {
    const Box bounds = placed.shape->bounds(), more = grown(bounds, 0.2);
    for (int n = 0; n < 1000; ++n) {
      const Vec3 p = random.in(more);
      if (!placed.inside(p)) continue;
      for (std::size_t d = 0; d < 3; ++d) EXPECT_TRUE(bounds.lo[d] <= p[d] && p[d] <= bounds.hi[d]);
    }
  });
}

}  // namespace
}  // namespace sculpt
