#include "sculpt/smooth/smooth.hpp"

#include <algorithm>
#include <cmath>

#include "smooth/active_set.hpp"
#include "smooth/laplacian.hpp"
#include "smooth/node_step.hpp"

namespace sculpt {
namespace {

constexpr int kUntangleSweeps = 60, kBulkSweeps = 3, kUntangleRound = 15;
constexpr int kRaiseAttempts = 3, kUnfoldSweeps = 6;
constexpr int kAttempts = 3;      // of all phases, each from another place
constexpr double kFolded = 1e-6;  // the quality that marks a folded hex is below this
constexpr double kFar = 0.05;     // a move that makes the neighbours worth another visit, in cells
constexpr double kMargin = 0.05;  // hexes this little above the target are raised as well

class Phases {
 public:
  Phases(HexMesh& mesh, const Geometry& geometry, const SmoothOptions& options, const Log& log)
      : mesh_(mesh),
        geometry_(geometry),
        options_(options),
        log_(log),
        set_(mesh),
        step_(mesh, set_.around(), geometry) {
    const Vec3& h = mesh.cell_size;
    per_axis_ = {1 / h.x, 1 / h.y, 1 / h.z};
    const double size = h.x == h.y && h.y == h.z ? h.x : std::cbrt(h.x * h.y * h.z);
    isotropic_ = {1 / size, 1 / size, 1 / size};
  }

  void run() {
    log_.line("Smoothing {} hexes on {} processors", set_.comm().sum(owned_hexes()), set_.comm().size());
    laplacian_passes(mesh_, set_.around(), geometry_, options_.laplacian_passes, log_);
    set_.refresh_all_quality();
    for (int attempt = 1; attempt <= kAttempts; ++attempt) {
      untangle();
      improve();
      raise_to_target();
      if (unfold()) break;
      if (attempt < kAttempts) relax_everything(attempt);
    }
  }

 private:
  [[nodiscard]] std::int64_t owned_hexes() const {
    return std::count(mesh_.layer.begin(), mesh_.layer.end(), std::uint8_t{0});
  }

  std::int64_t sweep(const StepRules& rules, double far) {
    return set_.sweep([&](LocalId n) { return step_.newton(n, rules); }, far);
  }

  void report(const char* phase, int iteration) const {
    const ActiveSet::Worst w = set_.worst(options_.target);
    log_.line("{} Iter: {},  Num bad: {}, Num poor: {}, Min SJ: {:f}", phase, iteration, w.not_positive,
              w.below_02, w.quality);
  }

  // Positive determinants everywhere: minimise the regularised energy while the regularisation falls with the
  // worst determinant. Determinants do not care about a scaling of the axes, so cells count as cubes here.
  void untangle() {
    step_.set_scale(per_axis_);
    StepRules rules;
    rules.guarded = false;
    rules.target_lengths = Star::Target::kUnit;
    rules.least_move = 1e-5;
    rules.release_curves_below = options_.release_curves_below;
    rules.penalty = options_.fidelity;
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
      sweep(rules, kFar);
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
            return true;
          },
          kFar);
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
    std::int64_t first = 0;
    for (int i = 0; i < options_.improve_sweeps; ++i) {
      const std::int64_t nodes = set_.choose(options_.improve_below, 1, i > 0);
      if (i == 0) first = nodes;
      if (nodes == 0 || (i > 0 && nodes < first / 50)) break;
      const std::int64_t moves = sweep(rules, kFar);
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
    int round = 0;
    double fidelity = options_.fidelity;
    for (int attempt = 0; attempt < kRaiseAttempts && set_.worst(options_.target).below_target > 0;
         ++attempt) {
      steepen(fidelity, round);
      climb(round);
      fidelity *= 0.1;
    }
    if (set_.worst(options_.target).below_target > 0)
      log_.line("WARNING: Smoothing terminated. Unable to make additional improvement.");
  }
  void steepen(double fidelity, int& round) {
    StepRules rules = raising_rules(fidelity);
    for (rules.power = 2; rules.power <= 8; rules.power *= 2) {
      rules.penalty *=
          std::pow(1 / options_.target, rules.power / 4.0);  // keeps pace with the energy at the target
      for (int i = 0; i < 4 && round < options_.target_rounds; ++i) {
        if (set_.choose(options_.target + kMargin, 1, false) == 0) return;
        const std::int64_t moves = sweep(rules, kFar);
        report_target(++round, moves);
        if (moves == 0) break;
      }
    }
  }
  void climb(int& round) {
    StepRules rules = raising_rules(0);
    rules.power = 4;
    for (int i = 0; i < 24 && round < options_.target_rounds; ++i) {
      if (set_.choose(options_.target, 0, false) == 0) return;
      const std::int64_t moves =
          set_.sweep([&](LocalId n) { return step_.climb(n, rules.least_edge); }, kFar);
      report_target(++round, moves);
      if (moves == 0) return;
      if (i % 4 == 3) {
        set_.choose(options_.target, 1, false);
        sweep(rules, kFar);
      }
    }
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
      sweep(rules, kFar);
    }
  }
  [[nodiscard]] StepRules raising_rules(double fidelity) const {
    StepRules rules;
    rules.least_quality = options_.target;
    rules.least_move = 1e-4;
    rules.release_curves_below = options_.release_curves_below;
    rules.penalty = fidelity;
    return rules;
  }
  void report_target(int round, std::int64_t moves) const {
    const ActiveSet::Worst w = set_.worst(options_.target);
    log_.line("Coloring Opt Iter: {}, Num Smooths: {}, Num bad: {}, Num poor: {}, Min SJ: {:f}", round, moves,
              w.not_positive, w.below_target, w.quality);
  }

  HexMesh& mesh_;
  const Geometry& geometry_;
  const SmoothOptions& options_;
  const Log& log_;
  ActiveSet set_;
  NodeStep step_;
  Vec3 per_axis_, isotropic_;
};

}  // namespace

void smooth_mesh(HexMesh& mesh, const Geometry& geometry, const SmoothOptions& options, const Log& log) {
  Phases(mesh, geometry, options, log).run();
}

}  // namespace sculpt
