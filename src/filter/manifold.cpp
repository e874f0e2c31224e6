#include <algorithm>
#include <limits>
#include <unordered_map>

#include "filter/edits.hpp"
#include "filter/ring.hpp"
#include "sculpt/filter/filter.hpp"
#include "sculpt/vfrac/fractions.hpp"

namespace sculpt {
namespace {

constexpr double kNoClaim = std::numeric_limits<double>::infinity();
constexpr int kPasses = 60;        // of the cost-driven repair, then the last resort
constexpr int kLockedPasses = 90;  // then locked cells are no longer spared
constexpr int kReversalPasses = 10;
constexpr std::size_t kMostFree = 12;  // cells of a ring whose materials are all tried
constexpr double kFrozen = 1000;       // cost that keeps a cell from changing again
constexpr double kContact = 0.05;      // cost per face neighbour of the old (+) and of the new (-) material
constexpr double kRare = 0.5;  // cost of taking the only cell of a material; the gain of giving it another
constexpr double kReversed = 0.1;  // squared sine: faces within 18 degrees of being back to back

struct Flip {
  int slot;  // in the ring
  std::int32_t to;
};

struct Proposal {
  double cost = kNoClaim;
  int count = 0;
  std::array<Flip, Ring::kMost> flips;
};

}  // namespace

class ManifoldRepair::Work {
 public:
  explicit Work(Edits& edits)
      : edits_(edits),
        mesh_(edits.mesh),
        neighbours_(edits.neighbours),
        around_(edits.around),
        bad_(mesh_.position.size(), 0),
        stale_(mesh_.position.size(), 1),
        claim_(mesh_.position.size(), kNoClaim) {
    complete_.assign(mesh_.position.size(), 0);
    for (std::size_t c = 0; c < mesh_.hexes.size(); ++c)
      if (mesh_.layer[c] <= 1)
        for (const LocalId n : mesh_.hexes[c]) complete_[at(n)] = 1;
  }

  std::int64_t run(FilterReport& report) {
    const Comm& comm = edits_.comm();
    if (!looked_) {
      find_bad_nodes();
      if (first_) report.bad_nodes = comm.sum(static_cast<std::int64_t>(active_.size()));
      first_ = false;
    } else {
      refresh();
    }
    std::int64_t changes = 0;
    int passes = 0;
    for (std::int64_t left = comm.sum(static_cast<std::int64_t>(active_.size())); left > 0;
         left = comm.sum(static_cast<std::int64_t>(active_.size()))) {
      spare_locked_ = passes < kLockedPasses;
      last_resort_ = passes++ >= kPasses;
      if (last_resort_) report.forced_nodes = std::max(report.forced_nodes, left);
      changes += pass();
    }
    report.manifold_cells += changes;
    report.manifold_passes += passes;
    return changes;
  }

  std::int64_t remove_reversals(FilterReport& report) {
    const Comm& comm = edits_.comm();
    reversals_ = true;
    find_bad_nodes();
    if (report.reversals == 0) report.reversals = comm.sum(static_cast<std::int64_t>(active_.size()));
    std::int64_t changes = 0;
    last_resort_ = false;
    for (int i = 0; i < kReversalPasses && comm.sum(static_cast<std::int64_t>(active_.size())) > 0; ++i)
      changes += pass();
    reversals_ = false;
    looked_ = false;
    changes += run(report);
    return changes;
  }

