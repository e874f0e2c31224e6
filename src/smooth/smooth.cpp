#include "sculpt/smooth/smooth.hpp"

#include <algorithm>
#include <cmath>

#include "sculpt/geom/hex_quality.hpp"
#include "smooth/active_set.hpp"
#include "smooth/laplacian.hpp"
#include "smooth/node_step.hpp"
#include "smooth/published.hpp"

namespace sculpt {
namespace {

constexpr int kUntangleSweeps = 60, kBulkSweeps = 3, kUntangleRound = 15;
constexpr int kRaiseAttempts = 3, kUnfoldSweeps = 6, kLengthenSweeps = 6;
constexpr double kShort = 0.06, kLongEnough = 0.1;  // edges, in cells
constexpr int kAttempts = 3;                        // of all phases, each from another place
constexpr double kFolded = 1e-6;                    // the quality that marks a folded hex is below this
constexpr double kFar = 0.05;      // a move that makes the neighbours worth another visit: a length, whatever
                                   // the cells are; with an exterior in mean cells
constexpr double kMargin = 0.05;   // hexes this little above the target are raised as well
constexpr double kGiveWay = 0.3;   // price of deviation from one round of the guarantee to the next
constexpr double kNoPrice = 1e-5;  // of deviation: lowering it further changes nothing
constexpr double kLowPrice = 0.02;  // interface nodes may climb whatever the deviation
constexpr int kFitRounds = 12, kCaptureRounds = 40, kLastFits = 6;
constexpr double kCapturedAbove = 0.12,
                 kCapturedEdge = 0.04;  // what captured nodes leave: quality, edges in cells
constexpr double kFitted = 0.002;       // distance from the geometry that is not worth a move, in cells

// What raising works towards.
struct Aim {
  double target;       // scaled Jacobian
  double fidelity;     // price of deviation
  int sweeps;          // most of them
  bool tells;          // a line in the log per sweep
  bool climbs_freely;  // interface nodes climb at any price
  int done = 0;
};

class Phases {
 public:
  Phases(HexMesh& mesh, const Geometry& geometry, const SmoothOptions& options, const Log& log)
      : mesh_(mesh),
        own_targets_(options.hold_on_geometry ? geometry : Geometry{}),
        geometry_(options.hold_on_geometry ? own_targets_ : geometry),
        options_(options),
        log_(log),
        set_(mesh),
        step_(mesh, set_.around(), geometry_, options.deviation_by_level),
        farthest_(options.max_deviation),
        floor_(options.target) {
    const Vec3& h = mesh.cell_size;
    per_axis_ = {1 / h.x, 1 / h.y, 1 / h.z};
    size_ = h.x == h.y && h.y == h.z ? h.x : std::cbrt(h.x * h.y * h.z);
    isotropic_ = {1 / size_, 1 / size_, 1 / size_};
    if (!mesh.exterior.empty()) far_ = kFar * size_;
  }

  void run() {
    log_.line("Smoothing {} hexes on {} processors", set_.comm().sum(owned_hexes()), set_.comm().size());
    laplacian_passes(mesh_, set_.around(), geometry_, options_.laplacian_passes, log_);
    if (limited()) pull_back_all();
    set_.refresh_all_quality();
    if (options_.method == OptimisationMethod::kPublished)
      optimise_as_published(set_, geometry_, options_, log_);
    else
      optimise();
    if (options_.hold_on_geometry) hold_on_geometry();
    if (limited()) without_folding([&] { fit([&](LocalId n) { return step_.limit(n, farthest_); }); });
    if (options_.guarantee_rounds > 0) guarantee();
    if (options_.hold_on_geometry || limited()) report_deviation();
  }

 private:
  [[nodiscard]] std::int64_t owned_hexes() const {
    return std::count(mesh_.layer.begin(), mesh_.layer.end(), std::uint8_t{0});
  }

  [[nodiscard]] bool limited() const { return std::isfinite(options_.max_deviation); }
  [[nodiscard]] double size_at(LocalId n) const { return size_ * mesh_.unit(n); }
  [[nodiscard]] bool on_interface(LocalId n) const { return geometry_.index[at(n)] != kNone; }

  void optimise() {
    for (int attempt = 1; attempt <= kAttempts; ++attempt) {
      untangle();
      improve();
      raise_to_target();
      if (unfold()) break;
      if (attempt < kAttempts) relax_everything(attempt);
    }
    if (set_.mark_short(kShort * size_) > 0) without_folding([&] { lengthen(); });
  }

