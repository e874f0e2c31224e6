// One rank; what several ranks do together is in tests/parallel/par.
#include "sculpt/par/comm.hpp"

#include <gtest/gtest.h>

#include <array>

#include "sculpt/par/ghost_exchange.hpp"
#include "sculpt/par/numbering.hpp"

namespace sculpt {
namespace {

TEST(CommOfOne, ReturnsWhatItIsGiven) {
  const Comm comm = Comm::self();
  EXPECT_EQ(comm.size(), 1);
  EXPECT_EQ(comm.sum(std::int64_t{5}), 5);
  EXPECT_EQ(comm.min(-2.5), -2.5);
  EXPECT_EQ(comm.exclusive_sum(std::int64_t{7}), 0);
  EXPECT_EQ(comm.broadcast("text", 0), "text");
  EXPECT_EQ(comm.concatenate(std::vector<int>{3, 1}), (std::vector<int>{3, 1}));
  EXPECT_EQ(comm.all_to_all(std::vector<std::vector<int>>{{4, 5}}), (std::vector<std::vector<int>>{{4, 5}}));
}

std::string text_of_current(const std::function<void()>& action) {
  try {
    action();
  } catch (...) {
    return current_exception_text();
  }
  return {};
}

TEST(CurrentExceptionText, IsNeverEmpty) {
  EXPECT_EQ(text_of_current([] { throw Error("deck line 3"); }), "deck line 3");
  EXPECT_EQ(text_of_current([] { throw Error(""); }), "unknown failure");
  EXPECT_EQ(text_of_current([] { throw 7; }), "unknown failure");
  EXPECT_EQ(text_of_current([] { throw std::bad_alloc(); }), "out of memory");
}

TEST(CollectivelyAlone, PassesTheUsersErrorsOnAsTheyAre) {
  const Comm comm = Comm::self();
  EXPECT_EQ(text_of_current([&] { collectively(comm, "reading", [] { throw Error("file x: bad"); }); }),
            "file x: bad");
  EXPECT_EQ(text_of_current([&] { collectively(comm, "reading", [] { throw std::runtime_error("odd"); }); }),
            "reading: odd");
  EXPECT_THROW(collectively(comm, "reading", [] { check(false, "promise"); }), AgreedError);
  bool done = false;
  collectively(comm, "reading", [&] { done = true; });
  EXPECT_TRUE(done);
}

TEST(GhostExchangeAlone, HasNobodyToTalkTo) {
  const std::array<GlobalId, 3> ids{2, 5, 9};
  const std::array<std::int32_t, 3> owner{0, 0, 0};
  const GhostExchange exchange(Comm::self(), ids, owner);
  EXPECT_TRUE(exchange.sends().empty());
  EXPECT_TRUE(exchange.receives().empty());
  std::vector<int> values{1, 2, 3};
  exchange.copy_to_ghosts(values);
  EXPECT_EQ(values, (std::vector<int>{1, 2, 3}));
}

TEST(NumbersAlone, FollowTheOrderOfTheKeys) {
  const std::array<GlobalId, 4> keys{3, 8, 20, 500};
  GlobalId total = 0;
  EXPECT_EQ(dense_numbers(Comm::self(), keys, total), (std::vector<GlobalId>{0, 1, 2, 3}));
  EXPECT_EQ(total, 4);
  const std::array<std::int32_t, 4> group{1, 0, 1, 0};
  std::vector<std::int64_t> counts;
  EXPECT_EQ(grouped_numbers(Comm::self(), keys, group, 3, counts), (std::vector<GlobalId>{2, 0, 3, 1}));
  EXPECT_EQ(counts, (std::vector<std::int64_t>{2, 2, 0}));
}

}  // namespace
}  // namespace sculpt