 private:
  std::int64_t pass() {
    collectively(edits_.comm(), "resolving non-manifold nodes", [&] { propose(); });
    share_claims();
    return edits_.comm().sum(apply_winners());
  }
  bool is_bad(LocalId node) const {
    const auto items = around_[node];
    const std::int32_t first = mesh_.material[at(items[0] / 8)];
    bool mixed = false;
    for (const std::int32_t item : items) mixed = mixed || mesh_.material[at(item / 8)] != first;
    if (!mixed) return false;
    const Ring ring = ring_of(mesh_, neighbours_, around_, node);
    return !acceptable(ring, materials(items));
  }
  struct Side {  // of an interface, seen from the smaller material
    std::int32_t from, to;
    Vec3 normal;
  };
  // While reversals are removed a node with one is as bad as a non-manifold one.
  bool acceptable(const Ring& ring, std::span<const std::int32_t> material) const {
    return ring.manifold(material) && (!reversals_ || !reversed(ring, material));
  }
  // Whether two faces of one interface at the node are back to back (equation 2.3).
  bool reversed(const Ring& ring, std::span<const std::int32_t> material) const {
    std::vector<Side>& sides = sides_;
    sides.clear();
    for (std::size_t c = 0; c < material.size(); ++c)
      for (std::uint64_t t = ring.touching[c] >> c >> 1 << c << 1; t != 0; t &= t - 1) {
        const auto d = static_cast<std::size_t>(std::countr_zero(t));
        if (material[c] == material[d]) continue;
        const Vec3 across = normal_towards(ring.cell[c], ring.cell[d]);
        if (material[c] < material[d])
          sides.push_back({material[c], material[d], across});
        else
          sides.push_back({material[d], material[c], -across});
      }
    for (std::size_t i = 0; i < sides.size(); ++i)
      for (std::size_t j = i + 1; j < sides.size(); ++j)
        if (sides[i].from == sides[j].from && sides[i].to == sides[j].to &&
            dot(sides[i].normal, sides[j].normal) < kReversed - 1)
          return true;
    return false;
  }
  // Unit normal of the face between two cells.
  Vec3 normal_towards(LocalId cell, LocalId other) const {
    const auto& beside = neighbours_[at(cell)];
    const auto face = std::find(beside.begin(), beside.end(), other) - beside.begin();
    std::array<Vec3, 4> p;
    for (std::size_t v = 0; v < 4; ++v)
      p[v] = mesh_.position[at(
          mesh_.hexes[at(cell)][static_cast<std::size_t>(kFaces[static_cast<std::size_t>(face)][v])])];
    return unit(cross(p[2] - p[0], p[3] - p[1]));
  }

  std::span<const std::int32_t> materials(std::span<const std::int32_t> items) const {
    for (std::size_t i = 0; i < items.size(); ++i) scratch_[i] = mesh_.material[at(items[i] / 8)];
    return {scratch_.data(), items.size()};
  }