  // The scaled Jacobian does not see an edge that is about to vanish: nodes of short edges take steps that
  // also look at the size, without loss of quality below the target.
  void lengthen() {
    StepRules rules = raising_rules(0.1 * options_.fidelity);
    rules.target_lengths = Star::Target::kUnit;
    rules.least_edge = kLongEnough;
    for (int i = 0; i < kLengthenSweeps; ++i, rules.penalty *= 0.5) {
      const std::int64_t hexes = set_.mark_short(kShort * size_);
      if (hexes == 0) break;
      log_.line("Lengthening Iter: {}, hexes with an edge below {:g} cells: {}", i + 1, kShort, hexes);
      set_.choose(kFolded, i / 2, false);
      sweep(rules, far_);
    }
    set_.refresh_all_quality();
  }

  std::int64_t sweep(const StepRules& rules, double far) {
    if (options_.hold_on_geometry) retarget();
    return moves_of([&](LocalId n) { return step_.newton(n, rules); }, far);
  }
  std::int64_t moves_of(const std::function<bool(LocalId)>& step, double far) {
    return never_folds_ ? set_.sweep(unfolded(step), far) : set_.sweep(step, far);
  }
  // Work that leaves no folded hex: if it does it is done once more from the start, with a look at every
  // step.
  void without_folding(const std::function<void()>& work) {
    const std::vector<Vec3> before = mesh_.position;
    work();
    if (unfold()) return;
    mesh_.position = before;
    set_.refresh_all_quality();
    never_folds_ = true;
    work();
    never_folds_ = false;
  }
  // A step that is taken back where it leaves more hexes with a Jacobian that is not positive inside.
  [[nodiscard]] std::function<bool(LocalId)> unfolded(std::function<bool(LocalId)> step) {
    return [this, step = std::move(step)](LocalId n) {
      Vec3& p = mesh_.position[at(n)];
      const Vec3 before = p;
      if (!step(n)) return false;
      const int folded = folded_around(n);
      if (folded == 0) return true;
      const Vec3 after = p;
      p = before;
      if (folded > folded_around(n)) return false;
      p = after;
      return true;
    };
  }
  [[nodiscard]] int folded_around(LocalId node) const {
    int folded = 0;
    for (const std::int32_t item : set_.around()[node]) {
      const HexCorners p = mesh_.corners(item / 8);
      folded += scaled_jacobian(p) < kNeverFolds && !is_positive_inside(p);
    }
    return folded;
  }

  void report(const char* phase, int iteration) const {
    const ActiveSet::Worst w = set_.worst(options_.target);
    log_.line("{} Iter: {},  Num bad: {}, Num poor: {}, Min SJ: {:f}", phase, iteration, w.not_positive,
              w.below_02, w.quality);
  }

  // Nodes that are held on the geometry may slide: each aims at the point that belongs to where it is now.
  void retarget() {
    for (LocalId n = 0; n < mesh_.nodes(); ++n)
      if (on_interface(n) && set_.owned(n)) {
        const Vec3& p = mesh_.position[at(n)];
        own_targets_.target[at(geometry_.index[at(n)])] = p + step_.towards_geometry(n, p);
      }
  }
  void pull_back_all() {
    for (LocalId n = 0; n < mesh_.nodes(); ++n)
      if (set_.owned(n)) step_.pull_back(n, farthest_);
    share_positions(mesh_);
  }

