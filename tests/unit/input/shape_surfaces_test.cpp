#include "input/shape_surfaces.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace sculpt
