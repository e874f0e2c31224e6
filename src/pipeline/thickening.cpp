#include "pipeline/thickening.hpp"

#include <algorithm>
#include <cmath>

#include "sculpt/base/types.hpp"

namespace sculpt {
namespace {

constexpr int kTrials = 7;
constexpr double kCloseEnough =
    0.01;  // relative error of volume; the rest is small enough for correct_volumes()
constexpr double kVolumePerArea = 1.2;  // gained per value, measured
constexpr double kLargestStep = 0.5;

double worst_error(const std::vector<Thickening>& lines, const std::vector<double>& target,
                   const ThickeningTrial& trial, bool can_grow_only) {
  double worst = 0;
  for (const Thickening& line : lines) {
    const std::size_t m = at(line.material);
    if (!line.automatic || target[m] <= 0) continue;
    const double error = (trial.volume[m] - target[m]) / target[m];
    // Too large with nothing added: no value helps.
    if (can_grow_only && error > 0 && line.value == 0) continue;
    worst = std::max(worst, std::fabs(error));
  }
  return worst;
}

// Inverse of the derivative of volumes by values, brought up to date by what each step gained (Broyden's good
// method).
class Inverse {
 public:
  explicit Inverse(std::size_t size) : size_(size), entry_(size * size, 0) {}
  void set_diagonal(std::size_t k, double value) { entry_[k * size_ + k] = value; }
  [[nodiscard]] std::vector<double> times(const std::vector<double>& v) const {
    std::vector<double> product(size_, 0);
    for (std::size_t i = 0; i < size_; ++i)
      for (std::size_t j = 0; j < size_; ++j) product[i] += entry_[i * size_ + j] * v[j];
    return product;
  }
  void update(const std::vector<double>& step, const std::vector<double>& gained) {
    const std::vector<double> expected = times(gained);
    std::vector<double> row(size_, 0);  // step^T times the inverse
    double scale = 0, square = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      scale += step[i] * expected[i];
      square += step[i] * step[i];
      for (std::size_t j = 0; j < size_; ++j) row[j] += step[i] * entry_[i * size_ + j];
    }
    if (scale <= 0.1 * square) return;  // volumes hardly followed, or the wrong way: nothing to learn
    for (std::size_t i = 0; i < size_; ++i)
      for (std::size_t j = 0; j < size_; ++j)
        entry_[i * size_ + j] += (step[i] - expected[i]) * row[j] / scale;
  }

 private:
  std::size_t size_;
  std::vector<double> entry_;
};

}  // namespace

ThickeningResult find_thickening(std::vector<Thickening>& lines, const std::vector<double>& target,
                                 const std::function<ThickeningTrial(const std::vector<Thickening>&)>& run) {
  for (Thickening& line : lines)
    if (line.automatic) line.value = 0;
  std::vector<std::size_t> searched;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (lines[i].automatic) searched.push_back(i);
  ThickeningResult result;
  ThickeningTrial trial = run(lines);
  std::vector<Thickening> best = lines;
  double best_error = worst_error(lines, target, trial, true);
  Inverse inverse(searched.size());
  for (std::size_t k = 0; k < searched.size(); ++k)
    inverse.set_diagonal(k,
                         1 / (kVolumePerArea * std::max(trial.area[at(lines[searched[k]].material)], 1.0)));
  for (result.trials = 1; result.trials < kTrials && worst_error(lines, target, trial, true) > kCloseEnough;
       ++result.trials) {
    std::vector<double> missing, step(searched.size()), gained;
    for (const std::size_t i : searched)
      missing.push_back(target[at(lines[i].material)] - trial.volume[at(lines[i].material)]);
    const std::vector<double> full = inverse.times(missing);
    for (std::size_t k = 0; k < searched.size(); ++k) {
      double& value = lines[searched[k]].value;
      const double now = value;
      value = std::clamp(value + std::clamp(full[k], -kLargestStep, kLargestStep), 0.0, 1.0);
      step[k] = value - now;
    }
    const ThickeningTrial last = std::move(trial);
    trial = run(lines);
    for (const std::size_t i : searched)
      gained.push_back(trial.volume[at(lines[i].material)] - last.volume[at(lines[i].material)]);
    inverse.update(step, gained);
    const double error = worst_error(lines, target, trial, true);
    if (error < best_error) {
      best_error = error;
      best = lines;
    }
  }
  bool is_best = true;
  for (std::size_t i = 0; i < lines.size(); ++i) is_best = is_best && lines[i].value == best[i].value;
  if (!is_best) {
    lines = best;
    trial = run(lines);
  }
  result.error = worst_error(lines, target, trial, false);
  return result;
}

}  // namespace sculpt
