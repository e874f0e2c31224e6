#include <algorithm>
#include <limits>
#include <unordered_map>

#include "filter/ring.hpp"
#include "sculpt/filter/filter.hpp"
#include "sculpt/vfrac/fractions.hpp"

namespace sculpt {
namespace {

constexpr double kNoClaim = std::numeric_limits<double>::infinity();
constexpr int kPasses = 60;        // of the cost-driven repair, then the last resort
constexpr double kFrozen = 1000;   // cost that keeps a cell from changing again
constexpr int kFreezeAfter = 4;    // changes of one cell
constexpr double kContact = 0.05;  // cost per face neighbour of the old (+) and of the new (-) material
constexpr double kBias = 0.1;      // grows as 2^changes - 1 (section 2.7.1 of the report: changes must stick)

struct Flip {
  int slot;  // in the ring
  std::int32_t to;
};

struct Proposal {
  double cost = kNoClaim;
  int count = 0;
  std::array<Flip, Ring::kMost> flips;
};

class Repair {
 public:
  Repair(HexMesh& mesh, const Fractions& fractions, const FaceNeighbours& neighbours, const NodeHexes& around)
      : mesh_(mesh),
        fractions_(fractions),
        neighbours_(neighbours),
        around_(around),
        changes_(mesh.hexes.size(), 0),
        bad_(mesh.position.size(), 0),
        stale_(mesh.position.size(), 1),
        claim_(mesh.position.size(), kNoClaim) {}

  ManifoldReport run() {
    const Comm& comm = mesh_.node_exchange.comm();
    ManifoldReport report;
    find_bad_nodes();
    report.bad_nodes = comm.sum(static_cast<std::int64_t>(active_.size()));
    for (std::int64_t left = report.bad_nodes; left > 0;
         left = comm.sum(static_cast<std::int64_t>(active_.size()))) {
      last_resort_ = report.passes++ >= kPasses;
      if (last_resort_) report.forced_nodes = std::max(report.forced_nodes, left);
      collectively(comm, "resolving non-manifold nodes", [&] { propose(); });
      share_claims();
      report.changed_cells += comm.sum(apply_winners());
    }
    return report;
  }

 private:
  bool is_bad(LocalId node) const {
    const auto items = around_[node];
    const std::int32_t first = mesh_.material[at(items[0] / 8)];
    bool mixed = false;
    for (const std::int32_t item : items) mixed = mixed || mesh_.material[at(item / 8)] != first;
    return mixed && !ring_of(mesh_, neighbours_, around_, node).manifold(materials(items));
  }
  std::span<const std::int32_t> materials(std::span<const std::int32_t> items) const {
    for (std::size_t i = 0; i < items.size(); ++i) scratch_[i] = mesh_.material[at(items[i] / 8)];
    return {scratch_.data(), items.size()};
  }

  void find_bad_nodes() {
    // Nodes of owned and first-layer cells have complete rings; proposals look at all of them.
    std::vector<std::uint8_t> complete(mesh_.position.size(), 0);
    for (std::size_t c = 0; c < mesh_.hexes.size(); ++c)
      if (mesh_.layer[c] <= 1)
        for (const LocalId n : mesh_.hexes[c]) complete[at(n)] = 1;
    for (LocalId n = 0; n < mesh_.nodes(); ++n) {
      if (!complete[at(n)]) continue;
      bad_[at(n)] = is_bad(n);
      if (bad_[at(n)] && owned(n)) active_.push_back(n);
    }
    complete_ = std::move(complete);
  }
  bool owned(LocalId n) const { return mesh_.node_owner[at(n)] == mesh_.node_exchange.comm().rank(); }

