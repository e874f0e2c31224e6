#include "sculpt/par/numbering.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace sculpt {
namespace {

// The same keys on every rank.
std::vector<GlobalId> random_keys(std::size_t count, GlobalId most) {
  std::mt19937_64 random(42);
  std::vector<GlobalId> keys;
  for (std::size_t i = 0; i < count; ++i)
    keys.push_back(std::uniform_int_distribution<GlobalId>(0, most)(random));
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  return keys;
}

GlobalId place(const std::vector<GlobalId>& all, GlobalId key) {
  return std::lower_bound(all.begin(), all.end(), key) - all.begin();
}

void expect_dense(const Comm& comm, const std::vector<GlobalId>& all, const std::vector<GlobalId>& mine) {
  GlobalId total = -1;
  const std::vector<GlobalId> numbers = dense_numbers(comm, mine, total);
  EXPECT_EQ(total, static_cast<GlobalId>(all.size()));
  ASSERT_EQ(numbers.size(), mine.size());
  for (std::size_t i = 0; i < mine.size(); ++i) EXPECT_EQ(numbers[i], place(all, mine[i]));
}

TEST(DenseNumbers, AreThoseOfOneRank) {
  const Comm comm = Comm::world();
  for (const GlobalId most : {GlobalId{300}, GlobalId{1} << 60}) {
    const std::vector<GlobalId> all = random_keys(200, most);
    std::vector<GlobalId> mine;  // every key on its rank and the next, some on all
    for (std::size_t i = 0; i < all.size(); ++i) {
      const auto home = static_cast<int>(i % static_cast<std::size_t>(comm.size()));
      if (home == comm.rank() || (home + 1) % comm.size() == comm.rank() || i % 10 == 0)
        mine.push_back(all[i]);
    }
    expect_dense(comm, all, mine);
  }
}

TEST(DenseNumbers, OneRankMayHaveAllOrNone) {
  const Comm comm = Comm::world();
  const std::vector<GlobalId> all = random_keys(50, 1000);
  expect_dense(comm, all, comm.rank() == comm.size() - 1 ? all : std::vector<GlobalId>{});
  expect_dense(comm, {}, {});
  expect_dense(comm, {0}, {0});
}

TEST(GroupedNumbers, RunThroughTheGroupsOneAfterAnother) {
  const Comm comm = Comm::world();
  constexpr std::size_t kGroups = 4;
  const std::vector<GlobalId> all = random_keys(300, GlobalId{1} << 50);
  const auto group_of = [](GlobalId key) {
    return static_cast<std::int32_t>(key % 3);
  };  // group 3 stays empty
  std::vector<GlobalId> expected(all.size());
  GlobalId next = 0;
  std::vector<std::int64_t> expected_counts(kGroups, 0);
  for (std::int32_t g = 0; g < 4; ++g)
    for (std::size_t i = 0; i < all.size(); ++i)
      if (group_of(all[i]) == g) {
        expected[i] = next++;
        ++expected_counts[static_cast<std::size_t>(g)];
      }
  std::vector<GlobalId> mine, answer;
  std::vector<std::int32_t> group;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (static_cast<int>(i * i % static_cast<std::size_t>(comm.size())) != comm.rank()) continue;
    mine.push_back(all[i]);
    group.push_back(group_of(all[i]));
    answer.push_back(expected[i]);
  }
  std::vector<std::int64_t> counts;
  EXPECT_EQ(grouped_numbers(comm, mine, group, kGroups, counts), answer);
  EXPECT_EQ(counts, expected_counts);
}

}  // namespace
}  // namespace sculpt
