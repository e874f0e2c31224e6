// Entities 0 .. N-1 in a row; rank r owns a run of them and has ghosts of two entities on each side.
#include "sculpt/par/ghost_exchange.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace sculpt {
namespace {

constexpr GlobalId kEach = 3;

struct Row {
  explicit Row(const Comm& world) : comm(world) {
    const GlobalId n = kEach * comm.size(), first = kEach * comm.rank();
    for (GlobalId id = std::max<GlobalId>(0, first - 2); id < std::min(n, first + kEach + 2); ++id) {
      ids.push_back(10 * id);
      owner.push_back(static_cast<std::int32_t>(id / kEach));
    }
    exchange = GhostExchange(comm, ids, owner);
  }
  [[nodiscard]] bool owned(std::size_t i) const { return owner[i] == comm.rank(); }

  Comm comm;
  std::vector<GlobalId> ids;
  std::vector<std::int32_t> owner;
  GhostExchange exchange;
};

TEST(GhostExchange, GhostsTakeTheirOwnersValues) {
  const Row row(Comm::world());
  std::vector<double> values(row.ids.size(), -1);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (row.owned(i)) values[i] = 0.5 * static_cast<double>(row.ids[i]);
  row.exchange.copy_to_ghosts(values);
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(values[i], 0.5 * static_cast<double>(row.ids[i]));
}

TEST(GhostExchange, CarriesStructures) {
  const Row row(Comm::world());
  struct Item {
    GlobalId id;
    std::array<char, 5> text;
  };
  std::vector<Item> values(row.ids.size(), Item{-1, {}});
  for (std::size_t i = 0; i < values.size(); ++i)
    if (row.owned(i))
      values[i] = {row.ids[i], {'a', 'b', 'c', 'd', static_cast<char>('0' + row.comm.rank())}};
  row.exchange.copy_to_ghosts(values);
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_EQ(values[i].id, row.ids[i]);
    EXPECT_EQ(values[i].text[4], '0' + row.owner[i]);
  }
}

TEST(GhostExchange, SendsOnlyWhatChanged) {
  const Row row(Comm::world());
  std::vector<GlobalId> values = row.ids;
  std::vector<std::uint8_t> changed(values.size(), 0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!row.owned(i)) continue;
    values[i] = -row.ids[i];  // all differ, those with an even position are told
    changed[i] = row.ids[i] / 10 % 2 == 0;
  }
  std::vector<GlobalId> arrived;
  row.exchange.copy_changed(
      std::span<GlobalId>(values), std::span<std::uint8_t>(changed),
      [&](LocalId ghost) { arrived.push_back(row.ids[static_cast<std::size_t>(ghost)]); });
  std::vector<GlobalId> expected;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool told = row.ids[i] / 10 % 2 == 0;
    if (!row.owned(i) && told) expected.push_back(row.ids[i]);
    EXPECT_EQ(values[i], row.owned(i) || told ? -row.ids[i] : row.ids[i]);
  }
  std::sort(arrived.begin(), arrived.end());
  EXPECT_EQ(arrived, expected);
  for (const auto& link : row.exchange.sends())
    for (const LocalId item : link.items) EXPECT_EQ(changed[static_cast<std::size_t>(item)], 0);
}

TEST(GhostExchange, OwnersTakeTheLeastOfAllCopies) {
  const Row row(Comm::world());
  std::vector<int> values(row.ids.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = 100 - row.comm.rank();  // the last rank that has a copy wins
  row.exchange.reduce_to_owners(std::span<int>(values), [](int a, int b) { return std::min(a, b); });
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!row.owned(i)) continue;
    const GlobalId id = row.ids[i] / 10;
    const GlobalId last = std::min<GlobalId>(row.comm.size() - 1, (id + 2) / kEach);
    EXPECT_EQ(values[i], 100 - last) << "entity " << id;
  }
}

TEST(GhostExchange, RecordsOfUnequalLength) {
  using G = GhostExchange;
  const Row row(Comm::world());
  std::vector<std::string> got(row.ids.size());
  row.exchange.send_records(
      [&](LocalId item,
          std::vector<char>& bytes) {  // entity n is worth n % 4 letters; none: no record at all
        const auto letters = static_cast<std::int32_t>(row.ids[static_cast<std::size_t>(item)] / 10 % 4);
        if (letters == 0) return;
        G::append(bytes, letters);
        for (std::int32_t l = 0; l < letters; ++l) G::append(bytes, static_cast<char>('a' + l));
      },
      [&](LocalId ghost, const char* at) {
        std::int32_t letters;
        G::take(at, letters);
        got[static_cast<std::size_t>(ghost)].assign(at, at + letters);
        return at + letters;
      });
  for (std::size_t i = 0; i < got.size(); ++i)
    EXPECT_EQ(got[i], row.owned(i)
                          ? ""
                          : std::string("abcd").substr(0, static_cast<std::size_t>(row.ids[i] / 10 % 4)));
}

