#include "balls.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace microstructure {
namespace {

TEST(Balls, FillPartOfTheBox) {
  const Voxels voxels = make_balls({{26, 26, 26}, 8, 1});
  const auto matrix = std::count(voxels.values.begin(), voxels.values.end(), 1);
  const auto balls = std::count(voxels.values.begin(), voxels.values.end(), 2);
  EXPECT_EQ(matrix + balls, 26 * 26 * 26);
  EXPECT_GT(balls, 26 * 26 * 26 / 10);
  EXPECT_GT(matrix, 26 * 26 * 26 / 2);
}

TEST(Balls, NeedRoom) { EXPECT_THROW((void)make_balls({{4, 4, 4}, 100, 1}), std::runtime_error); }

}  // namespace
}  // namespace microstructure
