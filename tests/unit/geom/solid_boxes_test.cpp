#include "solid_samples.hpp"

namespace sculpt {
namespace {

TEST(SolidBoxes, BoxesInsideAndOutsideAreToldApart) {
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

TEST(SolidBoxes, PointsAreBoxes) {
  for_placed([](const Placed& placed, Random& random) {
    for (int n = 0; n < 100; ++n) {
      const Vec3 p = random.in(placed.shape->bounds());
      EXPECT_EQ(placed.shape->contains({p, p}), placed.inside(p));
      EXPECT_EQ(placed.shape->misses({p, p}), !placed.inside(p));
    }
  });
}

TEST(SolidBoxes, EdgesAreWhereTheFacesMeet) {
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

TEST(SolidBoxes, EdgesArePlacesWhereADifferenceHasTwoSurfaces) {
  const auto drilled = drilled_box();
  EXPECT_TRUE(drilled->has_edges({{1.4, 0.9, 2.9}, {1.6, 1.1, 3.1}})) << "the rim of the hole";
  EXPECT_FALSE(drilled->has_edges({{1.45, 0.95, 1}, {1.55, 1.05, 1.1}})) << "its wall";
  EXPECT_TRUE(drilled->is_gentle({{1.45, 0.95, 1}, {1.55, 1.05, 1.1}}));
  EXPECT_FALSE(drilled->is_gentle({{1.4, 0.9, 2.9}, {1.6, 1.1, 3.1}}));
  EXPECT_FALSE(drilled->has_edges({{0.9, 0.9, 2.9}, {1.1, 1.1, 3.1}})) << "the edge lies in the hole";
}

TEST(SolidBoxes, GentleSurfacesTurnLittleWithinABox) {
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

TEST(SolidBoxes, GentleOnesAreMeasuredByFewLines) {
  int gentle = 0;
  for_placed([&](const Placed& placed, Random& random) {
    const double size = largest(placed.shape->bounds().hi - placed.shape->bounds().lo);
    for (int n = 0, found = 0; n < 200 && found < 3; ++n) {
      const Vec3 middle = random.in(placed.shape->bounds());
      const double half = random.between(0.01, 0.06) * size;
      const Box box{middle - Vec3{half, half, half}, middle + Vec3{half, half, half}};
      if (placed.shape->contains(box) || placed.shape->misses(box) || !placed.shape->is_gentle(box)) continue;
      ++found;
      ++gentle;
      const std::size_t axis = placed.shape->steepest_axis(middle);
      const double few =
          (4 * share_of(*placed.shape, box, axis, 16) - share_of(*placed.shape, box, axis, 8)) / 3;
      const double many = share_of(*placed.shape, box, axis, 64);
      EXPECT_NEAR(few, many, 1e-3);
    }
  });
  EXPECT_GT(gentle, 80);
}

TEST(SolidBoxes, BoxesMeetBoxesExactly) {
  const auto brick = box({0.1, 0.2, 0.3}, {0.7, 0.8, 0.9});
  EXPECT_TRUE(brick->contains({{0.1, 0.2, 0.3}, {0.7, 0.8, 0.9}}));
  EXPECT_FALSE(brick->contains({{0.1, 0.2, 0.3}, {0.7, 0.8, 0.9000001}}));
  EXPECT_TRUE(brick->misses({{0.7, 0.2, 0.3}, {5, 5, 5}}));
  EXPECT_FALSE(brick->misses({{0.6999999, 0.2, 0.3}, {5, 5, 5}}));
  EXPECT_TRUE(brick->misses({{0, 0, 0}, {0.1, 1, 1}}));
}

TEST(SolidBoxes, SteepestAxisIsThatOfTheNormal) {
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

}  // namespace
}  // namespace sculpt
