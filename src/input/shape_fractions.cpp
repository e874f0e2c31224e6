#include "input/shape_fractions.hpp"

#include "input/cell_meter.hpp"
#include "input/shape_index.hpp"
#include "sculpt/geom/trilinear.hpp"

namespace sculpt {
namespace {

class ShapeField final : public MaterialField {
 public:
  ShapeField(std::shared_ptr<const std::vector<InsertedShape>> shapes, const Grid& grid, std::int32_t outside)
      : shapes_(std::move(shapes)), index_(*shapes_, space_of(grid), 0), meter_(*shapes_, outside) {}

  void measure(const Box& box, Fractions& out) override {
    index_.find(box, candidates_);
    meter_.measure(box, candidates_, out);
  }
  [[nodiscard]] std::optional<std::int32_t> sole_material(const Box& box) override {
    index_.find(box, candidates_);
    return meter_.sole_material(box, candidates_);
  }

 private:
  std::shared_ptr<const std::vector<InsertedShape>> shapes_;
  ShapeIndex index_;
  CellMeter meter_;
  std::vector<std::int32_t> candidates_;
};

class ShapeHexField final : public HexField {
 public:
  ShapeHexField(std::shared_ptr<const std::vector<InsertedShape>> shapes, const Grid& grid,
                std::int32_t outside)
      : shapes_(std::move(shapes)), index_(*shapes_, space_of(grid), 0), meter_(*shapes_, outside) {}

  void measure(const HexCorners& hex, Fractions& out) override {
    const Box bounds = bounds_of(hex);
    index_.find(bounds, candidates_);
    if (is_box(hex, bounds, {}))
      meter_.measure(bounds, candidates_, out);
    else
      meter_.measure(hex, candidates_, out);
  }

 private:
  std::shared_ptr<const std::vector<InsertedShape>> shapes_;
  ShapeIndex index_;
  CellMeter meter_;
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

}  // namespace

std::unique_ptr<MaterialField> shape_field(std::shared_ptr<const std::vector<InsertedShape>> shapes,
                                           const Grid& grid, std::int32_t outside) {
  return std::make_unique<ShapeField>(std::move(shapes), grid, outside);
}

std::unique_ptr<HexField> shape_hex_field(std::shared_ptr<const std::vector<InsertedShape>> shapes,
                                          const Grid& grid, std::int32_t outside) {
  return std::make_unique<ShapeHexField>(std::move(shapes), grid, outside);
}

Fractions measure_cells(const Grid& grid, const IndexBox& box, MaterialField& field) {
  Fractions fractions;
  const auto cells = static_cast<std::size_t>(box.size());
  fractions.reserve(cells, cells + cells / 8);
  for (std::int64_t c = 0; c < box.size(); ++c) field.measure(cell_box(grid, box.cell(c)), fractions);
  return fractions;
}

}  // namespace sculpt
