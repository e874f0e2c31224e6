// Also run on several ranks: tests/parallel/distribute.
#include "sculpt/distribute/conformity.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "distribute/face_search.hpp"
#include "support/faulty_meshes.hpp"

namespace sculpt::test {
namespace {

TEST(Conformity, IsFoundInGoodMeshes) {
  for (const WholeMesh& mesh : conforming_meshes())
    EXPECT_NO_THROW(check_conformity(Comm::self(), in_pieces(Comm::self(), mesh))) << mesh.name;
}

TEST(Conformity, IsRefusedWithNumbersAndPlace) {
  for (const FaultyMesh& faulty : faulty_meshes())
    EXPECT_EQ(conformity_message(Comm::self(), in_pieces(Comm::self(), faulty.mesh)), faulty.message)
        << faulty.mesh.name;
}

TEST(DistanceToTriangle, IsThatOfTheNearestPoint) {
  const Vec3 a{0, 0, 0}, b{2, 0, 0}, c{0, 2, 0};
  EXPECT_DOUBLE_EQ(distance_to_triangle({0.5, 0.5, 3}, a, b, c), 3);           // inside
  EXPECT_DOUBLE_EQ(distance_to_triangle({1, -1, 0}, a, b, c), 1);              // an edge
  EXPECT_DOUBLE_EQ(distance_to_triangle({2, 2, 0}, a, b, c), std::sqrt(2.0));  // another
  EXPECT_DOUBLE_EQ(distance_to_triangle({-3, -4, 0}, a, b, c), 5);             // a corner
  EXPECT_DOUBLE_EQ(distance_to_triangle({1, 1, 0}, a, b, c), 0);               // on an edge
  EXPECT_DOUBLE_EQ(distance_to_triangle({1, 2, 0}, a, b, {4, 0, 0}), 2);       // a flat triangle
}

}  // namespace
}  // namespace sculpt::test
