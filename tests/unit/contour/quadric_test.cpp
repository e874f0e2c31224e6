#include "sculpt/contour/quadric.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace sculpt {
namespace {

constexpr Vec3 kUp{0, 0, 1};

double height(double x, double y) { return 0.1 * x - 0.2 * y + 0.15 * x * x + 0.1 * x * y - 0.05 * y * y; }

// The eight nodes of the four quads around the origin.
std::vector<Vec3> ring(double size) {
  std::vector<Vec3> points;
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j)
      if (i != 0 || j != 0) points.push_back({size * i, size * j, height(size * i, size * j)});
  return points;
}

TEST(FitQuadric, FindsAQuadric) {
  for (const double size : {1.0, 0.01}) {
    const Vec3 shift{3, -2, 7};
    std::vector<Vec3> points = ring(size);
    for (Vec3& p : points) p += shift;
    const Quadric q = fit_quadric(shift, kUp, points);
    for (const Vec3& at : {Vec3{0.3, 0.2, 0.7}, Vec3{-0.5, 0.4, 0}, Vec3{0, -0.6, -1}}) {
      const Vec3 on = onto_quadric(q, shift + size * at);
      EXPECT_NEAR(on.x - shift.x, size * at.x, 1e-12 * size);
      EXPECT_NEAR(on.y - shift.y, size * at.y, 1e-12 * size);
      EXPECT_NEAR(on.z - shift.z, height(size * at.x, size * at.y), 1e-10 * size);
    }
  }
}

TEST(FitQuadric, DoesNotDependOnTheFrame) {
  const Vec3 normal = unit({1, 2, 2}), u = unit({2, -2, 1}), v = cross(normal, u);
  std::vector<Vec3> points;
  for (const Vec3& p : ring(1)) points.push_back(p.x * u + p.y * v + p.z * normal);
  const Quadric q = fit_quadric({}, normal, points);
  const Vec3 on = onto_quadric(q, 0.3 * u - 0.4 * v);
  EXPECT_NEAR(dot(on, normal), height(0.3, -0.4), 1e-10);
}

TEST(FitQuadric, WithTooFewPointsIsFlatter) {
  // Three points of a plane: the plane.
  const std::vector<Vec3> plane{{1, 0, 0.2}, {0, 1, -0.1}, {-1, -1, -0.1}};
  const Quadric q = fit_quadric({}, kUp, plane);
  EXPECT_NEAR(onto_quadric(q, {0.5, 0.25, 3}).z, 0.2 * 0.5 - 0.1 * 0.25, 0.01);
  // None or one on the spot: stays.
  EXPECT_EQ(onto_quadric(fit_quadric({1, 2, 3}, kUp, {}), {1, 2, 5}), (Vec3{1, 2, 3}));
  const std::vector<Vec3> same(6, Vec3{1, 2, 3});
  EXPECT_EQ(onto_quadric(fit_quadric({1, 2, 3}, kUp, same), {1, 2, 5}), (Vec3{1, 2, 3}));
  // All on a line: nothing is known across it.
  const std::vector<Vec3> line{{1, 0, 0}, {2, 0, 0}, {-1, 0, 0}, {-2, 0, 0}, {3, 0, 0}, {-3, 0, 0}};
  EXPECT_NEAR(onto_quadric(fit_quadric({}, kUp, line), {0.5, 0.5, 1}).z, 0, 1e-9);
}

TEST(OntoQuadric, StaysNear) {
  const Quadric q = fit_quadric({}, kUp, ring(1));
  const Vec3 far = onto_quadric(q, {100, 0, 0});
  EXPECT_NEAR(far.x, q.reach, 1e-12);
  Quadric steep = q;
  steep.a = {5, 0, 0, 0, 0};
  EXPECT_NEAR(onto_quadric(steep, {1, 0, 0}).z, 0.5 * q.reach, 1e-12);
}

}  // namespace
}  // namespace sculpt
