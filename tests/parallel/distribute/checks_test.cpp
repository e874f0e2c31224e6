// Checks of unstructured meshes say the same whoever has which elements.
#include <gtest/gtest.h>

#include "sculpt/distribute/cartesian_grid.hpp"
#include "sculpt/distribute/repartition.hpp"
#include "support/cases.hpp"
#include "support/faulty_meshes.hpp"

namespace sculpt::test {
namespace {

TEST(Conformity, IsTheSameWhoeverHasWhat) {
  const Comm world = Comm::world();
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    for (const FaultyMesh& faulty : faulty_meshes())
      EXPECT_EQ(conformity_message(world, dealt(world, faulty.mesh, 20 * seed)), faulty.message)
          << faulty.mesh.name;
    for (const WholeMesh& mesh : conforming_meshes()) {
      ElementShare share = dealt(world, mesh, 20 * seed);
      EXPECT_EQ(conformity_message(world, share), "") << mesh.name;
      repartition(world, share, PartitionMethod::kRcb);
      EXPECT_EQ(conformity_message(world, share), "") << mesh.name;
    }
  }
}

TEST(CartesianGrid, IsFoundWhoeverHasWhat) {
  const Comm world = Comm::world();
  const std::pair<Vec3, Vec3> boxes[] = {
      {{0, 0, 0}, {6, 5, 4}}, {{-1, 2e3, 0.1}, {1, 2.001e3, 0.7}}, {{1, 1, 1}, {7, 1.5, 11}}};
  for (const auto& [lo, hi] : boxes)
    for (const bool turned : {false, true})
      for (std::uint64_t seed = 0; seed < 4; ++seed) {
        const Grid grid = box_grid({6, 5, 4}, lo, hi);
        const WholeMesh mesh = permuted(whole_grid(grid), 30 * seed, turned);
        const ElementShare share = dealt(world, mesh, seed);
        const auto found = cartesian_grid_of(world, share);
        ASSERT_TRUE(found.has_value());
        EXPECT_EQ(found->grid.planes, grid.planes);
        ASSERT_EQ(found->cell.size(), share.element.size());
        for (std::size_t e = 0; e < share.element.size(); ++e) {
          Vec3 centre;
          for (const GlobalId n : share.corner[e])
            centre += 0.125 * mesh.position[static_cast<std::size_t>(n)];
          const Index3 cell = whole(grid.cells).cell(found->cell[e]);
          for (std::size_t d = 0; d < 3; ++d) {
            EXPECT_GT(centre[d], grid.planes[d][static_cast<std::size_t>(cell[d])]);
            EXPECT_LT(centre[d], grid.planes[d][static_cast<std::size_t>(cell[d] + 1)]);
          }
        }
      }
}

TEST(CartesianGrid, IsDeniedOnAllRanks) {
  const Comm world = Comm::world();
  const WholeMesh good = permuted(whole_grid(box_grid({3, 4, 5}, {0, 0, 0}, {3, 4, 5})), 1);
  WholeMesh moved = good, missing = good, twice = good;
  moved.position[17].y += 1e-3;
  missing.corner.pop_back();
  twice.corner[3] = twice.corner[4];
  for (const WholeMesh& mesh : {moved, missing, twice, cylinder(2, 3)})
    EXPECT_FALSE(cartesian_grid_of(world, dealt(world, mesh, 2)).has_value());
}

}  // namespace
}  // namespace sculpt::test
