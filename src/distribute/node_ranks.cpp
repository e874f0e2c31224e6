#include "distribute/node_ranks.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <limits>

namespace sculpt {
namespace {

struct Record {
  GlobalId node, least;  // least: smallest element of the rank at the node
};

}  // namespace

NodeRanks::NodeRanks(const Comm& comm, const ElementShare& share, const IdIndex& nodes)
    : comm_(comm), ranges_{share.nodes, comm.size()} {
  std::vector<std::vector<Record>> out(static_cast<std::size_t>(comm.size()));
  collectively(comm, "sorting the nodes of the elements", [&] {
    const std::vector<GlobalId>& ids = nodes.ids();
    for (const GlobalId id : ids)
      if (!ranges_.contains(id))
        throw Error(fmt::format("an element uses node {}, but the mesh has {} nodes", id + 1, share.nodes));
    std::vector<GlobalId> least(ids.size(), std::numeric_limits<GlobalId>::max());
    for (std::size_t e = share.element.size(); e-- > 0;)
      for (const GlobalId id : share.corner[e]) least[at(nodes.index(id))] = share.element[e];
    for (std::size_t i = 0; i < ids.size(); ++i) out[ranges_.part_of(ids[i])].push_back({ids[i], least[i]});
  });
  const auto in = comm.all_to_all(out);
  const std::size_t kept = ranges_.size(comm.rank());
  owner_.assign(kept, 0);
  first_.assign(kept + 1, 0);
  std::vector<GlobalId> least(kept, std::numeric_limits<GlobalId>::max());
  for (std::size_t r = 0; r < in.size(); ++r)
    for (const Record& record : in[r]) {
      const std::size_t s = slot(record.node);
      ++first_[s + 1];
      if (record.least >= least[s]) continue;
      least[s] = record.least;
      owner_[s] = static_cast<std::int32_t>(r);
    }
  for (std::size_t s = 0; s < kept; ++s) first_[s + 1] += first_[s];
  ranks_.resize(static_cast<std::size_t>(first_.back()));
  std::vector<std::int64_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t r = 0; r < in.size(); ++r)
    for (const Record& record : in[r])
      ranks_[static_cast<std::size_t>(next[slot(record.node)]++)] = static_cast<std::int32_t>(r);
}

std::vector<std::vector<GlobalId>> NodeRanks::asked(std::span<const GlobalId> nodes) const {
  std::vector<std::vector<GlobalId>> wanted(static_cast<std::size_t>(comm_.size()));
  for (const GlobalId node : nodes) wanted[ranges_.part_of(node)].push_back(node);
  return comm_.all_to_all(wanted);
}

std::vector<NodeHolder> NodeRanks::others(std::span<const GlobalId> nodes) const {
  struct Answer {
    GlobalId node;
    std::int64_t rank;
  };
  const auto questions = asked(nodes);
  std::vector<std::vector<Answer>> answers(questions.size());
  for (std::size_t r = 0; r < questions.size(); ++r)
    for (const GlobalId node : questions[r])
      for (std::int64_t i = first_[slot(node)]; i < first_[slot(node) + 1]; ++i) {
        const std::int32_t rank = ranks_[static_cast<std::size_t>(i)];
        if (rank != static_cast<std::int32_t>(r)) answers[r].push_back({node, rank});
      }
  std::vector<NodeHolder> holders;
  std::size_t item = 0;
  for (const auto& from : comm_.all_to_all(answers))  // ranges ascend, as the nodes do
    for (const Answer& answer : from) {
      while (nodes[item] != answer.node) ++item;
      holders.push_back({static_cast<LocalId>(item), static_cast<std::int32_t>(answer.rank)});
    }
  return holders;
}

std::vector<std::int32_t> NodeRanks::owners(std::span<const GlobalId> nodes) const {
  const auto questions = asked(nodes);
  std::vector<std::vector<std::int32_t>> answers(questions.size());
  for (std::size_t r = 0; r < questions.size(); ++r) {
    answers[r].reserve(questions[r].size());
    for (const GlobalId node : questions[r]) answers[r].push_back(owner_[slot(node)]);
  }
  std::vector<std::int32_t> owner;
  owner.reserve(nodes.size());
  for (const auto& from : comm_.all_to_all(answers)) owner.insert(owner.end(), from.begin(), from.end());
  return owner;
}

}  // namespace sculpt
