#include "sculpt/par/comm.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

namespace sculpt {
namespace {

const auto kMore = static_cast<std::int64_t>(1) << 40;

TEST(Reductions, CoverAllRanks) {
  const Comm comm = Comm::world();
  const std::int64_t n = comm.size(), r = comm.rank();
  EXPECT_EQ(comm.sum(kMore + r), n * kMore + n * (n - 1) / 2);
  EXPECT_EQ(comm.min(10 - r), 11 - n);
  EXPECT_EQ(comm.max(kMore * r), kMore * (n - 1));
  EXPECT_EQ(comm.min(0.5 * static_cast<double>(r) - 1), -1);
  EXPECT_EQ(comm.max(-0.5 * static_cast<double>(r)), 0);
  EXPECT_EQ(comm.exclusive_sum(r + 1), r * (r + 1) / 2);
  std::vector<std::int64_t> many{r, 1, -r};
  comm.sum(many);
  EXPECT_EQ(many, (std::vector<std::int64_t>{n * (n - 1) / 2, n, -n * (n - 1) / 2}));
  many = {r, 1};
  comm.exclusive_sum(many);
  EXPECT_EQ(many, (std::vector<std::int64_t>{r * (r - 1) / 2, r}));
}

TEST(Broadcast, ComesFromAnyRoot) {
  const Comm comm = Comm::world();
  for (int root = 0; root < comm.size(); ++root) {
    const std::string mine =
        comm.rank() == root ? std::string(1000, 'a') + std::to_string(root) : "something else";
    EXPECT_EQ(comm.broadcast(mine, root), std::string(1000, 'a') + std::to_string(root));
    EXPECT_EQ(comm.broadcast(comm.rank() == root ? "" : "not this", root), "");
    std::vector<double> items(comm.rank() == root ? 3 : 0, 0.5);
    comm.broadcast(items, root);
    EXPECT_EQ(items, std::vector<double>(3, 0.5));
  }
}

TEST(Concatenate, KeepsTheOrderOfRanks) {
  const Comm comm = Comm::world();
  const std::vector<int> mine(static_cast<std::size_t>(comm.rank() % 3),
                              comm.rank());  // ranks 0, 3, 6 have nothing
  std::vector<int> expected;
  for (int r = 0; r < comm.size(); ++r) expected.insert(expected.end(), static_cast<std::size_t>(r % 3), r);
  EXPECT_EQ(comm.concatenate(mine), expected);
  std::vector<int> ranks(static_cast<std::size_t>(comm.size()));
  std::iota(ranks.begin(), ranks.end(), 0);
  EXPECT_EQ(comm.gather_all(comm.rank()), ranks);
}

TEST(AllToAll, DeliversUnequalPieces) {
  const Comm comm = Comm::world();
  const auto n = static_cast<std::size_t>(comm.size());
  std::vector<std::vector<std::int64_t>> to(n);
  for (std::size_t r = 0; r < n; ++r)  // rank a sends b numbers a*100+b to rank b; rank 0 receives nothing
    to[r].assign(r, comm.rank() * 100 + static_cast<std::int64_t>(r));
  const auto from = comm.all_to_all(to);
  ASSERT_EQ(from.size(), n);
  for (std::size_t r = 0; r < n; ++r)
    EXPECT_EQ(from[r], std::vector<std::int64_t>(static_cast<std::size_t>(comm.rank()),
                                                 static_cast<std::int64_t>(r) * 100 + comm.rank()));
}

// What rank `failing` alone says must reach all.
std::string agreed(const Comm& comm, const std::function<void(int)>& work) {
  try {
    collectively(comm, "working", [&] { work(comm.rank()); });
  } catch (const AgreedError& e) {
    return e.what();
  }
  return {};
}

TEST(Collectively, TellsAllRanksWhatOneRankFound) {
  const Comm comm = Comm::world();
  for (int failing = 0; failing < comm.size(); ++failing) {
    const std::string text = "file.7: line 3, rank " + std::to_string(failing);
    EXPECT_EQ(agreed(comm,
                     [&](int rank) {
                       if (rank == failing) throw Error(text);
                     }),
              text);
  }
  EXPECT_EQ(agreed(comm, [](int) {}), "");
}

TEST(Collectively, TakesTheLowestFailingRank) {
  const Comm comm = Comm::world();
  const int lowest = comm.size() / 2;
  EXPECT_EQ(agreed(comm,
                   [&](int rank) {
                     if (rank >= lowest) throw std::runtime_error("rank " + std::to_string(rank));
                   }),
            "working: rank " + std::to_string(lowest));
}

TEST(Collectively, KnowsExceptionsOfAnyKind) {
  const Comm comm = Comm::world();
  const int last = comm.size() - 1;
  EXPECT_EQ(agreed(comm,
                   [&](int rank) {
                     if (rank == last) throw 3;
                   }),
            "working: unknown failure");
  EXPECT_EQ(agreed(comm,
                   [&](int rank) {
                     if (rank == last) throw std::bad_alloc();
                   }),
            "working: out of memory");
  EXPECT_EQ(agreed(comm, [&](int rank) { check(rank != last, "a promise"); }),
            "working: internal error: a promise");
}

}  // namespace
}  // namespace sculpt
