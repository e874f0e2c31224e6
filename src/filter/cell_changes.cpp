#include <algorithm>
#include <limits>
#include <tuple>

#include "filter/edits.hpp"

namespace sculpt {
namespace {

constexpr double kNoClaim = std::numeric_limits<double>::infinity();

}  // namespace

// The cells within reach of a cell, itself included, ascending.
const std::vector<LocalId>& CellChanges::around(LocalId cell) {
  around_.assign(1, cell);
  for (int i = 0; i < reach_; ++i) {
    const std::size_t before = around_.size();
    for (std::size_t c = 0; c < before; ++c)
      for (const LocalId n : edits_.mesh.hexes[at(around_[c])])
        for (const std::int32_t item : edits_.around[n]) around_.push_back(item / 8);
    std::sort(around_.begin(), around_.end());
    around_.erase(std::unique(around_.begin(), around_.end()), around_.end());
  }
  return around_;
}

// Adds the owned cells around changes that were not looked at yet.
void CellChanges::collect() {
  if (first_) {
    for (LocalId c = 0; c < edits_.mesh.size(); ++c)
      if (edits_.owned(c)) examine_.push_back(c);
    claim_.assign(edits_.mesh.hexes.size(), kNoClaim);
    flag_.assign(edits_.mesh.hexes.size(), 0);
    seen_ = edits_.changed().size();
    first_ = false;
    return;
  }
  for (; seen_ < edits_.changed().size(); ++seen_)
    for (const LocalId c : around(edits_.changed()[seen_]))
      if (edits_.owned(c)) examine_.push_back(c);
  std::sort(examine_.begin(), examine_.end());
  examine_.erase(std::unique(examine_.begin(), examine_.end()), examine_.end());
}

// Whether no candidate around the cell is cheaper.
bool CellChanges::wins(LocalId cell) {
  const auto key = [this](LocalId c) {
    return std::tuple(claim_[at(c)], edits_.lot(c), edits_.mesh.hex_homes()[at(c)]);
  };
  for (const LocalId other : around(cell))
    if (other != cell && claim_[at(other)] <= claim_[at(cell)] && key(other) < key(cell)) return false;
  return true;
}

std::int64_t CellChanges::pass() {
  std::vector<std::pair<LocalId, std::int32_t>> candidates;
  for (const LocalId c : examine_)
    if (const std::int32_t to = better(c); to != kNone) {
      candidates.emplace_back(c, to);
      claim_[at(c)] = edits_.loss(c, to);
      flag_[at(c)] = 1;
    }
  claimed_ghosts_.clear();
  edits_.mesh.hex_exchange.copy_changed(std::span<double>(claim_), std::span<std::uint8_t>(flag_),
                                        [this](LocalId ghost) { claimed_ghosts_.push_back(ghost); });
  std::vector<std::pair<LocalId, std::int32_t>> winners;
  examine_.clear();
  for (const auto& candidate : candidates) {
    if (wins(candidate.first))
      winners.push_back(candidate);
    else
      examine_.push_back(candidate.first);
  }
  for (const auto& [c, to] : candidates) {
    claim_[at(c)] = kNoClaim;
    flag_[at(c)] = 0;
  }
  for (const LocalId c : claimed_ghosts_) claim_[at(c)] = kNoClaim;
  for (const auto& [c, to] : winners) edits_.change_owned(c, to);
  edits_.share();
  return edits_.comm().sum(static_cast<std::int64_t>(winners.size()));
}

std::int64_t CellChanges::run() {
  std::int64_t changes = 0;
  for (;;) {
    collect();
    const std::int64_t now = pass();
    changes += now;
    if (now == 0) return changes;
  }
}

}  // namespace sculpt