  // Nodes of owned and first-layer cells have complete rings; proposals look at all of them.
  void find_bad_nodes() {
    active_.clear();
    std::fill(stale_.begin(), stale_.end(), std::uint8_t{1});
    for (LocalId n = 0; n < mesh_.nodes(); ++n) {
      if (!complete_[at(n)]) continue;
      bad_[at(n)] = is_bad(n);
      if (bad_[at(n)] && owned(n)) active_.push_back(n);
    }
    seen_ = edits_.changed().size();
    looked_ = true;
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
    return edits_.loss(cell, to) + kContact * (with_old - with_new) +
           kRare * (edits_.rarity(from) - edits_.rarity(to)) + (edits_.frozen(cell) ? kFrozen : 0.0);
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
    if (!acceptable(ring, {changed.data(), material.size()})) return;
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
        if (m != own[static_cast<std::size_t>(c)] && !edits_.locked(ring.cell[static_cast<std::size_t>(c)]))
          singles.push_back({{c, m}, cost_of(ring.cell[static_cast<std::size_t>(c)], m)});
    Proposal best;
    for (const Single& s : singles) consider(ring, material, {&s, 1}, best);
    if (best.count == 0 || best.cost > 0.9) pairs(ring, material, singles, best);
    if (best.count == 0 && singles.size() <= 24) triples(ring, material, singles, best);
    if (reversals_) return best;  // a reversal without a way out stays
    if (best.count == 0 || best.cost > 0.9 * kFrozen) {
      std::int32_t most = present.front();
      for (const std::int32_t m : present)
        if (std::count(material.begin(), material.end(), m) >
            std::count(material.begin(), material.end(), most))
          most = m;
      Proposal p = all_to(ring, material, most);
      return p.count > 0 && settles(ring, material, p) ? p : around_locked(ring, material, present, p);
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
  bool settles(const Ring& ring, std::span<const std::int32_t> material, const Proposal& p) const {
    std::array<std::int32_t, Ring::kMost> changed;
    std::copy(material.begin(), material.end(), changed.begin());
    for (int f = 0; f < p.count; ++f)
      changed[static_cast<std::size_t>(p.flips[static_cast<std::size_t>(f)].slot)] =
          p.flips[static_cast<std::size_t>(f)].to;
    return ring.manifold({changed.data(), material.size()});
  }
  // Where locked cells stand in the way: the free cells go to one or two materials, whichever way is manifold
  // with fewest changes. `otherwise` when there is none or there are too many to try.
  Proposal around_locked(const Ring& ring, std::span<const std::int32_t> material,
                         const std::vector<std::int32_t>& present, const Proposal& otherwise) const {
    Proposal best = otherwise;
    int fewest = ring.size + 1;
    std::vector<int> free;
    for (int c = 0; c < ring.size; ++c)
      if (!edits_.locked(ring.cell[static_cast<std::size_t>(c)])) free.push_back(c);
    if (free.size() > kMostFree) return best;
    for (const std::int32_t a : present)
      for (const std::int32_t b : present)
        for (unsigned mask = 0; a < b && mask < 1U << free.size(); ++mask) {
          Proposal p;
          p.cost = kFrozen;
          for (std::size_t i = 0; i < free.size(); ++i) {
            const std::int32_t to = mask >> i & 1 ? a : b;
            if (material[static_cast<std::size_t>(free[i])] != to)
              p.flips[static_cast<std::size_t>(p.count++)] = {free[i], to};
          }
          if (p.count >= fewest || !settles(ring, material, p)) continue;
          fewest = p.count;
          best = p;
        }
    return best;
  }
  Proposal all_to(const Ring& ring, std::span<const std::int32_t> material, std::int32_t m) const {
    Proposal p;
    p.cost = kFrozen;
    for (int c = 0; c < ring.size; ++c)
      if (material[static_cast<std::size_t>(c)] != m &&
          !(spare_locked_ && edits_.locked(ring.cell[static_cast<std::size_t>(c)])))
        p.flips[static_cast<std::size_t>(p.count++)] = {c, m};
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

  // A proposal wins when no other one that shares a cell with it is cheaper (ties: smaller node id). A node's
  // own images claim what it claims itself.
  bool wins(LocalId node) const {
    const std::span<const GlobalId> home = mesh_.node_homes();
    for (const std::int32_t item : around_[node])
      for (const LocalId other : mesh_.hexes[at(item / 8)])
        if (claim_[at(other)] < claim_[at(node)] ||
            (claim_[at(other)] == claim_[at(node)] && home[at(other)] < home[at(node)]))
          return false;
    return true;
  }

  std::int64_t apply_winners() {
    std::vector<LocalId> winners;
    for (const LocalId n : active_)
      if (wins(n)) winners.push_back(n);
    for (const LocalId n : active_) claim_[at(n)] = kNoClaim;
    for (const LocalId n : claimed_ghosts_) claim_[at(n)] = kNoClaim;

    std::int64_t changes = 0;
    std::vector<std::uint8_t> won(mesh_.position.size(), 0);
    for (const LocalId n : winners) {
      won[at(n)] = 1;
      for (const Flip& f : proposals_.at(n).flips) {
        edits_.change(around_[n][static_cast<std::size_t>(f.slot)] / 8, f.to);
        ++changes;
      }
    }
    tell_ghosts(won);
    refresh();
    return changes;
  }
  void tell_ghosts(const std::vector<std::uint8_t>& won) {
    using G = GhostExchange;
    mesh_.node_exchange.send_records(
        [&](LocalId n, std::vector<char>& bytes) {
          if (!won[at(n)]) return;
          G::append(bytes, static_cast<std::int32_t>(proposals_.at(n).flips.size()));
          for (const Flip& f : proposals_.at(n).flips) {
            G::append(bytes, mesh_.hex_homes()[at(around_[n][static_cast<std::size_t>(f.slot)] / 8)]);
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
              if (mesh_.hex_homes()[at(item / 8)] == cell) edits_.change(item / 8, to);
          }
          return from;
        });
  }

  // Re-examines the nodes of changed cells; proposals within reach of a change are made anew.
  void refresh() {
    std::vector<LocalId> next = std::move(active_);
    for (; seen_ < edits_.changed().size(); ++seen_)
      for (const LocalId n : mesh_.hexes[at(edits_.changed()[seen_])]) {
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

  Edits& edits_;
  HexMesh& mesh_;
  const FaceNeighbours& neighbours_;
  const NodeHexes& around_;
  std::vector<std::uint8_t> bad_;                  // per node with a complete ring
  std::vector<std::uint8_t> complete_;             // per node
  std::vector<std::uint8_t> stale_;                // per node: its proposal must be made anew
  std::vector<double> claim_;                      // per node: cost of its proposal in this pass
  std::unordered_map<LocalId, Stored> proposals_;  // of active nodes; looked up, never walked
  std::vector<LocalId> active_;                    // owned non-manifold nodes, ascending
  std::vector<LocalId> claimed_ghosts_, touched_;
  std::size_t seen_ = 0;  // changes of the cells looked at so far
  mutable std::array<std::int32_t, Ring::kMost> scratch_{};
  mutable std::vector<Side> sides_;
  bool first_ = true, looked_ = false, last_resort_ = false, spare_locked_ = true, reversals_ = false;
};

ManifoldRepair::ManifoldRepair(Edits& edits) : work_(std::make_unique<Work>(edits)) {}
ManifoldRepair::~ManifoldRepair() = default;
std::int64_t ManifoldRepair::run(FilterReport& report) { return work_->run(report); }
std::int64_t ManifoldRepair::remove_reversals(FilterReport& report) {
  return work_->remove_reversals(report);
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
