#include "sculpt/par/numbering.hpp"

#include <algorithm>
#include <iterator>

namespace sculpt {
namespace {

struct Keyed {
  GlobalId key;
  std::int32_t group;
};

// Cuts ascending keys into one piece per rank by equal ranges of the key space.
std::vector<std::vector<Keyed>> by_range(const Comm& comm, std::span<const GlobalId> keys,
                                         std::span<const std::int32_t> group) {
  const GlobalId greatest = comm.max(keys.empty() ? GlobalId{0} : keys.back());
  const GlobalId width = greatest / comm.size() + 1;
  std::vector<std::vector<Keyed>> pieces(static_cast<std::size_t>(comm.size()));
  for (std::size_t i = 0; i < keys.size(); ++i)
    pieces[static_cast<std::size_t>(keys[i] / width)].push_back({keys[i], group.empty() ? 0 : group[i]});
  return pieces;
}

// Sends the numbers back in the order in which the keys came.
std::vector<GlobalId> answer(const Comm& comm, const std::vector<std::vector<GlobalId>>& replies,
                             std::size_t count) {
  std::vector<GlobalId> numbers;
  numbers.reserve(count);
  for (const auto& piece : comm.all_to_all(replies))
    numbers.insert(numbers.end(), piece.begin(), piece.end());
  return numbers;
}

// The first number of each group, from the keys in every group.
std::vector<GlobalId> group_starts(const std::vector<std::int64_t>& counts) {
  std::vector<GlobalId> start(counts.size(), 0);
  for (std::size_t g = 1; g < counts.size(); ++g) start[g] = start[g - 1] + counts[g - 1];
  return start;
}

std::vector<GlobalId> grouped_alone(std::span<const std::int32_t> group, std::size_t groups,
                                    std::vector<std::int64_t>& counts) {
  counts.assign(groups, 0);
  for (const std::int32_t g : group) ++counts[static_cast<std::size_t>(g)];
  std::vector<GlobalId> next = group_starts(counts), numbers(group.size());
  for (std::size_t i = 0; i < group.size(); ++i) numbers[i] = next[static_cast<std::size_t>(group[i])]++;
  return numbers;
}

}  // namespace

std::vector<GlobalId> dense_numbers(const Comm& comm, std::span<const GlobalId> keys, GlobalId& total) {
  std::vector<GlobalId> numbers(keys.size());
  if (comm.size() == 1) {
    for (std::size_t i = 0; i < keys.size(); ++i) numbers[i] = static_cast<GlobalId>(i);
    total = static_cast<GlobalId>(keys.size());
    return numbers;
  }
  const auto asked = comm.all_to_all(by_range(comm, keys, {}));
  std::vector<GlobalId> distinct, joined;
  for (const auto& from : asked) {  // ascending lists, so a union is one walk
    std::vector<GlobalId> theirs;
    theirs.reserve(from.size());
    for (const Keyed& k : from) theirs.push_back(k.key);
    joined.clear();
    joined.reserve(distinct.size() + theirs.size());
    std::set_union(distinct.begin(), distinct.end(), theirs.begin(), theirs.end(),
                   std::back_inserter(joined));
    distinct.swap(joined);
  }
  const auto mine = static_cast<GlobalId>(distinct.size());
  const GlobalId before = comm.exclusive_sum(mine);
  total = comm.sum(mine);
  std::vector<std::vector<GlobalId>> replies(asked.size());
  for (std::size_t r = 0; r < asked.size(); ++r) {
    replies[r].reserve(asked[r].size());
    std::size_t at = 0;
    for (const Keyed& k : asked[r]) {
      while (distinct[at] != k.key) ++at;
      replies[r].push_back(before + static_cast<GlobalId>(at));
    }
  }
  return answer(comm, replies, keys.size());
}

std::vector<GlobalId> grouped_numbers(const Comm& comm, std::span<const GlobalId> keys,
                                      std::span<const std::int32_t> group, std::size_t groups,
                                      std::vector<std::int64_t>& counts) {
  if (comm.size() == 1) return grouped_alone(group, groups, counts);
  const auto asked = comm.all_to_all(by_range(comm, keys, group));
  struct Place {
    Keyed item;
    std::int32_t rank, slot;
  };
  std::vector<Place> places;
  std::vector<std::vector<GlobalId>> replies(asked.size());
  for (std::size_t r = 0; r < asked.size(); ++r) {  // ascending lists again
    replies[r].resize(asked[r].size());
    const auto before = static_cast<std::ptrdiff_t>(places.size());
    for (std::size_t i = 0; i < asked[r].size(); ++i)
      places.push_back({asked[r][i], static_cast<std::int32_t>(r), static_cast<std::int32_t>(i)});
    std::inplace_merge(places.begin(), places.begin() + before, places.end(),
                       [](const Place& a, const Place& b) { return a.item.key < b.item.key; });
  }
  std::vector<std::int64_t> next(groups, 0);
  for (const Place& p : places) ++next[static_cast<std::size_t>(p.item.group)];
  counts = next;
  comm.exclusive_sum(next);
  comm.sum(counts);
  const std::vector<GlobalId> start = group_starts(counts);
  for (std::size_t g = 0; g < groups; ++g) next[g] += start[g];
  for (const Place& p : places)
    replies[static_cast<std::size_t>(p.rank)][static_cast<std::size_t>(p.slot)] =
        next[static_cast<std::size_t>(p.item.group)]++;
  return answer(comm, replies, keys.size());
}

}  // namespace sculpt
