#include "input/cell_meter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sculpt {
namespace {

constexpr double kAbsent = 1e-12;  // smaller fractions are rounding

double line(const Box& cell, std::size_t axis, std::size_t l, std::size_t lines) {
  const double t = (static_cast<double>(l) + 0.5) / static_cast<double>(lines);
  return cell.lo[axis] + t * (cell.hi[axis] - cell.lo[axis]);
}

// The parameter of a hex whose lines cross the surface of a shape most steeply.
std::size_t steepest_parameter(const Shape& shape, const Vec3& centre, const std::array<Vec3, 3>& edges) {
  Vec3 normal;
  const std::optional<Vec3> nearest = shape.nearest_on_surface(centre);
  if (nearest) normal = *nearest - centre;
  if (!(largest(normal) > 0)) normal[shape.steepest_axis(centre)] = 1;
  std::size_t steepest = 0;
  for (std::size_t d = 1; d < 3; ++d)
    if (std::fabs(dot(normal, edges[d])) > std::fabs(dot(normal, edges[steepest]))) steepest = d;
  return steepest;
}

}  // namespace

// The lines of a cell that may meet the bounds, by their coordinate on an axis.
CellMeter::Lines CellMeter::lines_between(const Box& cell, std::size_t axis, std::size_t lines,
                                          const Box& bounds) {
  const auto all = static_cast<double>(lines);
  const double per_length = all / (cell.hi[axis] - cell.lo[axis]);
  const double first = std::floor((bounds.lo[axis] - cell.lo[axis]) * per_length - 0.5),
               last = std::ceil((bounds.hi[axis] - cell.lo[axis]) * per_length + 0.5);
  return {static_cast<std::size_t>(std::clamp(first, 0.0, all)),
          static_cast<std::size_t>(std::clamp(last, 0.0, all))};
}

void CellMeter::measure(const Box& cell, std::span<const std::int32_t> candidates, Fractions& fractions) {
  if (const auto sole = sole_material(cell, candidates)) {
    fractions.add(*sole, 1.0);
  } else {
    look_into(cell);
    const Vec3 centre = 0.5 * (cell.lo + cell.hi);
    const auto steepest = [&](const Shape& s) { return s.steepest_axis(centre); };
    const std::size_t axis = steepest(shape(0));
    if (is_gentle(cell, steepest)) {
      // The error of the midpoint rule falls with the square of the number of lines: two numbers cancel it.
      sample(cell, axis, 16, 4.0 / 3);
      sample(cell, axis, 8, -1.0 / 3);
    } else if (const auto share = share_of_one(cell)) {
      covered_[0] = *share;
    } else {
      sample(cell, axis, kMostLines, 1);
    }
    append(fractions);
  }
  fractions.end_cell();
}

void CellMeter::measure(const HexCorners& hex, std::span<const std::int32_t> candidates,
                        Fractions& fractions) {
  const Box bounds = bounds_of(hex);
  select(bounds, candidates, [&](const Shape& s) { return s.contains(bounds); });
  if (const auto sole = sole_selected()) {
    fractions.add(*sole, 1.0);
  } else {
    look_into(bounds);
    const Vec3 centre = centre_of(hex);
    const std::array<Vec3, 3> edges = mean_edges(hex);
    const auto steepest = [&](const Shape& s) { return steepest_parameter(s, centre, edges); };
    const HexLines lines(hex, steepest(shape(0)));
    if (is_gentle(bounds, steepest)) {
      sample(lines, 16, 4.0 / 3);
      sample(lines, 8, -1.0 / 3);
    } else {
      sample(lines, kMostLines, 1);
    }
    append(fractions);
  }
  fractions.end_cell();
}

std::optional<std::int32_t> CellMeter::sole_material(const Box& cell,
                                                     std::span<const std::int32_t> candidates) {
  select(cell, candidates, [&](const Shape& s) { return s.contains(cell); });
  return sole_selected();
}

std::optional<std::int32_t> CellMeter::sole_selected() const {
  if (reaching_.empty()) return outside_;
  const std::int32_t first = material(0);
  if (!filled_ && first != outside_) return std::nullopt;
  for (std::size_t s = 1; s < reaching_.size(); ++s)
    if (material(s) != first) return std::nullopt;
  return first;
}

