#include "input/shape_source.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "input/shape_fractions.hpp"
#include "input/shape_surfaces.hpp"
#include "input/stl.hpp"

namespace sculpt {
namespace {

class ShapeSource final : public MaterialSource {
 public:
  ShapeSource(const Deck& deck, std::vector<MaterialShape> shapes, Grid grid, const Log& log)
      : grid_(std::move(grid)), periodic_(deck.periodic), log_(log) {
    for (const MaterialShape& shape : shapes) table_.block_id.push_back(shape.material);
    std::sort(table_.block_id.begin(), table_.block_id.end());
    table_.block_id.erase(std::unique(table_.block_id.begin(), table_.block_id.end()), table_.block_id.end());
    add_void(deck);
    auto inserted = std::make_shared<std::vector<InsertedShape>>();
    for (const MaterialShape& shape : shapes)
      if (auto* solid = dynamic_cast<FacetedSolid*>(shape.shape.get())) solids_.push_back(solid);
    for (MaterialShape& shape : shapes) inserted->push_back({std::move(shape.shape), dense(shape.material)});
    shapes_ = std::move(inserted);
  }

  [[nodiscard]] const Grid& grid() const override { return grid_; }

  [[nodiscard]] MaterialData read(const Comm& comm, std::span<const IndexBox> wanted) override {
    const std::vector<Box> regions = regions_of(wanted);
    if (comm.size() > 1) hand_out(comm, solids_, regions);
    log_.line("inserting volume fractions...");
    MaterialData data;
    data.table = table_;
    collectively(comm, "inserting volume fractions", [&] {
      const auto field = shape_field(shapes_, grid_, outside_);
      data.fractions = measure_cells(grid_, wanted[static_cast<std::size_t>(comm.rank())], *field);
    });
    return data;
  }

  [[nodiscard]] bool is_data() const override { return false; }

  [[nodiscard]] std::unique_ptr<MaterialField> field(Fractions, const IndexBox&) const override {
    return shape_field(shapes_, grid_, outside_);
  }

  [[nodiscard]] std::unique_ptr<HexField> hex_field(Fractions, const IndexBox&, std::int32_t) const override {
    return shape_hex_field(shapes_, grid_, outside_);
  }

  [[nodiscard]] ExactSurface exact_surface() const override { return surfaces_of(shapes_, grid_); }

 private:
  // Where each rank will ask of the shapes: near the cells it wants. Without cells that anyone wants, and
  // when space is periodic, everywhere.
  [[nodiscard]] std::vector<Box> regions_of(std::span<const IndexBox> wanted) const {
    constexpr std::int64_t kMargin = 3;  // cells, for the surfaces near those of the rank
    constexpr double kFar = std::numeric_limits<double>::max();
    const bool anywhere =
        periodic_ || std::all_of(wanted.begin(), wanted.end(), [](const IndexBox& w) { return w.empty(); });
    std::vector<Box> regions;
    for (const IndexBox& w : wanted) {
      Box box{{-kFar, -kFar, -kFar}, {kFar, kFar, kFar}};
      for (std::size_t d = 0; d < 3 && !anywhere; ++d) {
        const auto plane = [&](std::int64_t i) {
          return grid_.planes[d][static_cast<std::size_t>(std::clamp<std::int64_t>(i, 0, grid_.cells[d]))];
        };
        const double margin = static_cast<double>(kMargin) * grid_.cell_size()[d];
        box.lo[d] = plane(w.lo[d]) - margin;
        box.hi[d] = plane(w.hi[d]) + margin;
      }
      regions.push_back(box);
    }
    return regions;
  }

  [[nodiscard]] std::int32_t dense(std::int64_t id) const {
    const auto at = std::lower_bound(table_.block_id.begin(), table_.block_id.end(), id);
    return static_cast<std::int32_t>(at - table_.block_id.begin());
  }

  // A meshed void may join a material of the user's. A void that is not meshed stays apart: void_mat names
  // the block of the meshed void only.
  void add_void(const Deck& deck) {
    std::vector<std::int64_t>& ids = table_.block_id;
    std::int64_t id = deck.given("void_mat") ? deck.void_mat : ids.back() + 1;
    const bool taken = std::binary_search(ids.begin(), ids.end(), id);
    if (taken && !deck.mesh_void) id = ids.back() + 1;
    if (!taken || !deck.mesh_void) {
      ids.insert(std::lower_bound(ids.begin(), ids.end(), id), id);
      table_.void_material = dense(id);
    }
    outside_ = dense(id);
  }

  Grid grid_;
  bool periodic_;
  std::vector<FacetedSolid*> solids_;  // those among the shapes
  Log log_;
  MaterialTable table_;
  std::shared_ptr<const std::vector<InsertedShape>> shapes_;
  std::int32_t outside_ = 0;  // dense index of what no shape covers
};

}  // namespace

// A grid to find shapes by: cubes, about eight per shape.
Grid grid_over(const Box& overlay, std::size_t shapes) {
  constexpr double kCellsPerShape = 8, kMostPerAxis = 1024;
  const Vec3 size = overlay.hi - overlay.lo;
  const double width = std::cbrt(size.x * size.y * size.z /
                                 (kCellsPerShape * static_cast<double>(std::max<std::size_t>(shapes, 1))));
  Index3 cells{};
  for (std::size_t d = 0; d < 3; ++d) {
    check(size[d] > 0, "the bounds of an overlay mesh are no box");
    cells[d] = static_cast<std::int64_t>(std::clamp(std::ceil(size[d] / width), 1.0, kMostPerAxis));
  }
  return box_grid(cells, overlay.lo, overlay.hi);
}

std::unique_ptr<MaterialSource> shape_source(const Deck& deck, std::vector<MaterialShape> shapes, Grid grid,
                                             const Log& log) {
  return std::make_unique<ShapeSource>(deck, std::move(shapes), std::move(grid), log);
}

}  // namespace sculpt
