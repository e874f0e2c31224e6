#include "input/point_meter.hpp"

#include <algorithm>

#include "sculpt/base/types.hpp"
#include "sculpt/geom/trilinear.hpp"

namespace sculpt {
namespace {

// The midpoints of equal parts.
template <std::size_t n>
std::array<double, n> midpoints(double lo, double hi) {
  std::array<double, n> at{};
  for (std::size_t i = 0; i < n; ++i)
    at[i] = lo + (hi - lo) * (static_cast<double>(2 * i + 1) / static_cast<double>(2 * n));
  return at;
}

}  // namespace

void PointMeter::measure(const Box& cell, std::span<const std::int32_t> candidates, Fractions& fractions) {
  const Row x = midpoints<kPerAxis>(cell.lo.x, cell.hi.x);
  const Row y = midpoints<kPerAxis>(cell.lo.y, cell.hi.y), z = midpoints<kPerAxis>(cell.lo.z, cell.hi.z);
  sample(cell, candidates, x,
         [&](const Shape& shape, std::size_t plane) { shape.chords(0, y[plane], z, row_); });
  append(fractions);
}

void PointMeter::measure(const HexCorners& hex, std::span<const std::int32_t> candidates,
                         Fractions& fractions) {
  const Row t = midpoints<kPerAxis>(0, 1);
  const HexLines lines(hex, 0);
  std::array<Vec3, kPerAxis> from, step;
  sample(bounds_of(hex), candidates, t, [&](const Shape& shape, std::size_t plane) {
    for (std::size_t k = 0; k < kPerAxis; ++k) {
      const HexLines::Line line = lines.at(t[plane], t[k]);
      from[k] = line.from;
      step[k] = line.step;
    }
    shape.line_chords(from, step, row_);
  });
  append(fractions);
}

// Gives each point to the first shape that has it. chords: puts into row_ what a shape cuts from the lines of
// a plane; `along`: the points on each of them.
template <class Chords>
void PointMeter::sample(const Box& bounds, std::span<const std::int32_t> candidates, const Row& along,
                        const Chords& chords) {
  material_.fill(kNone);
  for (const std::int32_t c : candidates) {
    const InsertedShape& inserted = shapes_[static_cast<std::size_t>(c)];
    if (inserted.shape->misses(bounds)) continue;
    if (inserted.shape->contains(bounds)) {
      std::replace(material_.begin(), material_.end(), kNone, inserted.material);
      return;
    }
    const Shape& shape = inserted.shape->within(bounds, storage_);
    for (std::size_t plane = 0; plane < kPerAxis; ++plane) {
      row_.begin(kPerAxis);
      chords(shape, plane);
      take(plane, along, inserted.material);
    }
  }
}

void PointMeter::take(std::size_t plane, const Row& along, std::int32_t material) {
  for (std::size_t layer = 0; layer < row_.layers(); ++layer)
    for (std::size_t line = 0; line < kPerAxis; ++line) {
      const double lo = row_.lo(layer)[line], hi = row_.hi(layer)[line];
      if (lo >= hi) continue;
      for (std::size_t i = 0; i < kPerAxis; ++i) {
        std::int32_t& point = material_[(plane * kPerAxis + line) * kPerAxis + i];
        if (point == kNone && along[i] >= lo && along[i] <= hi) point = material;
      }
    }
}

void PointMeter::append(Fractions& fractions) {
  std::replace(material_.begin(), material_.end(), kNone, outside_);
  std::sort(material_.begin(), material_.end());
  for (auto from = material_.begin(); from != material_.end();) {
    const auto to = std::upper_bound(from, material_.end(), *from);
    fractions.add(*from, static_cast<double>(to - from) / kPoints);
    from = to;
  }
  fractions.end_cell();
}

}  // namespace sculpt