  // Positive determinants everywhere. A limit of deviation is given up only where hexes stay inverted.
  void untangle() {
    untangle_within_limit();
    if (!limited() || set_.worst(options_.target).not_positive == 0) return;
    log_.line("Untangling goes on beyond the limit of deviation");
    farthest_ = std::numeric_limits<double>::infinity();
    untangle_within_limit();
    farthest_ = options_.max_deviation;
  }
  // Positive determinants everywhere: minimise the regularised energy while the regularisation falls with the
  // worst determinant. Determinants do not care about a scaling of the axes, so cells count as cubes here.
  void untangle_within_limit() {
    step_.set_scale(per_axis_);
    StepRules rules;
    rules.guarded = false;
    rules.target_lengths = Star::Target::kUnit;
    rules.least_move = 1e-5;
    rules.release_curves_below = options_.release_curves_below;
    rules.penalty = options_.fidelity;
    rules.farthest = farthest_;
    int layers = 1;
    double eps = 0;
    for (int i = 0; i < kUntangleSweeps; ++i) {
      const double worst = set_.least_determinant(per_axis_);
      if (set_.worst(options_.target).not_positive == 0 && worst > 0) break;
      const bool stuck = i > 0 && i % kUntangleRound == 0;
      if (stuck) relax_everything(layers);
      eps = next_eps(worst, eps, i == 0 || stuck);
      rules.eps = eps;
      if (i >= kBulkSweeps)
        rules.penalty = std::max(rules.penalty * 0.5, 1e-4);      // interfaces give way more easily
      if (i > 0 && i % 5 == 0) layers = std::min(layers + 1, 4);  // and farther around
      // The first sweeps settle the bulk; what resists them is worked on in its own neighbourhood.
      set_.choose(i < kBulkSweeps ? 0.1 : 1e-3, layers, false);
      sweep(rules, far_);
      report("Untangling", i + 1);
    }
  }
  // Where untangling does not get on, it starts again from another place: a few Laplacian passes over all
  // nodes around the inverted hexes, those of interfaces included.
  void relax_everything(int layers) {
    set_.choose(1e-3, layers, false);
    for (int pass = 0; pass < 5; ++pass)
      set_.sweep(
          [&](LocalId n) {
            mesh_.position[static_cast<std::size_t>(n)] += towards_neighbours(mesh_, set_.around(), n);
            if (std::isfinite(farthest_)) step_.pull_back(n, farthest_);
            return true;
          },
          far_);
  }
  static double next_eps(double worst, double eps, bool first) {
    if (first) eps = worst < 1e-4 ? std::sqrt(1e-12 + 0.04 * worst * worst) + 1e-2 : 1e-2;
    const double chi = 0.5 * (worst + std::sqrt(eps * eps + worst * worst)), aim = 0.5 * chi;
    const double next = worst < aim ? 2 * std::sqrt(aim * (aim - worst)) : 1e-6;
    return std::max(next, first ? 1e-2 : 1e-6);
  }

  void improve() {
    step_.set_scale(isotropic_);
    StepRules rules;
    rules.least_quality = options_.target;
    rules.release_curves_below = options_.release_curves_below;
    rules.penalty = options_.fidelity;
    rules.farthest = farthest_;
    std::int64_t first = 0;
    for (int i = 0; i < options_.improve_sweeps; ++i) {
      const std::int64_t nodes = set_.choose(options_.improve_below, 1, i > 0);
      if (i == 0) first = nodes;
      if (nodes == 0 || (i > 0 && nodes < first / 50)) break;
      const std::int64_t moves = sweep(rules, far_);
      report("Jacobi Opt", i + 1);
      if (moves < nodes / 50) break;
    }
  }

  // What is still below the target: steeper energies, which look more and more at the worst corner only, then
  // the climb of single corners. Where that is not enough interfaces give way more easily.
  void raise_to_target() {
    const std::int64_t nodes = set_.choose(options_.target, 0, false);
    if (nodes == 0) {
      log_.line("No parallel color smoothing performed: min SJ > {:f}", options_.target);
      return;
    }
    log_.line("Begin parallel color smoothing {} nodes below threshold {:f}", nodes, options_.target);
    Aim aim{options_.target, options_.fidelity, options_.target_rounds, true, true};
    for (int attempt = 0; attempt < kRaiseAttempts && set_.worst(options_.target).below_target > 0;
         ++attempt) {
      steepen(aim);
      climb(aim);
      aim.fidelity *= 0.1;
    }
    if (set_.worst(options_.target).below_target > 0)
      log_.line("WARNING: Smoothing terminated. Unable to make additional improvement.");
  }
  void steepen(Aim& aim) {
    StepRules rules = raising_rules(aim.fidelity);
    for (rules.power = 2; rules.power <= 8; rules.power *= 2) {
      rules.penalty *=
          std::pow(1 / aim.target, rules.power / 4.0);  // keeps pace with the energy at the target
      for (int i = 0; i < 4 && aim.done < aim.sweeps; ++i) {
        if (set_.choose(aim.target + kMargin, 1, false) == 0) return;
        const std::int64_t moves = sweep(rules, far_);
        report_target(aim, moves);
        if (moves == 0) break;
      }
    }
  }
  void climb(Aim& aim) {
    const bool freely = aim.climbs_freely || aim.fidelity < kLowPrice;
    StepRules rules = raising_rules(freely ? 0 : aim.fidelity);
    rules.power = 4;
    const auto step = [&](LocalId n) { return (freely || !on_interface(n)) && step_.climb(n, rules); };
    for (int i = 0; i < 24 && aim.done < aim.sweeps; ++i) {
      if (set_.choose(aim.target, 0, false) == 0) return;
      const std::int64_t moves = moves_of(step, far_);
      report_target(aim, moves);
      if (moves == 0) return;
      if (i % 4 == 3) {
        set_.choose(aim.target, 1, false);
        sweep(rules, far_);
      }
    }
  }