  double cost_of(LocalId cell, std::int32_t to) const {
    const std::int32_t from = mesh_.material[at(cell)];
    int with_old = 0, with_new = 0;
    for (const LocalId n : neighbours_[at(cell)]) {
      if (n == kNone) continue;
      with_old += mesh_.material[at(n)] == from;
      with_new += mesh_.material[at(n)] == to;
    }
    const int changes = changes_[at(cell)];
    return fraction_of(fractions_, cell, from) - fraction_of(fractions_, cell, to) +
           kContact * (with_old - with_new) + kBias * ((1 << std::min(changes, 6)) - 1) +
           (changes >= kFreezeAfter ? kFrozen : 0.0);
  }

  // Change in the number of non-manifold nodes around the flipped cells if the flips were made.
  int look_ahead(const Ring& ring, std::span<const Flip> flips) {
    touched_.clear();
    for (const Flip& f : flips)
      for (const LocalId n : mesh_.hexes[at(ring.cell[static_cast<std::size_t>(f.slot)])])
        if (complete_[at(n)]) touched_.push_back(n);
    std::sort(touched_.begin(), touched_.end());
    touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
    std::array<std::int32_t, Ring::kMost> before;
    for (std::size_t f = 0; f < flips.size(); ++f) {
      std::int32_t& m = mesh_.material[at(ring.cell[static_cast<std::size_t>(flips[f].slot)])];
      before[f] = m;
      m = flips[f].to;
    }
    int more = 0;
    for (const LocalId n : touched_) more += static_cast<int>(is_bad(n)) - static_cast<int>(bad_[at(n)]);
    for (std::size_t f = 0; f < flips.size(); ++f)
      mesh_.material[at(ring.cell[static_cast<std::size_t>(flips[f].slot)])] = before[f];
    return more;
  }

  struct Single {
    Flip flip;
    double cost;
  };

  // Tries one set of flips against the best proposal so far.
  void consider(const Ring& ring, std::span<const std::int32_t> material, std::span<const Single> chosen,
                Proposal& best) {
    double cost = 0;
    std::array<std::int32_t, Ring::kMost> changed;
    std::copy(material.begin(), material.end(), changed.begin());
    std::array<Flip, 3> flips;
    for (std::size_t f = 0; f < chosen.size(); ++f) {
      cost += chosen[f].cost;
      flips[f] = chosen[f].flip;
      changed[static_cast<std::size_t>(flips[f].slot)] = flips[f].to;
    }
    const double reach =
        static_cast<double>(8 * chosen.size());  // no look-ahead can gain more than its nodes
    if (cost - reach >= best.cost) return;
    if (!ring.manifold({changed.data(), material.size()})) return;
    cost += look_ahead(ring, {flips.data(), chosen.size()});
    if (cost >= best.cost - 1e-12) return;
    best.cost = cost;
    best.count = static_cast<int>(chosen.size());
    std::copy_n(flips.begin(), chosen.size(), best.flips.begin());
  }

