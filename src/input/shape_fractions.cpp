#include "input/shape_fractions.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>

#include "input/cell_meter.hpp"
#include "input/point_meter.hpp"
#include "input/shape_index.hpp"
#include "sculpt/base/even_parts.hpp"
#include "sculpt/geom/trilinear.hpp"

namespace sculpt {
namespace {

class ShapeField final : public MaterialField {
 public:
  ShapeField(std::shared_ptr<const std::vector<InsertedShape>> shapes, const Grid& grid, std::int32_t outside,
             FractionMethod method)
      : shapes_(std::move(shapes)),
        index_(*shapes_, space_of(grid), 0),
        method_(method),
        meter_(*shapes_, outside),
        points_(*shapes_, outside) {}

  void measure(const Box& box, Fractions& out) override {
    index_.find(box, candidates_);
    if (method_ == FractionMethod::kPoints)
      points_.measure(box, candidates_, out);
    else
      meter_.measure(box, candidates_, out);
  }
  [[nodiscard]] std::optional<std::int32_t> sole_material(const Box& box) override {
    index_.find(box, candidates_);
    return meter_.sole_material(box, candidates_);
  }

 private:
  std::shared_ptr<const std::vector<InsertedShape>> shapes_;
  ShapeIndex index_;
  FractionMethod method_;
  CellMeter meter_;
  PointMeter points_;
  std::vector<std::int32_t> candidates_;
};

class ShapeHexField final : public HexField {
 public:
  ShapeHexField(std::shared_ptr<const std::vector<InsertedShape>> shapes, const Grid& grid,
                std::int32_t outside, FractionMethod method)
      : shapes_(std::move(shapes)),
        index_(*shapes_, space_of(grid), 0),
        method_(method),
        meter_(*shapes_, outside),
        points_(*shapes_, outside) {}

  void measure(const HexCorners& hex, Fractions& out) override {
    if (method_ == FractionMethod::kPoints)
      measure(hex, points_, out);
    else
      measure(hex, meter_, out);
  }

 private:
  template <class Meter>
  void measure(const HexCorners& hex, Meter& meter, Fractions& out) {
    const Box bounds = bounds_of(hex);
    index_.find(bounds, candidates_);
    if (is_box(hex, bounds, {}))
      meter.measure(bounds, candidates_, out);
    else
      meter.measure(hex, candidates_, out);
  }

  std::shared_ptr<const std::vector<InsertedShape>> shapes_;
  ShapeIndex index_;
  FractionMethod method_;
  CellMeter meter_;
  PointMeter points_;
  std::vector<std::int32_t> candidates_;
};

Box cell_box(const Grid& grid, const Index3& cell) {
  Box box;
  for (std::size_t d = 0; d < 3; ++d) {
    box.lo[d] = grid.planes[d][static_cast<std::size_t>(cell[d])];
    box.hi[d] = grid.planes[d][static_cast<std::size_t>(cell[d]) + 1];
  }
  return box;
}

// Appends one list after the other, and frees them.
Fractions joined(std::vector<Fractions>& parts) {
  Fractions all = std::move(parts[0]);
  std::size_t cells = 0, entries = 0;
  for (const Fractions& part : parts) {
    cells += part.offset.size();
    entries += part.material.size();
  }
  all.reserve(all.offset.size() + cells, all.material.size() + entries);
  for (std::size_t p = 1; p < parts.size(); ++p) {
    const Fractions part = std::move(parts[p]);
    const auto before = static_cast<std::int64_t>(all.material.size());
    for (std::size_t c = 1; c < part.offset.size(); ++c) all.offset.push_back(before + part.offset[c]);
    all.material.insert(all.material.end(), part.material.begin(), part.material.end());
    all.value.insert(all.value.end(), part.value.begin(), part.value.end());
  }
  return all;
}

}  // namespace

std::unique_ptr<MaterialField> shape_field(std::shared_ptr<const std::vector<InsertedShape>> shapes,
                                           const Grid& grid, std::int32_t outside, FractionMethod method) {
  return std::make_unique<ShapeField>(std::move(shapes), grid, outside, method);
}

std::unique_ptr<HexField> shape_hex_field(std::shared_ptr<const std::vector<InsertedShape>> shapes,
                                          const Grid& grid, std::int32_t outside, FractionMethod method) {
  return std::make_unique<ShapeHexField>(std::move(shapes), grid, outside, method);
}

Fractions measure_cells(const Grid& grid, const IndexBox& box, const MakeField& make_field, int threads) {
  constexpr std::int64_t kPartsPerThread = 16;  // some cells take much longer than others
  const auto parts = static_cast<int>(std::clamp(box.size(), std::int64_t{1}, threads * kPartsPerThread));
  const EvenParts cells{box.size(), parts};
  std::vector<Fractions> measured(static_cast<std::size_t>(parts));
  std::vector<std::exception_ptr> failed(static_cast<std::size_t>(threads));
  std::atomic<int> next{0};
  const auto work = [&](int thread) {
    try {
      const auto field = make_field();
      for (int part = next++; part < parts; part = next++) {
        Fractions& fractions = measured[static_cast<std::size_t>(part)];
        fractions.reserve(cells.size(part), cells.size(part) + cells.size(part) / 8);
        for (std::int64_t c = cells.begin(part); c < cells.end(part); ++c)
          field->measure(cell_box(grid, box.cell(c)), fractions);
      }
    } catch (...) {
      failed[static_cast<std::size_t>(thread)] = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    for (int t = 1; t < threads; ++t) others.emplace_back(work, t);
    work(0);
  }
  for (const std::exception_ptr& failure : failed)
    if (failure) std::rethrow_exception(failure);
  return joined(measured);
}

}  // namespace sculpt