// The row closed to a ring: the ghosts beyond its ends are images, ids of images lie 10 n off.
struct Ring {
  Ring(const Comm& world, GlobalId reach) : comm(world) {
    const GlobalId n = kEach * comm.size(), first = kEach * comm.rank();
    for (GlobalId id = first - reach; id < first + kEach + reach; ++id) {
      const GlobalId home = (id + 100 * n) % n;
      ids.push_back(10 * id);
      homes.push_back(10 * home);
      owner.push_back(static_cast<std::int32_t>(home / kEach) + (home == id ? 0 : comm.size()));
    }
    exchange = GhostExchange(comm, ids, owner, homes);
  }
  Comm comm;
  std::vector<GlobalId> ids, homes;
  std::vector<std::int32_t> owner;
  GhostExchange exchange;
};

TEST(GhostExchange, ImagesTakeTheValuesOfTheirHomes) {
  for (const GlobalId reach : {1, 2, 7}) {  // with few ranks the last one goes around more than once
    const Ring ring(Comm::world(), reach);
    std::vector<GlobalId> values(ring.ids.size(), -1);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (ring.owner[i] == ring.comm.rank()) values[i] = 7 * ring.ids[i];
    ring.exchange.copy_to_ghosts(values);
    for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(values[i], 7 * ring.homes[i]);
  }
}

TEST(GhostExchange, OwnersHearOfAllTheirImages) {
  const Ring ring(Comm::world(), kEach);
  std::vector<GlobalId> values = ring.ids;
  ring.exchange.reduce_to_owners(std::span<GlobalId>(values),
                                 [](GlobalId a, GlobalId b) { return std::max(a, b); });
  const GlobalId n = kEach * ring.comm.size();
  for (std::size_t i = 0; i < values.size(); ++i)
    if (ring.owner[i] == ring.comm.rank()) {
      const bool beyond = ring.homes[i] < 10 * kEach;  // the last rank sees the first ones beyond the end
      EXPECT_EQ(values[i], ring.homes[i] + (beyond ? 10 * n : 0));
    }
  std::vector<std::uint8_t> changed(values.size(), 1);
  std::vector<GlobalId> told = ring.ids;
  int arrived = 0;
  ring.exchange.copy_changed(std::span<GlobalId>(told), std::span<std::uint8_t>(changed),
                             [&](LocalId) { ++arrived; });
  EXPECT_EQ(told, ring.homes);
  EXPECT_EQ(arrived, 2 * kEach);
}

TEST(GhostExchange, RanksMayHaveNothing) {
  const Comm comm = Comm::world();
  std::vector<GlobalId> ids;
  std::vector<std::int32_t> owner;
  if (comm.rank() == 0) {  // rank 0 owns all, only the last rank has ghosts
    ids = {4, 5, 6};
    owner = {0, 0, 0};
  } else if (comm.rank() == comm.size() - 1) {
    ids = {5};
    owner = {0};
  }
  const GhostExchange exchange(comm, ids, owner);
  std::vector<int> values(ids.size(), 1 + comm.rank());
  exchange.copy_to_ghosts(values);
  for (const int v : values) EXPECT_EQ(v, 1);
  EXPECT_EQ(exchange.receives().size(), comm.rank() > 0 && comm.rank() == comm.size() - 1 ? 1U : 0U);
}

TEST(GhostExchange, AGhostUnknownToItsOwnerIsToldToAllRanks) {
  const Comm comm = Comm::world();
  if (comm.size() == 1) return;
  std::vector<GlobalId> ids{static_cast<GlobalId>(comm.rank())};
  std::vector<std::int32_t> owner{comm.rank()};
  if (comm.rank() == comm.size() - 1) {
    ids = {comm.rank(), 1000};
    owner = {comm.rank(), 0};
  }
  try {
    const GhostExchange exchange(comm, ids, owner);
    ADD_FAILURE() << "nothing was thrown";
  } catch (const AgreedError& e) {
    EXPECT_NE(std::string(e.what()).find("a ghost is unknown to its owner"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace sculpt
