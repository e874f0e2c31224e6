#include "input/shape_surfaces.hpp"

#include <gtest/gtest.h>

#include <random>

#include "sculpt/geom/sphere.hpp"

namespace sculpt {
namespace {

// Unit cells over [0,20]^3. Dense materials: 0 the outside, 1 and 2 balls.
struct Ball {
  Vec3 centre;
  double radius;
  std::int32_t material;
};
ExactSurface surfaces(const std::vector<Ball>& balls) {
  auto shapes = std::make_shared<std::vector<InsertedShape>>();
  for (const Ball& b : balls) shapes->push_back({std::make_unique<Sphere>(b.centre, b.radius), b.material});
  return surfaces_of(shapes, uniform_grid({20, 20, 20}, {}, {1, 1, 1}));
}

TEST(ShapeSurfaces, FindTheNearestOfTheRightMaterial) {
  const ExactSurface nearest = surfaces({{{5, 5, 5}, 2, 1}, {{10, 5, 5}, 2, 2}});
  EXPECT_EQ(nearest({7.25, 5, 5}, 0, 1), (Vec3{7, 5, 5}));
  EXPECT_EQ(nearest({7.25, 5, 5}, 0, 2), (Vec3{8, 5, 5}));
  EXPECT_EQ(nearest({7.25, 5, 5}, 1, 2), (Vec3{7, 5, 5}));
  EXPECT_EQ(nearest({5, 5, 6.5}, 0, 1), (Vec3{5, 5, 7})) << "from inside";
  EXPECT_FALSE(nearest({7.25, 5, 5}, 0, 3).has_value());
}

TEST(ShapeSurfaces, LookNoFartherThanOneAndAHalfCells) {
  const ExactSurface nearest = surfaces({{{5, 5, 5}, 2, 1}});
  EXPECT_TRUE(nearest({8.4, 5, 5}, 0, 1).has_value());
  EXPECT_FALSE(nearest({8.6, 5, 5}, 0, 1).has_value());
  EXPECT_FALSE(nearest({19, 19, 19}, 0, 1).has_value());
  EXPECT_FALSE(nearest({-3, 40, 5}, 0, 1).has_value()) << "outside the grid";
}

TEST(ShapeSurfaces, PassOverHiddenOnes) {
  // The first ball covers the near side of the second.
  const ExactSurface different = surfaces({{{5, 5, 5}, 3, 1}, {{8, 5, 5}, 3, 2}});
  EXPECT_FALSE(different({5, 5, 5.2}, 0, 2).has_value()) << "its surface lies in the first ball here";
  EXPECT_EQ(different({7.9, 5, 5}, 1, 2), (Vec3{8, 5, 5}));
  EXPECT_EQ(different({11.5, 5, 5}, 0, 2), (Vec3{11, 5, 5}));
  // Two balls of one material are one body: neither shows a surface inside the other.
  const ExactSurface same = surfaces({{{5, 5, 5}, 3, 1}, {{8, 5, 5}, 3, 1}});
  EXPECT_FALSE(same({7.5, 5, 5}, 0, 1).has_value());
  EXPECT_EQ(same({5, 8.5, 5}, 0, 1), (Vec3{5, 8, 5}));
}

TEST(ShapeSurfaces, FindAmongManyWhatGoingThroughAllFinds) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place(-1, 21), size(0.2, 0.6);
  std::vector<Ball> balls;
  for (int n = 0; n < 3000; ++n)
    balls.push_back({{place(random), place(random), place(random)}, size(random), 1 + n % 2});
  const ExactSurface nearest = surfaces(balls);
  int found = 0;
  for (int n = 0; n < 500; ++n) {
    const Vec3 p{place(random), place(random), place(random)};
    std::optional<Vec3> expected;
    double least = 1.5;
    for (std::size_t s = 0; s < balls.size(); ++s) {
      if (balls[s].material != 1) continue;
      const Vec3 off = p - balls[s].centre, q = balls[s].centre + (balls[s].radius / norm(off)) * off;
      if (!(norm(q - p) < least)) continue;
      bool hidden = false;
      for (std::size_t t = 0; t < balls.size(); ++t)
        hidden = hidden || (t != s && (t < s || balls[t].material == 1) &&
                            Sphere(balls[t].centre, balls[t].radius).contains({q, q}));
      if (hidden) continue;
      least = norm(q - p);
      expected = q;
    }
    EXPECT_EQ(nearest(p, 0, 1), expected);
    found += expected.has_value();
  }
  EXPECT_GT(found, 100);
}

}  // namespace
}  // namespace sculpt