  // Guaranteed quality: around the hexes below it interfaces give way a little more in every round.
  void guarantee() {
    const double goal = options_.guarantee;
    if (set_.worst(goal).not_positive > 0) untangle();
    floor_ = std::max(options_.target, goal);
    step_.set_scale(isotropic_);
    const std::vector<Vec3> before = mesh_.position;
    Aim aim{goal, options_.fidelity, std::numeric_limits<int>::max(), false, false};
    std::int64_t left = set_.worst(goal).below_target;
    for (int i = 1; i <= options_.guarantee_rounds && left > 0; ++i, aim.fidelity *= kGiveWay) {
      without_folding([&] {
        steepen(aim);
        climb(aim);
      });
      const ActiveSet::Worst w = set_.worst(goal);
      left = w.below_target;
      log_.line(
          "Guaranteed Quality Iter: {}, Num below {:g}: {}, Min SJ: {:f}, farthest interface node: {:f} "
          "cells",
          i, goal, left, w.quality, farthest_of_moved(before));
      if (aim.fidelity < kNoPrice) break;
    }
    if (left > 0)
      log_.line("WARNING: {} hexes stay below the guaranteed quality {:g}", left, goal);
    else
      log_.line("Guaranteed quality {:g} holds", goal);
  }
  // Largest distance, in cells, from its target that an interface node has which is not where it was before.
  [[nodiscard]] double farthest_of_moved(const std::vector<Vec3>& before) const {
    double farthest = 0;
    for (LocalId n = 0; n < mesh_.nodes(); ++n) {
      const Vec3& p = mesh_.position[at(n)];
      if (on_interface(n) && set_.owned(n) && !(p == before[at(n)]))
        farthest = std::max(farthest, norm(p - geometry_.target[at(geometry_.index[at(n)])]) / size_at(n));
    }
    return set_.comm().max(farthest);
  }