  Proposal cheapest(LocalId node) {
    const Ring ring = ring_of(mesh_, neighbours_, around_, node);
    std::array<std::int32_t, Ring::kMost> own;
    const auto n = static_cast<std::size_t>(ring.size);
    for (std::size_t c = 0; c < n; ++c) own[c] = mesh_.material[at(ring.cell[c])];
    const std::span<const std::int32_t> material(own.data(), n);
    std::vector<std::int32_t> present(own.begin(), own.begin() + ring.size);
    std::sort(present.begin(), present.end());
    present.erase(std::unique(present.begin(), present.end()), present.end());
    if (last_resort_) return all_to(ring, material, present.front());

    std::vector<Single> singles;
    for (int c = 0; c < ring.size; ++c)
      for (const std::int32_t m : present)
        if (m != own[static_cast<std::size_t>(c)])
          singles.push_back({{c, m}, cost_of(ring.cell[static_cast<std::size_t>(c)], m)});
    Proposal best;
    for (const Single& s : singles) consider(ring, material, {&s, 1}, best);
    if (best.count == 0 || best.cost > 0.9) pairs(ring, material, singles, best);
    if (best.count == 0 && singles.size() <= 24) triples(ring, material, singles, best);
    if (best.count == 0 || best.cost > 0.9 * kFrozen) {
      std::int32_t most = present.front();
      for (const std::int32_t m : present)
        if (std::count(material.begin(), material.end(), m) >
            std::count(material.begin(), material.end(), most))
          most = m;
      return all_to(ring, material, most);
    }
    return best;
  }
  void pairs(const Ring& ring, std::span<const std::int32_t> material, const std::vector<Single>& singles,
             Proposal& best) {
    for (std::size_t a = 0; a < singles.size(); ++a)
      for (std::size_t b = a + 1; b < singles.size(); ++b)
        if (singles[a].flip.slot != singles[b].flip.slot)
          consider(ring, material, std::array{singles[a], singles[b]}, best);
  }
  void triples(const Ring& ring, std::span<const std::int32_t> material, const std::vector<Single>& singles,
               Proposal& best) {
    for (std::size_t a = 0; a < singles.size(); ++a)
      for (std::size_t b = a + 1; b < singles.size(); ++b)
        for (std::size_t c = b + 1; c < singles.size(); ++c)
          if (singles[a].flip.slot != singles[b].flip.slot && singles[a].flip.slot != singles[c].flip.slot &&
              singles[b].flip.slot != singles[c].flip.slot)
            consider(ring, material, std::array{singles[a], singles[b], singles[c]}, best);
  }
  static Proposal all_to(const Ring& ring, std::span<const std::int32_t> material, std::int32_t m) {
    Proposal p;
    p.cost = kFrozen;
    for (int c = 0; c < ring.size; ++c)
      if (material[static_cast<std::size_t>(c)] != m) p.flips[static_cast<std::size_t>(p.count++)] = {c, m};
    return p;
  }

  void propose() {
    for (const LocalId n : active_) {
      if (stale_[at(n)] || last_resort_) {
        Proposal p = cheapest(n);
        proposals_[n] = {p.cost, {p.flips.begin(), p.flips.begin() + p.count}};
      }
      stale_[at(n)] = 0;
      claim_[at(n)] = proposals_.at(n).cost;
    }
  }

  void share_claims() {
    std::vector<std::uint8_t> changed(mesh_.position.size(), 0);
    for (const LocalId n : active_) changed[at(n)] = 1;
    claimed_ghosts_.clear();
    mesh_.node_exchange.copy_changed(std::span<double>(claim_), std::span<std::uint8_t>(changed),
                                     [&](LocalId ghost) { claimed_ghosts_.push_back(ghost); });
  }

  // A proposal wins when no other one that shares a cell with it is cheaper (ties: smaller node id).
  bool wins(LocalId node) const {
    for (const std::int32_t item : around_[node])
      for (const LocalId other : mesh_.hexes[at(item / 8)])
        if (other != node &&
            (claim_[at(other)] < claim_[at(node)] || (claim_[at(other)] == claim_[at(node)] && other < node)))
          return false;
    return true;
  }

