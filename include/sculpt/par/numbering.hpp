#pragma once
// Contiguous global numbers from keys that do not depend on the number of ranks.
#include <cstdint>
#include <span>
#include <vector>

#include "sculpt/base/types.hpp"
#include "sculpt/par/comm.hpp"

namespace sculpt {

// Collective. keys: ascending, without repetition on a rank, any number of ranks may hold the same key.
// Answers with the position of each key, from 0, among the distinct keys of all ranks; total = how many there
// are.
[[nodiscard]] std::vector<GlobalId> dense_numbers(const Comm& comm, std::span<const GlobalId> keys,
                                                  GlobalId& total);

// Collective. As dense_numbers, but numbered group by group (0 .. groups-1): first all keys of group 0 in
// order, then those of group 1 and so on. Every key is held by one rank. counts: keys of each group on all
// ranks.
[[nodiscard]] std::vector<GlobalId> grouped_numbers(const Comm& comm, std::span<const GlobalId> keys,
                                                    std::span<const std::int32_t> group, std::size_t groups,
                                                    std::vector<std::int64_t>& counts);

}  // namespace sculpt
