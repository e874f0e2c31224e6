#include "sculpt/par/components.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

namespace sculpt {
namespace {

// The smallest id of the local members of each component.
std::vector<GlobalId> least_ids(const Components& components, std::span<const GlobalId> ids) {
  std::vector<GlobalId> least;
  least.reserve(components.first.size());
  for (const LocalId first : components.first) least.push_back(ids[at(first)]);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    GlobalId& of = least[at(components.of[i])];
    of = std::min(of, ids[i]);
  }
  return least;
}

// Lowers the label of every component to the least label of its members; whether any was lowered.
bool take_least(const std::vector<GhostExchange::Link>& links, const std::vector<GlobalId>& value,
                Components& components) {
  bool lowered = false;
  for (const GhostExchange::Link& link : links)
    for (const LocalId item : link.items) {
      GlobalId& label = components.label[at(components.of[at(item)])];
      if (value[at(item)] >= label) continue;
      label = value[at(item)];
      lowered = true;
    }
  return lowered;
}

// Shared entities get the labels of their components.
void spread(const std::vector<GhostExchange::Link>& links, const Components& components,
            std::vector<GlobalId>& value) {
  for (const GhostExchange::Link& link : links)
    for (const LocalId item : link.items) value[at(item)] = components.label[at(components.of[at(item)])];
}

}  // namespace

DisjointSets::DisjointSets(std::size_t count) : parent_(count) {
  std::iota(parent_.begin(), parent_.end(), 0);
}

std::vector<std::int32_t> DisjointSets::numbered(std::vector<LocalId>& roots) && {
  // Parents come before their children, so that one pass finds all roots numbered already.
  for (std::size_t i = 0; i < parent_.size(); ++i) {
    if (parent_[i] == static_cast<LocalId>(i)) {
      parent_[i] = static_cast<std::int32_t>(roots.size());
      roots.push_back(static_cast<LocalId>(i));
    } else {
      parent_[i] = parent_[at(parent_[i])];
    }
  }
  return std::move(parent_);
}

Components connected_components(const Comm& comm, DisjointSets sets, std::span<const GlobalId> ids,
                                const GhostExchange& exchange) {
  Components out;
  out.of = std::move(sets).numbered(out.first);
  out.label = least_ids(out, ids);
  if (comm.size() == 1 && exchange.sends().empty()) return out;
  std::vector<GlobalId> value(ids.size(), 0);  // used at shared entities only
  for (bool changed = true; changed;) {
    spread(exchange.sends(), out, value);
    spread(exchange.receives(), out, value);
    exchange.reduce_to_owners(std::span<GlobalId>(value),
                              [](GlobalId a, GlobalId b) { return std::min(a, b); });
    bool lowered = take_least(exchange.sends(), value, out);
    spread(exchange.sends(), out, value);
    exchange.copy_to_ghosts(value);
    lowered = take_least(exchange.receives(), value, out) || lowered;
    changed = comm.max(std::int64_t{lowered}) != 0;
  }
  return out;
}

std::int64_t number_components(const Comm& comm, Components& components, std::span<const GlobalId> ids,
                               std::span<const std::int32_t> group) {
  struct Named {
    GlobalId group, label;
    bool operator<(const Named& o) const { return std::tie(group, label) < std::tie(o.group, o.label); }
    bool operator==(const Named&) const = default;
  };
  const auto named = [&](std::size_t c) { return Named{group.empty() ? 0 : group[c], components.label[c]}; };
  std::vector<Named> all;
  const std::vector<GlobalId> least = least_ids(components, ids);
  for (std::size_t c = 0; c < components.label.size(); ++c)
    if (least[c] == components.label[c]) all.push_back(named(c));  // others have it elsewhere
  if (comm.size() > 1) all = comm.concatenate(all);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  check(all.size() <= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()),
        "more than 2^31 components");
  std::vector<std::int32_t> number(components.label.size());
  for (std::size_t c = 0; c < number.size(); ++c)
    number[c] = static_cast<std::int32_t>(std::lower_bound(all.begin(), all.end(), named(c)) - all.begin());
  for (std::int32_t& c : components.of) c = number[at(c)];
  return static_cast<std::int64_t>(all.size());
}

}  // namespace sculpt
