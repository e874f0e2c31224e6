// Also run on several ranks: tests/parallel/distribute.
#include "sculpt/distribute/cartesian_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/shares.hpp"

namespace sculpt::test {
namespace {

std::optional<CartesianShare> detected(const WholeMesh& mesh) {
  return cartesian_grid_of(Comm::self(), in_pieces(Comm::self(), mesh));
}

TEST(CartesianGrid, IsFoundInItsOwnNumbering) {
  const Grid grid = box_grid({3, 4, 5}, {0, -1, 2}, {1, 1, 2.5});
  const auto found = detected(whole_grid(grid));
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->grid.planes, grid.planes);
  for (std::size_t e = 0; e < found->cell.size(); ++e) EXPECT_EQ(found->cell[e], static_cast<GlobalId>(e));
}

TEST(CartesianGrid, IsOneCellAtLeast) {
  const auto found = detected(whole_grid(box_grid({1, 1, 1}, {0, 0, 0}, {1, 2, 3})));
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->grid.cells, (Index3{1, 1, 1}));
}

TEST(CartesianGrid, ForgivesRounding) {
  WholeMesh mesh = whole_grid(uniform_grid({40, 2, 2}, {1e5, 0, 0}, {0.1, 0.1, 0.1}));
  EXPECT_TRUE(detected(mesh).has_value());
  mesh.position[20].x += 0.1 * 0.5e-9;
  EXPECT_TRUE(detected(mesh).has_value());
  mesh.position[20].x += 0.1 * 5e-9;
  EXPECT_FALSE(detected(mesh).has_value());
}

TEST(CartesianGrid, IsNotFoundInOtherMeshes) {
  const WholeMesh good = permuted(whole_grid(box_grid({3, 4, 5}, {0, 0, 0}, {3, 4, 5})), 1);
  WholeMesh moved = good;
  moved.position[17].y += 1e-3;
  EXPECT_FALSE(detected(moved).has_value());

  WholeMesh missing = good;
  missing.corner.pop_back();
  EXPECT_FALSE(detected(missing).has_value());

  WholeMesh twice = good;
  twice.corner[3] = twice.corner[4];
  EXPECT_FALSE(detected(twice).has_value());

  WholeMesh inside_out = good;
  std::swap_ranges(inside_out.corner[3].begin(), inside_out.corner[3].begin() + 4,
                   inside_out.corner[3].begin() + 4);
  EXPECT_FALSE(detected(inside_out).has_value());

  WholeMesh twisted = good;
  std::swap(twisted.corner[3][5], twisted.corner[3][6]);
  EXPECT_FALSE(detected(twisted).has_value());

  WholeMesh spare = good;  // a node that no element has, where another is
  spare.position.push_back(spare.position[0]);
  EXPECT_FALSE(detected(spare).has_value());

  Grid grid = box_grid({3, 4, 5}, {0, 0, 0}, {3, 4, 5});
  grid.planes[0][1] += 0.1;
  EXPECT_FALSE(detected(whole_grid(grid)).has_value());

  WholeMesh sheared = good;
  for (Vec3& p : sheared.position) p.x += 0.1 * p.z;
  EXPECT_FALSE(detected(sheared).has_value());

  // Two layers that do not share their nodes: as many elements, more nodes.
  WholeMesh apart = whole_grid(box_grid({2, 2, 1}, {0, 0, 0}, {2, 2, 1}));
  append(apart, whole_grid(box_grid({2, 2, 1}, {0, 0, 1}, {2, 2, 2})));
  EXPECT_FALSE(detected(apart).has_value());

  EXPECT_FALSE(detected(cylinder(2, 3)).has_value());
}

}  // namespace
}  // namespace sculpt::test