  void hold_on_geometry() {
    const double floor = floor_;
    if (options_.captured) floor_ = std::min(floor_, kCapturedAbove);
    without_folding([&] { fit([&](LocalId n) { return kFitted * size_at(n); }); });
    floor_ = floor;
  }
  // Interface nodes farther than their tolerance from the geometry go back to it as far as the floor allows;
  // between the rounds the nodes around them make room: those inside, and with `captured` those on the
  // geometry, which slide.
  void fit(const std::function<double(LocalId)>& tolerance) {
    step_.set_scale(isotropic_);
    StepRules rules = raising_rules(options_.fidelity);
    if (options_.captured) rules.least_edge = kCapturedEdge;
    StepRules room = rules;
    for (int i = 0; i < (options_.captured ? kCaptureRounds : kFitRounds); ++i) {
      const std::vector<std::uint8_t> off = off_the_geometry(tolerance);
      if (set_.choose_if([&](LocalId n) { return off[at(n)] != 0; }) == 0) return;
      const std::int64_t moves = moves_of([&](LocalId n) { return step_.fit(n, rules); }, 0);
      room.target_lengths = i % 2 == 0 ? Star::Target::kUnit : Star::Target::kPresent;
      room.power = i % 2 == 0 ? 1 : 2;
      if (options_.captured) retarget();
      set_.choose_if([&](LocalId n) {
        return (options_.captured ? off[at(n)] == 0 : !on_interface(n)) && shares_hex(n, off);
      });
      const std::int64_t around = moves_of([&](LocalId n) { return step_.newton(n, room); }, far_);
      if (moves == 0 && around == 0) break;
    }
    // Nodes on the geometry that made room may be a little off.
    for (int i = 0; options_.captured && i < kLastFits; ++i) {
      const std::vector<std::uint8_t> off = off_the_geometry(tolerance);
      if (set_.choose_if([&](LocalId n) { return off[at(n)] != 0; }) == 0) return;
      if (moves_of([&](LocalId n) { return step_.fit(n, rules); }, 0) == 0) break;
    }
  }
  // Marks the interface nodes, ghosts included, that are farther than this from the geometry.
  [[nodiscard]] std::vector<std::uint8_t> off_the_geometry(
      const std::function<double(LocalId)>& tolerance) const {
    std::vector<std::uint8_t> off(mesh_.position.size(), 0);
    for (LocalId n = 0; n < mesh_.nodes(); ++n)
      off[at(n)] = on_interface(n) && set_.owned(n) &&
                   norm(step_.towards_geometry(n, mesh_.position[at(n)])) > tolerance(n);
    mesh_.node_exchange.copy_to_ghosts(off);
    return off;
  }
  [[nodiscard]] bool shares_hex(LocalId node, const std::vector<std::uint8_t>& marked) const {
    for (const std::int32_t item : set_.around()[node])
      for (const LocalId other : mesh_.hexes[at(item / 8)])
        if (marked[at(other)]) return true;
    return false;
  }
  void report_deviation() const {
    double farthest = 0;
    std::int64_t beyond = 0;
    for (LocalId n = 0; n < mesh_.nodes(); ++n) {
      if (!on_interface(n) || !set_.owned(n)) continue;
      const double distance = norm(step_.towards_geometry(n, mesh_.position[at(n)]));
      farthest = std::max(farthest, distance / size_at(n));
      beyond += distance > step_.limit(n, options_.max_deviation);
    }
    log_.line("Interface nodes are at most {:f} cells from the geometry", set_.comm().max(farthest));
    beyond = set_.comm().sum(beyond);
    if (beyond > 0)
      log_.line("WARNING: {} interface nodes are farther from it than {:g}{}", beyond, options_.max_deviation,
                options_.deviation_by_level && !mesh_.node_unit.empty() ? " at level 0" : "");
  }

  // The Jacobian can fail inside a hex whose corners are fine: more shape for the nodes of such hexes. Tells
  // whether none is left; otherwise those left count as hexes of quality 0.
  bool unfold() {
    double fidelity = options_.fidelity;
    for (int i = 0;; ++i, fidelity *= 0.5) {
      const std::int64_t folded = set_.mark_folded();
      if (folded == 0 || i == kUnfoldSweeps) return folded == 0;
      log_.line("Unfolding Iter: {}, hexes with a Jacobian that is not positive inside: {}", i + 1, folded);
      StepRules rules = raising_rules(fidelity);
      if (i % 2 == 0)
        rules.power = 2;
      else
        rules.target_lengths = Star::Target::kUnit;  // folds go with edges of very unequal length
      set_.choose(kFolded, i / 2, false);
      sweep(rules, far_);
    }
  }
  [[nodiscard]] StepRules raising_rules(double fidelity) const {
    StepRules rules;
    rules.least_quality = floor_;
    rules.least_move = 1e-4;
    rules.farthest = farthest_;
    rules.release_curves_below = options_.release_curves_below;
    rules.penalty = fidelity;
    return rules;
  }
  void report_target(Aim& aim, std::int64_t moves) const {
    ++aim.done;
    if (!aim.tells) return;
    const ActiveSet::Worst w = set_.worst(aim.target);
    log_.line("Coloring Opt Iter: {}, Num Smooths: {}, Num bad: {}, Num poor: {}, Min SJ: {:f}", aim.done,
              moves, w.not_positive, w.below_target, w.quality);
  }

  HexMesh& mesh_;
  Geometry own_targets_;  // of nodes that are held on the geometry
  const Geometry& geometry_;
  const SmoothOptions& options_;
  const Log& log_;
  ActiveSet set_;
  NodeStep step_;
  Vec3 per_axis_, isotropic_;
  double size_ = 1;           // of a cell at level 0
  double farthest_;           // limit of deviation of the present phase
  double far_ = kFar;         // length of a move that the neighbours shall hear of
  double floor_;              // quality that no step may fall below
  bool never_folds_ = false;  // no step may fold a hex inside
};

}  // namespace

void smooth_mesh(HexMesh& mesh, const Geometry& geometry, const SmoothOptions& options, const Log& log) {
  Phases(mesh, geometry, options, log).run();
}

}  // namespace sculpt
