#include "sculpt/mesh/node_directory.hpp"

#include <fmt/core.h>

#include <limits>

#include "sculpt/par/id_ranges.hpp"

namespace sculpt {
namespace {

constexpr GlobalId kNobody = std::numeric_limits<GlobalId>::max();

struct Placed {
  GlobalId node;
  Vec3 position;
};

// What this rank keeps: the positions of its range of nodes.
struct Kept {
  std::vector<Vec3> position;
  std::vector<std::uint8_t> known;
};

Kept collect(const Comm& comm, const ElementShare& share, const IdRanges& ranges) {
  std::vector<std::vector<Placed>> out(static_cast<std::size_t>(comm.size()));
  for (std::size_t i = 0; i < share.node.size(); ++i)
    if (ranges.contains(share.node[i]))
      out[ranges.rank(share.node[i])].push_back({share.node[i], share.position[i]});
  Kept kept;
  kept.position.resize(ranges.size(comm.rank()));
  kept.known.resize(kept.position.size(), 0);
  for (const auto& from : comm.all_to_all(out))
    for (const Placed& p : from) {
      const auto slot = static_cast<std::size_t>(p.node - ranges.first(comm.rank()));
      kept.position[slot] = p.position;
      kept.known[slot] = 1;
    }
  return kept;
}

}  // namespace

std::vector<Vec3> positions_of(const Comm& comm, const ElementShare& share, std::span<const GlobalId> nodes) {
  const IdRanges ranges(share.nodes, comm.size());
  const Kept kept = collect(comm, share, ranges);
  GlobalId missing = kNobody;
  std::vector<std::vector<GlobalId>> wanted(static_cast<std::size_t>(comm.size()));
  for (const GlobalId node : nodes)
    if (ranges.contains(node))
      wanted[ranges.rank(node)].push_back(node);
    else
      missing = std::min(missing, node);
  const auto asked = comm.all_to_all(wanted);
  std::vector<std::vector<Vec3>> answers(asked.size());
  for (std::size_t r = 0; r < asked.size(); ++r) {
    answers[r].reserve(asked[r].size());
    for (const GlobalId node : asked[r]) {
      const auto slot = static_cast<std::size_t>(node - ranges.first(comm.rank()));
      answers[r].push_back(kept.position[slot]);
      if (kept.known[slot] == 0) missing = std::min(missing, node);
    }
  }
  missing = comm.min(missing);
  if (missing != kNobody)
    throw AgreedError(fmt::format("node {} is used but has no coordinates", missing + 1));
  const auto told = comm.all_to_all(answers);
  std::vector<std::size_t> next(told.size(), 0);
  std::vector<Vec3> positions;
  positions.reserve(nodes.size());
  for (const GlobalId node : nodes) {
    const std::size_t r = ranges.rank(node);
    positions.push_back(told[r][next[r]++]);
  }
  return positions;
}

}  // namespace sculpt
