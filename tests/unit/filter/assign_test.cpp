#include <gtest/gtest.h>

#include "sculpt/filter/filter.hpp"
#include "support/stages.hpp"

namespace sculpt {
namespace {

using Entries = std::vector<std::pair<std::int32_t, double>>;

// A row of cells along x.
std::vector<std::int32_t> assigned(const std::vector<Entries>& row) {
  test::Case input =
      test::voxels({static_cast<std::int64_t>(row.size()), 1, 1}, std::vector<std::int32_t>(row.size(), 0));
  input.fill = [&row](const Index3& c, Fractions& f) {
    for (const auto& [m, v] : row[static_cast<std::size_t>(c[0])]) f.add(m, v);
  };
  return test::overlay(input).cells.material;
}

TEST(AssignMaterials, TakesTheLargestFraction) {
  EXPECT_EQ(assigned({{{0, 0.2}, {3, 0.5}, {7, 0.3}}, {{5, 1}}, {{1, 0.6}, {2, 0.4}}}),
            (std::vector<std::int32_t>{3, 5, 1}));
}

TEST(AssignMaterials, TiesGoToTheOneWithMoreAround) {
  EXPECT_EQ(assigned({{{2, 1}}, {{1, 0.5}, {2, 0.5}}, {{1, 0.4}, {2, 0.6}}}),
            (std::vector<std::int32_t>{2, 2, 2}));
  EXPECT_EQ(assigned({{{1, 1}}, {{1, 0.5}, {2, 0.5}}, {{1, 0.2}, {2, 0.8}}}),
            (std::vector<std::int32_t>{1, 1, 2}));
}

TEST(AssignMaterials, FullTiesGoToTheSmallerId) {
  EXPECT_EQ(assigned({{{3, 1}}, {{3, 0.5}, {4, 0.5}}, {{4, 1}}}), (std::vector<std::int32_t>{3, 3, 4}));
  EXPECT_EQ(assigned({{{4, 1}}, {{3, 0.5}, {4, 0.5}}, {{3, 1}}}), (std::vector<std::int32_t>{4, 3, 3}));
  EXPECT_EQ(assigned({{{0, 0.25}, {1, 0.25}, {2, 0.25}, {3, 0.25}}}), (std::vector<std::int32_t>{0}));
}

TEST(AssignMaterials, AThreeWayTieLooksAtAllThree) {
  EXPECT_EQ(assigned({{{2, 1}}, {{0, 1.0 / 3}, {1, 1.0 / 3}, {2, 1.0 / 3}}, {{2, 0.6}, {1, 0.4}}}),
            (std::vector<std::int32_t>{2, 2, 2}));
  EXPECT_EQ(assigned({{{1, 1}}, {{0, 0.2}, {1, 0.4}, {2, 0.4}}, {{1, 1}}}),
            (std::vector<std::int32_t>{1, 1, 1}));
}

}  // namespace
}  // namespace sculpt
