#include "smooth/published.hpp"

#include <algorithm>
#include <cmath>

#include "smooth/node_objective.hpp"

namespace sculpt {
namespace {

constexpr double kDifference = 1e-4;  // of the numerical gradient, in cells
constexpr double kSliding = 0.1;      // weight of a tangential deviation in Geometry::weight
constexpr int kSteps = 2;             // gradients per node and pass
constexpr int kBisections = 4;

// Where a node would go, and what it would gain.
struct Proposal {
  Vec3 position;
  double quality = 0, better = 0;
  std::uint8_t improves = 0;
};

// What one node would do if all others stood still.
class NodeOptimiser {
 public:
  NodeOptimiser(const ActiveSet& set, const Geometry& geometry, const SmoothOptions& options)
      : set_(set), mesh_(set.mesh()), geometry_(geometry), options_(options) {
    const Vec3& h = mesh_.cell_size;
    per_cell_ = 1 / std::cbrt(h.x * h.y * h.z);
  }

  Proposal propose(LocalId node) {
    const Vec3 start = mesh_.position[at(node)];
    scale_ = per_cell_ / mesh_.unit(node);
    Proposal proposal{start, 0, 0, 0};
    objective_.gather(mesh_, set_.around()[node], node, scale_, options_.size_aware);
    const NodeObjective::Value first = objective_.at_displacement({});
    proposal.quality = proposal.better = first.quality();
    std::vector<Vec3> directions = free_directions(node);
    if (directions.empty()) return proposal;
    Vec3 y;
    NodeObjective::Value best = first;
    for (int step = 0; step < kSteps; ++step) {
      if (step > 0 && best.quality() > options_.target) break;
      const Vec3 up = gradient(y, best, directions);
      if (!(norm(up) > 0) || !search(node, start, unit(up), first.negative, y, best)) break;
    }
    if (best.quality() > first.quality()) {
      proposal.position = start + (1 / scale_) * y;
      proposal.better = best.quality();
      proposal.improves = 1;
    }
    return proposal;
  }

  // A node back to its interface and to the boundary, after a move that was not made in full.
  [[nodiscard]] Vec3 on_surface(LocalId node, const Vec3& p) const {
    return slides(node) ? projected(node, p) : p + held(mesh_, node, p, {});
  }

 private:
  // A node of a surface, which keeps to it.
  [[nodiscard]] bool slides(LocalId node) const {
    const LocalId entry = geometry_.index[at(node)];
    return entry != kNone && !geometry_.on_curve[at(entry)];
  }
  [[nodiscard]] Vec3 projected(LocalId node, const Vec3& p) const {
    return p + held(mesh_, node, p, geometry_.onto(geometry_.index[at(node)], p) - p);
  }
  // The normal of a surface node: the direction in which its weight exceeds that of sliding.
  [[nodiscard]] Vec3 normal(LocalId entry) const {
    const auto& w = geometry_.weight[at(entry)];
    const Vec3 rows[3] = {
        {w[0] - kSliding, w[1], w[2]}, {w[1], w[3] - kSliding, w[4]}, {w[2], w[4], w[5] - kSliding}};
    const Vec3* longest = &rows[0];
    for (const Vec3& row : rows)
      if (dot(row, row) > dot(*longest, *longest)) longest = &row;
    return unit(*longest);
  }

  // Unit vectors along which the node may move; none for a node of a curve or vertex that is held.
  [[nodiscard]] std::vector<Vec3> free_directions(LocalId node) const {
    const LocalId entry = geometry_.index[at(node)];
    std::vector<Vec3> directions;
    if (entry != kNone && geometry_.on_curve[at(entry)]) {
      float worst = 2;
      for (const std::int32_t item : set_.around()[node])
        worst = std::min(worst, set_.quality()[at(item / 8)]);
      if (!(static_cast<double>(worst) < options_.release_curves_below)) return directions;
    }
    std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    if (slides(node)) {
      const Vec3 n = normal(entry);
      std::size_t across = 0;  // the axis least aligned with the normal
      for (std::size_t d = 1; d < 3; ++d)
        if (std::fabs(n[d]) < std::fabs(n[across])) across = d;
      const Vec3 u = unit(axes[across] - n[across] * n);
      axes = {u, cross(n, u), Vec3{}};
    }
    const Freedom free = freedom(mesh_, node, mesh_.position[at(node)]);
    for (const Vec3& axis : axes) {
      const Vec3 kept = free.along(axis);
      if (norm(kept) > 1e-6) directions.push_back(unit(kept));
    }
    return directions;
  }

