#include "sculpt/distribute/block_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "support/cases.hpp"

namespace sculpt {
namespace {

using Weights = std::vector<std::int64_t>;

std::size_t count(const Index3& n) { return static_cast<std::size_t>(whole(n).size()); }

// Every block lies in exactly one box, that of its owner.
void expect_tiles(const BlockParts& parts, const Index3& blocks, int ranks) {
  EXPECT_EQ(parts.blocks, blocks);
  ASSERT_EQ(parts.box.size(), static_cast<std::size_t>(ranks));
  ASSERT_EQ(parts.owner.size(), count(blocks));
  for (std::int64_t b = 0; b < whole(blocks).size(); ++b) {
    const Index3 block = whole(blocks).cell(b);
    for (int r = 0; r < ranks; ++r)
      EXPECT_EQ(parts.box[static_cast<std::size_t>(r)].contains(block), parts.owner_of(block) == r)
          << "block " << b << ", rank " << r;
  }
}

Weights weights_of_parts(const BlockParts& parts, const Weights& weight) {
  Weights sum(parts.box.size(), 0);
  for (std::size_t b = 0; b < weight.size(); ++b) sum[static_cast<std::size_t>(parts.owner[b])] += weight[b];
  return sum;
}

const Index3 kBlocks[] = {{8, 8, 8}, {5, 3, 4}, {1, 1, 7}, {13, 1, 2}, {1, 1, 1}};

TEST(BlockParts, AreTheBoxesOfTheCut) {
  for (const Index3& n : kBlocks)
    for (const int ranks : {1, 2, 3, 7, 16}) {
      const CartesianParts cut = cut_grid(n, ranks, {0, 0, 0});
      const BlockParts parts = block_parts(cut, ranks);
      expect_tiles(parts, n, ranks);
      for (int r = 0; r < ranks; ++r) EXPECT_EQ(parts.box[static_cast<std::size_t>(r)], cut.owned(r));
    }
}

TEST(BalancedParts, TileTheBlocks) {
  for (const Index3& n : kBlocks)
    for (const int ranks : {1, 2, 3, 7, 16}) {
      Weights weight;
      for (std::size_t b = 0; b < count(n); ++b)
        weight.push_back(8 + static_cast<std::int64_t>(test::scatter(3, b) % 500));
      expect_tiles(balanced_parts(n, weight, ranks), n, ranks);
    }
}

// Each of log2(ranks) cuts misses its share by half a layer at most.
TEST(BalancedParts, AreNearlyEqual) {
  const Index3 n{24, 20, 22};
  Weights weight(count(n), 8);  // one corner is refined far more than the rest
  for (std::int64_t b = 0; b < whole(n).size(); ++b) {
    const Index3 at = whole(n).cell(b);
    if (at[0] < 8 && at[1] < 8 && at[2] < 8) weight[static_cast<std::size_t>(b)] = 512;
  }
  const std::int64_t total = std::accumulate(weight.begin(), weight.end(), std::int64_t{0});
  for (const int ranks : {2, 3, 4, 7, 8}) {
    const Weights by_weight = weights_of_parts(balanced_parts(n, weight, ranks), weight),
                  by_size = weights_of_parts(block_parts(cut_grid(n, ranks, {0, 0, 0}), ranks), weight);
    const auto worst = [&](const Weights& w) {
      return static_cast<double>(*std::max_element(w.begin(), w.end())) * ranks / static_cast<double>(total);
    };
    EXPECT_LT(worst(by_weight), 1.35) << ranks;
    EXPECT_GT(worst(by_size), 1.5) << ranks << ": the case is not hard enough";
    EXPECT_GT(*std::min_element(by_weight.begin(), by_weight.end()), 0) << ranks;
  }
}

TEST(BalancedParts, OfEqualWeightsAreEqual) {
  const Weights weight(count({8, 8, 8}), 5);
  for (const int ranks : {2, 4, 8, 16})
    for (const std::int64_t w : weights_of_parts(balanced_parts({8, 8, 8}, weight, ranks), weight))
      EXPECT_EQ(w, 5 * 512 / ranks);
}

TEST(BalancedParts, MoreRanksThanBlocks) {
  const BlockParts parts = balanced_parts({2, 1, 1}, Weights{8, 64}, 5);
  expect_tiles(parts, {2, 1, 1}, 5);
  EXPECT_EQ(std::count_if(parts.box.begin(), parts.box.end(), [](const IndexBox& b) { return !b.empty(); }),
            2);
}

TEST(BalancedParts, WeightsMayBeZero) {
  expect_tiles(balanced_parts({4, 3, 2}, Weights(24, 0), 3), {4, 3, 2}, 3);
  Weights one(24, 0);
  one[23] = 100;
  expect_tiles(balanced_parts({4, 3, 2}, one, 4), {4, 3, 2}, 4);
}

}  // namespace
}  // namespace sculpt
