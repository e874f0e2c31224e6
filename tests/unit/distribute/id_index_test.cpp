#include "distribute/id_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace sculpt {
namespace {

using Corners = std::vector<std::array<GlobalId, 8>>;

void expect_set(const Corners& corners, const std::vector<GlobalId>& ids) {
  const IdIndex set(corners);
  EXPECT_EQ(set.ids(), ids);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    EXPECT_EQ(set.index(ids[i]), static_cast<LocalId>(i));
    for (const GlobalId near : {ids[i] - 1, ids[i] + 1, ids[i] + 64})
      if (!std::binary_search(ids.begin(), ids.end(), near)) EXPECT_EQ(set.index(near), kNone);
  }
  EXPECT_EQ(set.index(-1), kNone);
  EXPECT_EQ(set.index(GlobalId{1} << 60), kNone);
}

TEST(IdIndex, HoldsNumbersNearEachOther) {
  expect_set({{100, 3, 64, 63, 65, 100, 7, 130}, {3, 200, 201, 202, 203, 204, 205, 206}},
             {3, 7, 63, 64, 65, 100, 130, 200, 201, 202, 203, 204, 205, 206});
}
TEST(IdIndex, HoldsNumbersFarFromEachOther) {
  expect_set({{GlobalId{1} << 50, 3, 64, 3, 65, 100, 7, 130}}, {3, 7, 64, 65, 100, 130, GlobalId{1} << 50});
}
TEST(IdIndex, MayBeEmpty) { expect_set({}, {}); }

}  // namespace
}  // namespace sculpt