// The shapes that count: those that reach the cell, up to the first that fills it.
template <class Fills>
void CellMeter::select(const Box& bounds, std::span<const std::int32_t> candidates, const Fills& fills) {
  reaching_.clear();
  filled_ = false;
  for (const std::int32_t c : candidates) {
    const auto at = static_cast<std::size_t>(c);
    if (shapes_[at].shape->misses(bounds)) continue;
    reaching_.push_back(at);
    filled_ = fills(*shapes_[at].shape);
    if (filled_) return;
  }
}

// Few lines suffice where the surfaces turn little within the cell and all of them cross the lines steeply. A
// shape that fills the cell has no surface there.
template <class Steepest>
bool CellMeter::is_gentle(const Box& cell, const Steepest& steepest) const {
  const std::size_t axis = steepest(shape(0));
  for (std::size_t s = 0; s + (filled_ ? 1 : 0) < reaching_.size(); ++s)
    if (steepest(shape(s)) != axis || !shape(s).is_gentle(cell)) return false;
  return true;
}

// The exact share of the only shape that counts.
std::optional<double> CellMeter::share_of_one(const Box& cell) const {
  return reaching_.size() == 1 ? shape(0).share_of(cell) : std::nullopt;
}

// Gets the shapes that count ready to be asked for their chords.
void CellMeter::look_into(const Box& bounds) {
  covered_.assign(reaching_.size(), 0.0);
  local_.clear();
  if (storage_.size() < reaching_.size()) storage_.resize(reaching_.size());
  for (std::size_t s = 0; s < reaching_.size(); ++s)
    local_.push_back(&shapes_[reaching_[s]].shape->within(bounds, storage_[s]));
}

// Adds the weighted shares of the cell that the shapes get of lines x lines lines along the axis.
void CellMeter::sample(const Box& cell, std::size_t axis, std::size_t lines, double weight) {
  const std::size_t axis_u = (axis + 1) % 3, axis_v = (axis + 2) % 3;
  const double from = cell.lo[axis], to = cell.hi[axis];
  Row v;
  for (std::size_t l = 0; l < lines; ++l) v[l] = line(cell, axis_v, l, lines);
  chords_.resize(reaching_.size());
  for (std::size_t s = 0; s < reaching_.size(); ++s) {
    const Box bounds = shape(s).bounds();
    chords_[s].rows = lines_between(cell, axis_u, lines, bounds);
    chords_[s].columns = lines_between(cell, axis_v, lines, bounds);
    chords_[s].length.fill(0);
  }
  for (std::size_t l = 0; l < lines; ++l) {
    const double u = line(cell, axis_u, l, lines);
    in_row_.clear();
    for (std::size_t s = 0; s < reaching_.size(); ++s) {
      if (l < chords_[s].rows.first || l >= chords_[s].rows.last) continue;
      const std::size_t first = chords_[s].columns.first, count = chords_[s].columns.last - first;
      chords_[s].row.begin(lines, first, count);
      shape(s).chords(axis, u, {v.data() + first, count}, chords_[s].row);
      in_row_.push_back(s);
    }
    add_row(from, to, lines);
  }
  const double per_length = weight / (static_cast<double>(lines * lines) * (to - from));
  for (std::size_t s = 0; s < reaching_.size(); ++s) {
    double length = 0;
    for (std::size_t column = 0; column < lines; ++column) length += chords_[s].length[column];
    covered_[s] += length * per_length;
  }
}

// The same of a hex: lengths are volumes, those of the hex along its lines up to the ends of the chords.
void CellMeter::sample(const HexLines& hex, std::size_t lines, double weight) {
  chords_.resize(reaching_.size());
  for (Chords& chords : chords_) chords.length.fill(0);
  double volume = 0;
  for (std::size_t l = 0; l < lines; ++l)
    add_hex_row(hex, (static_cast<double>(l) + 0.5) / static_cast<double>(lines), lines, volume);
  for (std::size_t s = 0; s < reaching_.size(); ++s) {
    double sum = 0;
    for (std::size_t column = 0; column < lines; ++column) sum += chords_[s].length[column];
    covered_[s] += weight * (sum / volume);
  }
}

