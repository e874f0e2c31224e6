#include "adapt/periodic_field.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace sculpt {
namespace {

constexpr double kSliver = 1e-9;  // of a box: thinner pieces are rounding

double volume(const Box& box) {
  const Vec3 size = box.hi - box.lo;
  return size.x * size.y * size.z;
}

}  // namespace

void PeriodicField::cut(const Box& box, std::size_t axis) {
  if (axis == 3) {
    pieces_.push_back(box);
    return;
  }
  if (!periodic_[axis]) return cut(box, axis + 1);
  const double lo = grid_.planes[axis].front(), hi = grid_.planes[axis].back(), period = hi - lo;
  const double size = box.hi[axis] - box.lo[axis];
  const auto with = [&](double from, double to) {
    if (!(to - from > kSliver * size)) return;
    Box piece = box;
    piece.lo[axis] = from;
    piece.hi[axis] = to;
    cut(piece, axis + 1);
  };
  if (size >= period) return with(lo, hi);
  const double move = period * std::floor((0.5 * (box.lo[axis] + box.hi[axis]) - lo) / period);
  const double from = box.lo[axis] - move, to = box.hi[axis] - move;  // its middle is inside
  with(std::max(from, lo), std::min(to, hi));
  if (from < lo) with(from + period, hi);
  if (to > hi) with(lo, to - period);
}

void PeriodicField::cut(const Box& box) {
  pieces_.clear();
  cut(box, 0);
}

void PeriodicField::measure(const Box& box, Fractions& out) {
  cut(box);
  if (pieces_.size() == 1) return field_.measure(pieces_[0], out);
  std::map<std::int32_t, double> share;
  double whole = 0;
  for (const Box& piece : pieces_) {
    Fractions part;
    field_.measure(piece, part);
    whole += volume(piece);
    for (std::size_t e = 0; e < part.material.size(); ++e)
      share[part.material[e]] += volume(piece) * part.value[e];
  }
  for (const auto& [material, value] : share) out.add(material, std::min(1.0, value / whole));
  out.end_cell();
}

std::optional<std::int32_t> PeriodicField::sole_material(const Box& box) {
  cut(box);
  const std::optional<std::int32_t> sole = field_.sole_material(pieces_[0]);
  for (std::size_t i = 1; sole && i < pieces_.size(); ++i)
    if (field_.sole_material(pieces_[i]) != sole) return std::nullopt;
  return sole;
}

}  // namespace sculpt
