#pragma once
// Mistakes that lie somewhere in a list which is spread over the ranks. However it is spread, the message is
// that of the first mistake in the list.
#include <cstdint>
#include <limits>
#include <string>

#include "sculpt/par/comm.hpp"

namespace sculpt {

struct Finding {
  static constexpr std::int64_t kNowhere = std::numeric_limits<std::int64_t>::max();
  std::int64_t at = kNowhere;  // place in the list, the same for any spread
  std::string text;            // of the message
};

// Collective. Throws, as AgreedError, the finding with the smallest place; of several at one place that of
// the lowest rank. Nothing happens when no rank has found anything.
inline void refuse_first(const Comm& comm, const Finding& mine) {
  const std::int64_t first = comm.min(mine.at);
  if (first == Finding::kNowhere) return;
  collectively(comm, "agreeing on a mistake", [&] {
    if (mine.at == first) throw Error(mine.text);
  });
}

}  // namespace sculpt
