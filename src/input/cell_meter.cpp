#include "input/cell_meter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sculpt/geom/hex.hpp"

namespace sculpt {
namespace {

constexpr double kAbsent = 1e-12;    // smaller fractions are rounding
constexpr std::size_t kDeepest = 3;  // halvings of a cell in which surfaces have edges

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

// What boxes and hexes have in common: the axis or parameter of the steepest lines, halves in all directions,
// volumes.
const Box& bounds_of(const Box& cell) { return cell; }
std::size_t steepest_in(const Shape& shape, const Box& cell) {
  return shape.steepest_axis(0.5 * (cell.lo + cell.hi));
}
std::size_t steepest_in(const Shape& shape, const HexCorners& hex) {
  return steepest_parameter(shape, centre_of(hex), mean_edges(hex));
}
double volume_of(const Box& cell) {
  const Vec3 size = cell.hi - cell.lo;
  return size.x * size.y * size.z;
}
double volume_of(const HexCorners& hex) { return hex_volume(hex); }

// Bit d of `which`: the upper half along axis d.
Box eighth_of(const Box& cell, std::size_t which) {
  const Vec3 centre = 0.5 * (cell.lo + cell.hi);
  Box eighth = cell;
  for (std::size_t d = 0; d < 3; ++d) ((which >> d & 1) != 0 ? eighth.lo : eighth.hi)[d] = centre[d];
  return eighth;
}
HexCorners eighth_of(const HexCorners& hex, std::size_t which) {
  const HexLines lines(hex, 0);
  HexCorners eighth;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const std::array<bool, 3> at{corner % 4 == 1 || corner % 4 == 2, corner % 4 >= 2, corner >= 4};
    std::array<double, 3> t{};
    for (std::size_t d = 0; d < 3; ++d)
      t[d] = 0.5 * (static_cast<double>(which >> d & 1) + (at[d] ? 1.0 : 0.0));
    const HexLines::Line line = lines.at(t[1], t[2]);
    eighth[corner] = line.from + t[0] * line.step;
  }
  return eighth;
}

}  // namespace

CellMeter::BoxLines CellMeter::lines_of(const Box& cell, std::size_t axis) { return {cell, axis}; }
HexLines CellMeter::lines_of(const HexCorners& hex, std::size_t axis) { return HexLines(hex, axis); }

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
  measure_cell(cell, candidates, fractions);
}

void CellMeter::measure(const HexCorners& hex, std::span<const std::int32_t> candidates,
                        Fractions& fractions) {
  measure_cell(hex, candidates, fractions);
}

template <class Cell>
void CellMeter::measure_cell(const Cell& cell, std::span<const std::int32_t> candidates,
                             Fractions& fractions) {
  select(bounds_of(cell), candidates);
  if (const auto sole = sole_selected()) {
    fractions.add(*sole, 1.0);
  } else {
    shares_.clear();
    add_shares(cell, 0, 1);
    append(fractions);
  }
  fractions.end_cell();
}

// Adds what the selected shapes have of a part of the cell, got by halving it `depth` times. `weight`: of the
// part in the cell.
template <class Cell>
void CellMeter::add_shares(const Cell& part, std::size_t depth, double weight) {
  look_into(bounds_of(part));
  const auto steepest = [&](const Shape& s) { return steepest_in(s, part); };
  const std::optional<double> share = share_of_one(part);
  if (!share && depth < kDeepest && is_rough(bounds_of(part), steepest)) {
    add_eighths(part, depth + 1, weight);
    return;
  }
  if (share) {
    covered_[0] = *share;
  } else if (const auto lines = lines_of(part, steepest(shape(0))); is_gentle(bounds_of(part), steepest)) {
    // The error of the midpoint rule falls with the square of the number of lines: two numbers cancel it.
    const std::size_t most = depth < 2 ? 16 : 8;
    sample(lines, most, 4.0 / 3);
    sample(lines, most / 2, -1.0 / 3);
  } else {
    sample(lines, std::max<std::size_t>(kMostLines >> depth, 6), 1);
  }
  double covered = 0;
  if (share && filled_) covered_[1] = 1 - *share;
  for (std::size_t s = 0; s < reaching_.size(); ++s) {
    shares_.push_back({material(s), weight * covered_[s]});
    covered += covered_[s];
  }
  shares_.push_back({outside_, filled_ ? 0.0 : weight * std::max(0.0, 1 - covered)});
}

template <class Cell>
void CellMeter::add_eighths(const Cell& part, std::size_t depth, double weight) {
  std::vector<std::int32_t> candidates;
  for (const std::size_t s : reaching_) candidates.push_back(static_cast<std::int32_t>(s));
  const double per_volume = weight / volume_of(part);
  for (std::size_t e = 0; e < 8; ++e) {
    const Cell eighth = eighth_of(part, e);
    const double share = per_volume * volume_of(eighth);
    select(bounds_of(eighth), candidates);
    if (const auto sole = sole_selected())
      shares_.push_back({*sole, share});
    else
      add_shares(eighth, depth, share);
  }
}

std::optional<std::int32_t> CellMeter::sole_material(const Box& cell,
                                                     std::span<const std::int32_t> candidates) {
  select(cell, candidates);
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
void CellMeter::select(const Box& bounds, std::span<const std::int32_t> candidates) {
  reaching_.clear();
  filled_ = false;
  for (const std::int32_t c : candidates) {
    const auto at = static_cast<std::size_t>(c);
    if (shapes_[at].shape->misses(bounds)) continue;
    reaching_.push_back(at);
    filled_ = shapes_[at].shape->contains(bounds);
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

// Whether lines along one axis measure the shapes badly: where edges end faces, and where a face may lie
// along the lines of another shape.
template <class Steepest>
bool CellMeter::is_rough(const Box& bounds, const Steepest& steepest) const {
  const std::size_t axis = steepest(shape(0));
  for (std::size_t s = 0; s + (filled_ ? 1 : 0) < reaching_.size(); ++s) {
    if (shape(s).has_edges(bounds) || (shape(s).is_costly() && !shape(s).is_gentle(bounds))) return true;
    if (steepest(shape(s)) != axis && shape(s).has_edges(shape(s).bounds())) return true;
  }
  return false;
}

// The share of the only shape that has a surface in the cell, where it can tell that. Another one may fill
// the rest.
std::optional<double> CellMeter::share_of_one(const Box& cell) const {
  if (reaching_.size() != (filled_ ? 2 : 1)) return std::nullopt;
  return shape(0).share_of(cell);
}
std::optional<double> CellMeter::share_of_one(const HexCorners&) { return std::nullopt; }

// Gets the shapes that count ready to be asked for their chords.
void CellMeter::look_into(const Box& bounds) {
  covered_.assign(reaching_.size(), 0.0);
  local_.clear();
  if (storage_.size() < reaching_.size()) storage_.resize(reaching_.size());
  for (std::size_t s = 0; s < reaching_.size(); ++s)
    local_.push_back(&shapes_[reaching_[s]].shape->within(bounds, storage_[s]));
}

// Adds the weighted shares of the cell that the shapes get of lines x lines lines along the axis.
void CellMeter::sample(const BoxLines& box, std::size_t lines, double weight) {
  const Box& cell = box.cell;
  const std::size_t axis = box.axis;
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
