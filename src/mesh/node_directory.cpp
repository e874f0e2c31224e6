#include "sculpt/mesh/node_directory.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>

#include "sculpt/base/even_parts.hpp"
#include "sculpt/par/finding.hpp"

namespace sculpt {
namespace {

std::string text(const Vec3& p) { return fmt::format("({}, {}, {})", p.x, p.y, p.z); }

// What a rank knows of the nodes of its part of all numbers.
class Directory {
 public:
  Directory(const Comm& comm, const ElementShare& share) : parts_{share.nodes, comm.size()} {
    std::vector<std::vector<Placed>> to(static_cast<std::size_t>(comm.size()));
    collectively(comm, "sending nodes to the ranks that list them", [&] {
      check(share.node.size() == share.position.size(), "element share: a position per node");
      for (std::size_t n = 0; n < share.node.size(); ++n)
        to[holder(share.node[n])].push_back({share.node[n], share.position[n]});
      first_ = parts_.begin(comm.rank());
      const auto count = static_cast<std::size_t>(parts_.end(comm.rank()) - first_);
      position_.resize(count);
      rank_.assign(count, kNobody);
    });
    const auto arrived = comm.all_to_all(to);
    Finding twice;
    for (std::size_t r = 0; r < arrived.size(); ++r)
      for (const Placed& placed : arrived[r]) enter(placed, static_cast<int>(r), twice);
    refuse_first(comm, twice);
  }

  [[nodiscard]] std::size_t holder(GlobalId node) const {
    check(node >= 0 && node < parts_.items, "element share: the number of a node is out of range");
    return parts_.part_of(node);
  }

  // Of nodes in this rank's part.
  [[nodiscard]] std::vector<Vec3> look_up(const std::vector<GlobalId>& nodes, Finding& missing) const {
    std::vector<Vec3> positions(nodes.size());
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const auto at = static_cast<std::size_t>(nodes[n] - first_);
      positions[n] = position_[at];
      if (rank_[at] == kNobody && nodes[n] < missing.at)
        missing = {nodes[n],
                   fmt::format("node {} has no position: it is used, but no rank holds it", nodes[n] + 1)};
    }
    return positions;
  }

 private:
  static constexpr std::int32_t kNobody = -1;
  struct Placed {
    GlobalId node;
    Vec3 position;
  };

  void enter(const Placed& placed, int rank, Finding& twice) {
    const auto at = static_cast<std::size_t>(placed.node - first_);
    if (rank_[at] == kNobody) {
      rank_[at] = rank;
      position_[at] = placed.position;
    } else if (position_[at] != placed.position && placed.node < twice.at) {
      twice = {placed.node,
               fmt::format("node {} is at {} on rank {} and at {} on rank {}, expected one place",
                           placed.node + 1, text(position_[at]), rank_[at], text(placed.position), rank)};
    }
  }

  EvenParts parts_;
  GlobalId first_ = 0;
  std::vector<Vec3> position_;
  std::vector<std::int32_t> rank_;  // the lowest that holds it
};

}  // namespace

std::vector<Vec3> positions_of(const Comm& comm, const ElementShare& share, std::span<const GlobalId> nodes) {
  const Directory directory(comm, share);
  std::vector<std::vector<GlobalId>> questions(static_cast<std::size_t>(comm.size()));
  collectively(comm, "asking for the positions of nodes", [&] {
    for (const GlobalId n : nodes) questions[directory.holder(n)].push_back(n);
  });
  const auto asked = comm.all_to_all(questions);
  std::vector<std::vector<Vec3>> answers(asked.size());
  Finding missing;
  for (std::size_t r = 0; r < asked.size(); ++r) answers[r] = directory.look_up(asked[r], missing);
  refuse_first(comm, missing);
  const auto answered = comm.all_to_all(answers);
  std::vector<std::size_t> next(answered.size(), 0);
  std::vector<Vec3> positions;
  positions.reserve(nodes.size());
  for (const GlobalId n : nodes) {
    const std::size_t r = directory.holder(n);
    positions.push_back(answered[r][next[r]++]);
  }
  return positions;
}

}  // namespace sculpt