  std::int64_t apply_winners() {
    std::vector<LocalId> winners;
    for (const LocalId n : active_)
      if (wins(n)) winners.push_back(n);
    for (const LocalId n : active_) claim_[at(n)] = kNoClaim;
    for (const LocalId n : claimed_ghosts_) claim_[at(n)] = kNoClaim;

    changed_cells_.clear();
    std::int64_t changes = 0;
    std::vector<std::uint8_t> won(mesh_.position.size(), 0);
    for (const LocalId n : winners) {
      won[at(n)] = 1;
      for (const Flip& f : proposals_.at(n).flips) {
        change(around_[n][static_cast<std::size_t>(f.slot)] / 8, f.to);
        ++changes;
      }
    }
    tell_ghosts(won);
    refresh();
    return changes;
  }
  void change(LocalId cell, std::int32_t to) {
    mesh_.material[at(cell)] = to;
    ++changes_[at(cell)];
    changed_cells_.push_back(cell);
  }
  void tell_ghosts(const std::vector<std::uint8_t>& won) {
    using G = GhostExchange;
    mesh_.node_exchange.send_records(
        [&](LocalId n, std::vector<char>& bytes) {
          if (!won[at(n)]) return;
          G::append(bytes, static_cast<std::int32_t>(proposals_.at(n).flips.size()));
          for (const Flip& f : proposals_.at(n).flips) {
            G::append(bytes, mesh_.hex_id[at(around_[n][static_cast<std::size_t>(f.slot)] / 8)]);
            G::append(bytes, f.to);
          }
        },
        [&](LocalId ghost, const char* from) {
          std::int32_t count;
          G::take(from, count);
          for (std::int32_t f = 0; f < count; ++f) {
            GlobalId cell;
            std::int32_t to;
            G::take(from, cell);
            G::take(from, to);
            for (const std::int32_t item : around_[ghost])
              if (mesh_.hex_id[at(item / 8)] == cell) change(item / 8, to);
          }
          return from;
        });
  }

  // Re-examines the nodes of changed cells; proposals within reach of a change are made anew.
  void refresh() {
    std::vector<LocalId> next = std::move(active_);
    for (const LocalId cell : changed_cells_)
      for (const LocalId n : mesh_.hexes[at(cell)]) {
        if (complete_[at(n)]) {
          bad_[at(n)] = is_bad(n);
          if (owned(n)) next.push_back(n);
        }
        for (const std::int32_t item : around_[n])
          for (const LocalId reach : mesh_.hexes[at(item / 8)]) stale_[at(reach)] = 1;
      }
    std::sort(next.begin(), next.end());
    next.erase(std::unique(next.begin(), next.end()), next.end());
    active_.clear();
    for (const LocalId n : next)
      if (bad_[at(n)]) active_.push_back(n);
  }

  struct Stored {
    double cost = kNoClaim;
    std::vector<Flip> flips;
  };

  HexMesh& mesh_;
  const Fractions& fractions_;
  const FaceNeighbours& neighbours_;
  const NodeHexes& around_;
  std::vector<std::uint8_t> changes_;              // per cell
  std::vector<std::uint8_t> bad_;                  // per node with a complete ring
  std::vector<std::uint8_t> complete_;             // per node
  std::vector<std::uint8_t> stale_;                // per node: its proposal must be made anew
  std::vector<double> claim_;                      // per node: cost of its proposal in this pass
  std::unordered_map<LocalId, Stored> proposals_;  // of active nodes; looked up, never walked
  std::vector<LocalId> active_;                    // owned non-manifold nodes, ascending
  std::vector<LocalId> claimed_ghosts_, changed_cells_, touched_;
  mutable std::array<std::int32_t, Ring::kMost> scratch_{};
  bool last_resort_ = false;
};

}  // namespace

ManifoldReport resolve_non_manifold(HexMesh& mesh, const Fractions& fractions,
                                    const FaceNeighbours& neighbours, const NodeHexes& around) {
  return Repair(mesh, fractions, neighbours, around).run();
}

bool interfaces_are_manifold(const HexMesh& mesh, const FaceNeighbours& neighbours, const NodeHexes& around) {
  std::vector<std::uint8_t> seen(mesh.position.size(), 0);
  std::vector<std::int32_t> material;
  for (std::size_t c = 0; c < mesh.hexes.size(); ++c) {
    if (mesh.layer[c] != 0) continue;
    for (const LocalId n : mesh.hexes[c]) {
      if (seen[at(n)]) continue;
      seen[at(n)] = 1;
      material.clear();
      for (const std::int32_t item : around[n]) material.push_back(mesh.material[at(item / 8)]);
      if (std::all_of(material.begin(), material.end(),
                      [&](std::int32_t m) { return m == material.front(); }))
        continue;
      if (!ring_of(mesh, neighbours, around, n).manifold(material)) return false;
    }
  }
  return true;
}

}  // namespace sculpt
