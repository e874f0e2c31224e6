#include "input/cell_meter.hpp"

#include <algorithm>

namespace sculpt {
namespace {

constexpr double kAbsent = 1e-12;  // smaller fractions are rounding

double line(const Box& cell, std::size_t axis, std::size_t l, std::size_t lines) {
  const double t = (static_cast<double>(l) + 0.5) / static_cast<double>(lines);
  return cell.lo[axis] + t * (cell.hi[axis] - cell.lo[axis]);
}

}  // namespace

void CellMeter::measure(const Box& cell, std::span<const std::int32_t> candidates, Fractions& fractions) {
  if (const auto sole = sole_material(cell, candidates)) {
    fractions.add(*sole, 1.0);
  } else {
    covered_.assign(reaching_.size(), 0.0);
    const std::size_t axis = shape(0).steepest_axis(0.5 * (cell.lo + cell.hi));
    if (is_gentle(cell, axis)) {
      // The error of the midpoint rule falls with the square of the number of lines: two numbers cancel it.
      sample(cell, axis, 16, 4.0 / 3);
      sample(cell, axis, 8, -1.0 / 3);
    } else {
      sample(cell, axis, kMostLines, 1);
    }
    append(fractions);
  }
  fractions.end_cell();
}

std::optional<std::int32_t> CellMeter::sole_material(const Box& cell,
                                                     std::span<const std::int32_t> candidates) {
  select(cell, candidates);
  if (reaching_.empty()) return outside_;
  const std::int32_t first = material(0);
  if (!filled_ && first != outside_) return std::nullopt;
  for (std::size_t s = 1; s < reaching_.size(); ++s)
    if (material(s) != first) return std::nullopt;
  return first;
}

// The shapes that count: those that reach the cell, up to the first that fills it.
void CellMeter::select(const Box& cell, std::span<const std::int32_t> candidates) {
  reaching_.clear();
  filled_ = false;
  for (const std::int32_t c : candidates) {
    const auto at = static_cast<std::size_t>(c);
    if (shapes_[at].shape->misses(cell)) continue;
    reaching_.push_back(at);
    filled_ = shapes_[at].shape->contains(cell);
    if (filled_) return;
  }
}

// Few lines suffice where the surfaces turn little within the cell and all of them cross the lines steeply. A
// shape that fills the cell has no surface there.
bool CellMeter::is_gentle(const Box& cell, std::size_t axis) const {
  constexpr double kCells = 4;  // across a shape
  const Vec3 centre = 0.5 * (cell.lo + cell.hi);
  for (std::size_t s = 0; s + (filled_ ? 1 : 0) < reaching_.size(); ++s) {
    if (shape(s).steepest_axis(centre) != axis) return false;
    const Box bounds = shape(s).bounds();
    for (std::size_t d = 0; d < 3; ++d)
      if (bounds.hi[d] - bounds.lo[d] < kCells * (cell.hi[d] - cell.lo[d])) return false;
  }
  return true;
}

// Adds the weighted shares of the cell that the shapes get of lines x lines lines along the axis.
void CellMeter::sample(const Box& cell, std::size_t axis, std::size_t lines, double weight) {
  const std::size_t axis_u = (axis + 1) % 3, axis_v = (axis + 2) % 3;
  const double from = cell.lo[axis], to = cell.hi[axis];
  Row v;
  for (std::size_t l = 0; l < lines; ++l) v[l] = line(cell, axis_v, l, lines);
  length_.assign(reaching_.size(), Row{});
  lo_.resize(reaching_.size());
  hi_.resize(reaching_.size());
  for (std::size_t l = 0; l < lines; ++l) {
    const double u = line(cell, axis_u, l, lines);
    for (std::size_t s = 0; s < reaching_.size(); ++s)
      shape(s).chords(axis, u, {v.data(), lines}, {lo_[s].data(), lines}, {hi_[s].data(), lines});
    if (reaching_.size() <= 2)
      add_row(from, to, lines);
    else
      for (std::size_t column = 0; column < lines; ++column) share_line(from, to, column);
  }
  const double per_length = weight / (static_cast<double>(lines * lines) * (to - from));
  for (std::size_t s = 0; s < reaching_.size(); ++s) {
    double length = 0;
    for (std::size_t column = 0; column < lines; ++column) length += length_[s][column];
    covered_[s] += length * per_length;
  }
}

// One or two shapes, all lines of a row side by side: the second gets its chord less what it shares with the
// first.
void CellMeter::add_row(double from, double to, std::size_t lines) {
  const double *const lo = lo_[0].data(), *const hi = hi_[0].data();
  double* const length = length_[0].data();
  for (std::size_t l = 0; l < lines; ++l) {
    const double start = lo[l] > from ? lo[l] : from, end = hi[l] < to ? hi[l] : to;
    length[l] += end > start ? end - start : 0.0;
  }
  if (reaching_.size() < 2) return;
  const double *const lo2 = lo_[1].data(), *const hi2 = hi_[1].data();
  double* const length2 = length_[1].data();
  for (std::size_t l = 0; l < lines; ++l) {
    const double start = lo2[l] > from ? lo2[l] : from, end = hi2[l] < to ? hi2[l] : to;
    const double start_both = lo[l] > start ? lo[l] : start, end_both = hi[l] < end ? hi[l] : end;
    const double both = end_both > start_both ? end_both - start_both : 0.0;
    length2[l] += end > start ? (end - start) - both : 0.0;
  }
}

// Deals the line out: each shape takes what is left of its chord.
void CellMeter::share_line(double from, double to, std::size_t column) {
  left_.assign(1, {from, to});
  for (std::size_t s = 0; s < reaching_.size() && !left_.empty(); ++s) {
    const double lo = lo_[s][column], hi = hi_[s][column];
    if (!(lo < hi)) continue;
    next_.clear();
    for (const Piece& piece : left_) {
      const double start = std::max(piece.from, lo), end = std::min(piece.to, hi);
      if (!(start < end)) {
        next_.push_back(piece);
        continue;
      }
      length_[s][column] += end - start;
      if (piece.from < start) next_.push_back({piece.from, start});
      if (end < piece.to) next_.push_back({end, piece.to});
    }
    left_.swap(next_);
  }
}

// Turns the shares into fractions by material, ascending, whose sum is 1.
void CellMeter::append(Fractions& fractions) {
  shares_.clear();
  double covered = 0;
  for (std::size_t s = 0; s < reaching_.size(); ++s) {
    shares_.push_back({material(s), covered_[s]});
    covered += covered_[s];
  }
  shares_.push_back({outside_, filled_ ? 0.0 : std::max(0.0, 1 - covered)});
  std::stable_sort(shares_.begin(), shares_.end(),
                   [](const Share& a, const Share& b) { return a.material < b.material; });
  std::size_t kept = 0;
  for (std::size_t s = 0; s < shares_.size(); ++s) {
    if (kept > 0 && shares_[kept - 1].material == shares_[s].material)
      shares_[kept - 1].value += shares_[s].value;
    else
      shares_[kept++] = shares_[s];
  }
  shares_.resize(kept);
  double sum = 0;
  for (const Share& share : shares_)
    if (share.value > kAbsent) sum += share.value;
  for (const Share& share : shares_)
    if (share.value > kAbsent) fractions.add(share.material, share.value / sum);
}

}  // namespace sculpt