  // By forward differences (2.14 to 2.17).
  [[nodiscard]] Vec3 gradient(const Vec3& y, const NodeObjective::Value& here,
                              const std::vector<Vec3>& directions) const {
    Vec3 sum;
    for (const Vec3& d : directions) {
      const NodeObjective::Value ahead = objective_.at_displacement(y + kDifference * d);
      const double rise =
          here.valid() ? ahead.jacobian - here.jacobian : ahead.negative_volume - here.negative_volume;
      sum += (rise / kDifference) * d;
    }
    return sum;
  }

  // Along a direction, from the mean edge length, by bisection (2.18). Takes the best place found.
  bool search(LocalId node, const Vec3& start, const Vec3& direction, int most_negative, Vec3& y,
              NodeObjective::Value& best) const {
    const Vec3 from = y;
    double length = objective_.mean_edge(), half = length;
    bool found = false;
    for (int i = 0; i <= kBisections; ++i) {
      Vec3 there = from + length * direction;
      if (slides(node))
        there = scale_ * (projected(node, start + (1 / scale_) * there) - start);
      else if (!mesh_.exterior.empty())
        there = scale_ * held(mesh_, node, start, (1 / scale_) * there);
      const NodeObjective::Value value = objective_.at_displacement(there);
      const bool better = value.quality() > best.quality() && value.negative <= most_negative;
      if (better) {
        best = value;
        y = there;
        found = true;
      }
      half *= 0.5;
      length += better && i > 0 ? half : -half;
    }
    return found;
  }

  const ActiveSet& set_;
  const HexMesh& mesh_;
  const Geometry& geometry_;
  const SmoothOptions& options_;
  double per_cell_ = 1;  // at level 0
  double scale_ = 1;     // at the node that is looked at
  NodeObjective objective_;
};

class PublishedOptimisation {
 public:
  PublishedOptimisation(ActiveSet& set, const Geometry& geometry, const SmoothOptions& options,
                        const Log& log)
      : set_(set), mesh_(set.mesh()), options_(options), log_(log), optimiser_(set, geometry, options) {}

  void run() {
    Standing best = standing();
    for (int pass = 1; pass <= options_.improve_sweeps; ++pass) {
      const std::vector<Vec3> before = mesh_.position;
      const std::int64_t moves = jacobi_pass(pass);
      const Standing now = standing();
      log_.line("Jacobi Opt Iter: {},  Num bad: {}, Num poor: {}, Min SJ: {:f}", pass, now.bad, now.poor,
                now.least);
      if (moves == 0) break;
      if (!now.better_than(best)) {  // no improvement: the pass is not kept
        mesh_.position = before;
        set_.refresh_all_quality();
        break;
      }
      best = now;
    }
    colouring();
  }

 private:
  // How good the mesh is as a whole.
  struct Standing {
    std::int64_t bad, poor;
    double least;
    [[nodiscard]] bool better_than(const Standing& other) const {
      if (bad != other.bad) return bad < other.bad;
      if (poor != other.poor) return poor < other.poor;
      return least > other.least;
    }
  };
  [[nodiscard]] Standing standing() const {
    const ActiveSet::Worst w = set_.worst(options_.target);
    return {w.not_positive, w.below_02, w.quality};
  }

  // All nodes of poor hexes and of the hexes around them, from the same state.
  std::int64_t jacobi_pass(int pass) {
    set_.choose(options_.improve_below, 1, false);
    const double damping =
        options_.damping ? static_cast<double>(pass) / options_.improve_sweeps : 1.0;  // (2.19)
    std::vector<std::pair<LocalId, Vec3>> moves;
    for (const LocalId n : set_.chosen()) {
      const Proposal p = optimiser_.propose(n);
      if (!p.improves) continue;
      const Vec3& here = mesh_.position[at(n)];
      moves.emplace_back(
          n, damping < 1 ? optimiser_.on_surface(n, here + damping * (p.position - here)) : p.position);
    }
    for (const auto& [n, p] : moves) mesh_.position[at(n)] = p;
    share_positions(mesh_);
    set_.refresh_all_quality();
    return set_.comm().sum(static_cast<std::int64_t>(moves.size()));
  }