void CellMeter::add_hex_row(const HexLines& hex, double u, std::size_t lines, double& volume) {
  for (std::size_t l = 0; l < lines; ++l) {
    line_[l] = hex.at(u, (static_cast<double>(l) + 0.5) / static_cast<double>(lines));
    from_[l] = line_[l].from;
    step_[l] = line_[l].step;
    volume += line_[l].volume(1);
  }
  in_row_.clear();
  for (std::size_t s = 0; s < reaching_.size(); ++s) {
    ChordRow& row = chords_[s].row;
    row.begin(lines);
    shape(s).line_chords({from_.data(), lines}, {step_.data(), lines}, row);
    bool any = false;
    for (std::size_t layer = 0; layer < row.layers(); ++layer) {
      const auto [lo, hi] = row.layer(layer);
      for (std::size_t l = 0; l < lines; ++l) {
        const double start = std::max(lo[l], 0.0), end = std::min(hi[l], 1.0);
        const bool meets = start < end;
        lo[l] = meets ? line_[l].volume(start) : 0;
        hi[l] = meets ? line_[l].volume(end) : 0;
        any = any || meets;
      }
    }
    if (any) in_row_.push_back(s);
  }
  if (!in_row_.empty()) add_row(0, std::numeric_limits<double>::max(), lines);
}

// Gives the shapes of the row what they get of it, all lines side by side if possible.
void CellMeter::add_row(double from, double to, std::size_t lines) {
  const auto add_all = [&] {
    for (const std::size_t s : in_row_) add_pieces(chords_[s].row, {from, to}, chords_[s].length);
  };
  if (in_row_.size() <= 2) {
    add_all();
    if (in_row_.size() == 2) {  // the first one keeps what both have
      Chords& second = chords_[in_row_[1]];
      add_common(chords_[in_row_[0]].row, second.row, -1, {from, to}, second.length);
    }
    return;
  }
  Row common{};
  for (std::size_t a = 1; a < in_row_.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      add_common(chords_[in_row_[a]].row, chords_[in_row_[b]].row, 1, {from, to}, common);
  if (std::all_of(common.begin(), common.end(), [](double c) { return c == 0; }))
    add_all();
  else
    for (std::size_t column = 0; column < lines; ++column) share_line({from, to}, column);
}

// Adds to `sum` the length of the pieces within a piece of each line.
void CellMeter::add_pieces(const ChordRow& row, const Piece& piece, Row& sum) {
  const double from = piece.from, to = piece.to;
  for (std::size_t layer = 0; layer < row.layers(); ++layer) {
    const double *const lo = row.lo(layer), *const hi = row.hi(layer);
    for (std::size_t l = 0; l < row.lines(); ++l) {
      const double start = lo[l] > from ? lo[l] : from, end = hi[l] < to ? hi[l] : to;
      sum[l] += end > start ? end - start : 0.0;
    }
  }
}

// Adds, with the sign, the length that the pieces of two shapes have in common within a piece of each line.
void CellMeter::add_common(const ChordRow& a, const ChordRow& b, double sign, const Piece& piece, Row& sum) {
  const double from = piece.from, to = piece.to;
  for (std::size_t i = 0; i < a.layers(); ++i)
    for (std::size_t j = 0; j < b.layers(); ++j) {
      const double *const lo_a = a.lo(i), *const hi_a = a.hi(i);
      const double *const lo_b = b.lo(j), *const hi_b = b.hi(j);
      for (std::size_t l = 0; l < a.lines(); ++l) {
        const double lo = lo_a[l] > lo_b[l] ? lo_a[l] : lo_b[l], hi = hi_a[l] < hi_b[l] ? hi_a[l] : hi_b[l];
        const double start = lo > from ? lo : from, end = hi < to ? hi : to;
        sum[l] += sign * (end > start ? end - start : 0.0);
      }
    }
}

// Deals the line out: each shape takes what is left of its chord.
void CellMeter::share_line(const Piece& whole, std::size_t column) {
  left_.assign(1, whole);
  for (const std::size_t s : in_row_) {
    const ChordRow& row = chords_[s].row;
    for (std::size_t layer = 0; layer < row.layers(); ++layer)
      chords_[s].length[column] += take({row.lo(layer)[column], row.hi(layer)[column]});
  }
}

// Takes the chord out of what is left of the line; the length that there was.
double CellMeter::take(const Piece& chord) {
  if (!(chord.from < chord.to)) return 0;
  double length = 0;
  next_.clear();
  for (const Piece& piece : left_) {
    const double start = std::max(piece.from, chord.from), end = std::min(piece.to, chord.to);
    if (!(start < end)) {
      next_.push_back(piece);
      continue;
    }
    length += end - start;
    if (piece.from < start) next_.push_back({piece.from, start});
    if (end < piece.to) next_.push_back({end, piece.to});
  }
  left_.swap(next_);
  return length;
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
