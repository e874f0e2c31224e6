#include "sculpt/facets/facet_features.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "sculpt/facets/facet_surfaces.hpp"
#include "solids/solids.hpp"

namespace sculpt {
namespace {

// As a reader of binary STL files gets it.
FacetMesh divided(const examples::Facets& facets, double angle = 30) {
  FacetMesh mesh = parse_stl(examples::binary_stl(facets, "test"), "test.stl");
  (void)repair(mesh);
  divide_facets(mesh, angle);
  return mesh;
}

TEST(DivideFacets, FindsTheSidesAndCornersOfABox) {
  const FacetMesh mesh = divided(examples::box({1, 2, 3}));
  EXPECT_EQ(mesh.surfaces, 6);
  EXPECT_EQ(mesh.corners, 8);
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 2) EXPECT_EQ(mesh.surface[t], mesh.surface[t + 1]);
}

TEST(DivideFacets, FindsTheWallAndTheEndsOfACylinder) {
  const FacetMesh mesh = divided(examples::cylinder(1, 1, 24));  // 15 degrees from facet to facet
  EXPECT_EQ(mesh.surfaces, 3);
  EXPECT_EQ(mesh.corners, 0);
  EXPECT_EQ(divided(examples::cylinder(1, 1, 24), 14).surfaces, 26) << "every side by itself";
  EXPECT_EQ(divided(examples::cylinder(1, 1, 24), 14).corners, 48);
}

TEST(DivideFacets, LeavesASphereWhole) {
  const FacetMesh mesh = divided(examples::sphere(3));
  EXPECT_EQ(mesh.surfaces, 1);
  EXPECT_EQ(mesh.corners, 0);
}

TEST(DivideFacets, EndsSurfacesBetweenTheSolidsOfTheFile) {
  FacetMesh mesh = divided(examples::box({1, 2, 3}));
  mesh.part.assign(mesh.triangles.size(), 0);
  mesh.part[1] = 1;  // one half of a side
  divide_facets(mesh, 30);
  EXPECT_EQ(mesh.surfaces, 7);
}

TEST(DivideFacets, FindsTheSurfacesOfABracket) {
  const FacetMesh mesh = divided(examples::bracket(32));
  EXPECT_EQ(mesh.surfaces, 10) << "two plates of three each, two sides, two ends";
  EXPECT_EQ(mesh.corners, 12);
}

class Features : public ::testing::Test {
 protected:
  const FacetMesh box_ = divided(examples::box({1, 2, 3}));
  const FacetFeatures features_{{{&box_, 4}}, 1};

  [[nodiscard]] std::int32_t surface_at(const Vec3& p) const { return features_.nearest(p, 4, 0)->surface; }
  const std::int32_t xmax_ = surface_at({1, 0, 0}), ymax_ = surface_at({0, 2, 0}),
                     zmin_ = surface_at({0, 0, -3});
};

TEST_F(Features, NearestSurfaceOfTheMaterialsThatAreAskedFor) {
  const auto found = features_.nearest({1.5, 0.5, 1}, 4, 7);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(norm(found->point - Vec3{1, 0.5, 1}), 0, 1e-12);
  EXPECT_EQ(found->surface, xmax_);
  EXPECT_FALSE(features_.nearest({1.5, 0.5, 1}, 3, 5).has_value()) << "no solid of these materials";
  EXPECT_FALSE(features_.nearest({2.5, 0.5, 1}, 4, 7).has_value()) << "beyond the reach";
}

TEST_F(Features, PointsOfOneSurfaceOnly) {
  const std::optional<Vec3> q = features_.on_surface(xmax_, {0.5, 1.9, 0});
  ASSERT_TRUE(q.has_value());
  EXPECT_NEAR(norm(*q - Vec3{1, 1.9, 0}), 0, 1e-12) << "although the side ymax is nearer";
}

TEST_F(Features, EdgesAreCurvesOfTheirTwoSides) {
  for (const auto& [a, b] : {std::pair{xmax_, ymax_}, std::pair{ymax_, xmax_}}) {
    const std::optional<Vec3> q = features_.on_curve(a, b, {0.7, 1.8, 0.4});
    ASSERT_TRUE(q.has_value());
    EXPECT_NEAR(norm(*q - Vec3{1, 2, 0.4}), 0, 1e-12);
  }
  EXPECT_FALSE(features_.on_curve(xmax_, surface_at({-1, 0, 0}), {0, 0, 0}).has_value()) << "opposite sides";
}

TEST_F(Features, CornersAreWhereAllTheSidesMeet) {
  std::vector<std::int32_t> sides{xmax_, ymax_, zmin_};
  std::sort(sides.begin(), sides.end());
  const auto corner = features_.at_corner(sides, {0.8, 1.9, -2.7});
  ASSERT_TRUE(corner.has_value());
  EXPECT_EQ(corner->point, (Vec3{1, 2, -3}));
  EXPECT_FALSE(features_.at_corner(sides, {-0.8, 1.9, -2.7}).has_value()) << "another corner is there";
}

TEST(FacetFeatures, NumberSurfacesThroughAllSolids) {
  const FacetMesh box = divided(examples::box({1, 1, 1}));
  examples::Facets away = examples::cylinder(1, 1, 24);
  for (examples::Facet& f : away)
    for (Vec3& p : f) p.x += 5;
  const FacetMesh cylinder = divided(away);
  const FacetFeatures features({{&box, 0}, {&cylinder, 1}}, 2);
  EXPECT_LT(features.nearest({1.1, 0, 0}, 0, 1)->surface, 6);
  std::set<std::int32_t> found;
  for (const Vec3& p : {Vec3{5, 0, 1.1}, Vec3{5, 0, -1.1}, Vec3{6.2, 0, 0}})
    found.insert(features.nearest(p, 0, 1)->surface);
  EXPECT_EQ(found, (std::set<std::int32_t>{6, 7, 8}));
}

}  // namespace
}  // namespace sculpt