  void colouring() {
    const std::int64_t nodes = set_.choose(options_.target, 0, false);
    if (nodes == 0) {
      log_.line("No parallel color smoothing performed: min SJ > {:f}", options_.target);
      return;
    }
    log_.line("Begin parallel color smoothing {} nodes below threshold {:f}", nodes, options_.target);
    proposals_.assign(mesh_.position.size(), {});
    known_.assign(mesh_.position.size(), 0);
    for (int i = 1; i <= options_.target_rounds && set_.choose(options_.target, 0, false) > 0; ++i) {
      const std::vector<LocalId> winners = select(set_.chosen());
      const std::int64_t moves = set_.comm().sum(static_cast<std::int64_t>(winners.size()));
      if (moves == 0) {
        log_.line("WARNING: Smoothing terminated. Unable to make additional improvement.");
        return;
      }
      move(winners);
      const ActiveSet::Worst w = set_.worst(options_.target);
      log_.line("Coloring Opt Iter: {}, Num Smooths: {}, Num bad: {}, Num poor: {}, Min SJ: {:f}", i, moves,
                w.not_positive, w.below_target, w.quality);
    }
  }

  // The owned nodes whose proposals beat those of all nodes that share a hex with them.
  std::vector<LocalId> select(const std::vector<LocalId>& candidates) {
    for (const LocalId n : candidates)
      if (!known_[at(n)]) {
        proposals_[at(n)] = optimiser_.propose(n);
        known_[at(n)] = 1;
      }
    // Nodes that are no candidates any more must not win.
    std::vector<Proposal> offers(proposals_.size());
    for (const LocalId n : candidates) offers[at(n)] = proposals_[at(n)];
    mesh_.node_exchange.copy_to_ghosts(offers);
    const auto home = [&](LocalId n) { return mesh_.node_homes()[at(n)]; };
    const auto beats = [&](LocalId a, LocalId b) {
      const Proposal &x = offers[at(a)], &y = offers[at(b)];
      if (x.quality != y.quality) return x.quality < y.quality;
      if (x.better != y.better) return x.better > y.better;
      return home(a) < home(b);
    };
    std::vector<LocalId> winners;
    for (const LocalId n : candidates) {
      bool wins = offers[at(n)].improves != 0;
      for (const std::int32_t item : set_.around()[n])
        for (const LocalId other : mesh_.hexes[at(item / 8)])
          wins = wins && (home(other) == home(n) || !offers[at(other)].improves || beats(n, other));
      if (wins) winners.push_back(n);
    }
    return winners;
  }

  // Winners go where they proposed; whoever shares a hex with one has to think again.
  void move(const std::vector<LocalId>& winners) {
    std::vector<std::uint8_t> changed(mesh_.position.size(), 0);
    std::vector<LocalId> moved = winners;
    for (const LocalId n : winners) {
      mesh_.position[at(n)] = proposals_[at(n)].position;
      round_to_quantum(mesh_, mesh_.position[at(n)]);
      changed[at(n)] = 1;
    }
    mesh_.node_exchange.copy_changed(std::span<Vec3>(mesh_.position), std::span<std::uint8_t>(changed),
                                     [&](LocalId ghost) {
                                       Vec3& p = mesh_.position[at(ghost)];
                                       p = position_of_ghost(mesh_, ghost, p);
                                       moved.push_back(ghost);
                                     });
    set_.refresh_quality_around(moved);
    for (const LocalId n : moved)
      for (const std::int32_t item : set_.around()[n])
        for (const LocalId other : mesh_.hexes[at(item / 8)]) known_[at(other)] = 0;
  }

  ActiveSet& set_;
  HexMesh& mesh_;
  const SmoothOptions& options_;
  const Log& log_;
  NodeOptimiser optimiser_;
  std::vector<Proposal> proposals_;  // per node, for the colouring
  std::vector<std::uint8_t> known_;  // per node: its proposal is up to date
};

}  // namespace

void optimise_as_published(ActiveSet& set, const Geometry& geometry, const SmoothOptions& options,
                           const Log& log) {
  PublishedOptimisation(set, geometry, options, log).run();
}

}  // namespace sculpt
