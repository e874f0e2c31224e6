// Partitions of Zoltan: every element on one rank, with all that belongs to it, and about as many on each.
#include "sculpt/distribute/repartition.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "sculpt/distribute/unstructured.hpp"
#include "support/shares.hpp"

namespace sculpt::test {
namespace {

constexpr PartitionMethod kMethods[] = {PartitionMethod::kRcb, PartitionMethod::kRib, PartitionMethod::kHsfc,
                                        PartitionMethod::kGraph};

// Everything that the share says of its elements is what the whole mesh says, and every element is there.
void expect_share_of(const Comm& comm, const WholeMesh& whole, const ElementShare& share) {
  ASSERT_TRUE(std::is_sorted(share.element.begin(), share.element.end()));
  ASSERT_EQ(share.corner.size(), share.element.size());
  ASSERT_EQ(share.block.size(), share.element.size());
  ASSERT_EQ(share.value.size(), 2 * share.element.size());
  std::vector<std::int64_t> seen(whole.corner.size(), 0);
  for (std::size_t i = 0; i < share.element.size(); ++i) {
    const auto e = static_cast<std::size_t>(share.element[i]);
    ++seen[e];
    EXPECT_EQ(share.corner[i], whole.corner[e]);
    EXPECT_EQ(share.block[i], whole.block[e]);
    for (std::size_t v = 0; v < 2; ++v) EXPECT_EQ(share.value[2 * i + v], whole.value[2 * e + v]);
  }
  comm.sum(seen);
  EXPECT_EQ(seen, std::vector<std::int64_t>(seen.size(), 1));
}

TEST(Repartition, GivesEveryElementToOneRank) {
  const Comm world = Comm::world();
  for (const WholeMesh& whole :
       {whole_grid(uniform_grid({1, 1, 1}, {0, 0, 0}, {1, 1, 1})),
        permuted(whole_grid(uniform_grid({3, 1, 1}, {0, 0, 0}, {1, 1, 1})), 2), permuted(cylinder(2, 3), 2)})
    for (const PartitionMethod method : kMethods)
      for (const bool pieces : {false, true}) {
        ElementShare share = pieces ? in_pieces(world, whole) : dealt(world, whole, 3);
        const std::vector<GlobalId> nodes = share.node;
        repartition(world, share, method);
        expect_share_of(world, whole, share);
        EXPECT_EQ(share.node, nodes);
      }
}

TEST(Repartition, IsBalanced) {
  const Comm world = Comm::world();
  const WholeMesh whole = permuted(whole_grid(uniform_grid({10, 10, 10}, {0, 0, 0}, {1, 1, 1})), 6);
  for (const PartitionMethod method : kMethods) {
    ElementShare share = in_pieces(world, whole);
    repartition(world, share, method);
    expect_share_of(world, whole, share);
    const auto mine = static_cast<std::int64_t>(share.element.size());
    const double mean = 1000.0 / world.size();
    EXPECT_LE(static_cast<double>(world.max(mine)), 1.2 * mean) << static_cast<int>(method);
    EXPECT_GE(static_cast<double>(world.min(mine)), 0.8 * mean) << static_cast<int>(method);
    // Neighbours stay together: far fewer ghosts than by the order of the file.
    const auto ghosts = [&](const ElementShare& s) {
      return world.sum(
          static_cast<std::int64_t>(unstructured_mesh(world, s, 1).block.size() - s.element.size()));
    };
    if (world.size() > 1)
      EXPECT_LT(ghosts(share), ghosts(in_pieces(world, whole)) / 2) << static_cast<int>(method);
  }
}

// The second time all ranks but one begin with nothing.
TEST(Repartition, SpreadsWhatOneRankHas) {
  const Comm world = Comm::world(), self = Comm::self();
  const WholeMesh whole = permuted(cylinder(4, 6), 6);
  for (const PartitionMethod method : kMethods) {
    ElementShare share = in_pieces(self, whole);
    if (world.rank() != 0) {
      const ElementShare nothing{share.elements, share.nodes, {}, {}, {}, 2, {}, {}, {}};
      share = nothing;
    }
    repartition(world, share, method);
    expect_share_of(world, whole, share);
    EXPECT_GT(world.min(static_cast<std::int64_t>(share.element.size())), 0) << static_cast<int>(method);
  }
}

}  // namespace
}  // namespace sculpt::test
