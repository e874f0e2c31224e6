#include "input/shape_source.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "input/shape_fractions.hpp"
#include "input/shape_surfaces.hpp"
#include "sculpt/facets/facet_features.hpp"

namespace sculpt {
namespace {

constexpr double kFeatureReach = 3;  // in cells

class ShapeSource final : public MaterialSource {
 public:
  ShapeSource(const Deck& deck, std::vector<MaterialShape> shapes, Grid grid, const Log& log)
      : grid_(std::move(grid)),
        log_(log),
        method_(deck.vfrac_method == kVfracPoints ? FractionMethod::kPoints : FractionMethod::kLines),
        threads_(deck.threads_process) {
    for (const MaterialShape& shape : shapes) table_.block_id.push_back(shape.material);
    std::sort(table_.block_id.begin(), table_.block_id.end());
    table_.block_id.erase(std::unique(table_.block_id.begin(), table_.block_id.end()), table_.block_id.end());
    add_void(deck);
    name_surfaces(shapes);
    auto inserted = std::make_shared<std::vector<InsertedShape>>();
    for (MaterialShape& shape : shapes) {
      inserted->push_back({std::move(shape.shape), dense(shape.material)});
      if (shape.facets) faceted_.push_back({shape.facets, dense(shape.material)});
    }
    shapes_ = std::move(inserted);
  }

  [[nodiscard]] const Grid& grid() const override { return grid_; }

  [[nodiscard]] MaterialData read(const Comm& comm, std::span<const IndexBox> wanted) override {
    log_.line("inserting volume fractions...");
    MaterialData data;
    data.table = table_;
    collectively(comm, "inserting volume fractions", [&] {
      data.fractions = measure_cells(
          grid_, wanted[static_cast<std::size_t>(comm.rank())],
          [this] { return shape_field(shapes_, grid_, outside_, method_); }, threads_);
    });
    return data;
  }

  [[nodiscard]] bool is_data() const override { return false; }

  [[nodiscard]] std::unique_ptr<MaterialField> field(Fractions, const IndexBox&) const override {
    return shape_field(shapes_, grid_, outside_, method_);
  }

  [[nodiscard]] std::unique_ptr<HexField> hex_field(Fractions, const IndexBox&, std::int32_t) const override {
    return shape_hex_field(shapes_, grid_, outside_, method_);
  }

  [[nodiscard]] ExactSurface exact_surface() const override { return surfaces_of(shapes_, grid_); }

  [[nodiscard]] std::shared_ptr<const GeometryFeatures> features() const override {
    if (faceted_.empty()) return nullptr;
    std::vector<FacetFeatures::Solid> solids;
    for (const auto& [mesh, material] : faceted_) solids.push_back({mesh.get(), material});
    return std::make_shared<FacetFeatures>(solids, kFeatureReach * largest(grid_.cell_size()));
  }

  [[nodiscard]] GeometrySurfaces geometry_surfaces() const override {
    GeometrySurfaces surfaces = surfaces_;
    surfaces.nearest = [shape = nearest_shape_of(shapes_, grid_), features = features(),
                        first = first_surface_, of_feature = surface_of_feature_](
                           const Vec3& p, std::int32_t a, std::int32_t b) -> std::optional<std::int32_t> {
      const std::optional<std::int32_t> nearest = shape(p, a, b);
      if (!nearest) return std::nullopt;
      const bool divided = first[at(*nearest) + 1] > first[at(*nearest)] + 1;
      const auto found = divided ? features->nearest(p, a, b) : std::nullopt;
      return found ? of_feature[at(found->surface)] : first[at(*nearest)];
    };
    return surfaces;
  }

 private:
  [[nodiscard]] std::int32_t dense(std::int64_t id) const {
    const auto at = std::lower_bound(table_.block_id.begin(), table_.block_id.end(), id);
    return static_cast<std::int32_t>(at - table_.block_id.begin());
  }

  // Every shape is a surface, or as many as its facets are divided into. Packages of one name are one part,
  // and so are named solids of STL files within them.
  void name_surfaces(const std::vector<MaterialShape>& shapes) {
    std::map<std::string, std::int32_t> part;
    std::vector<std::int64_t> members;
    const auto add = [&](const std::string& name) {
      const auto [found, is_new] =
          part.try_emplace(name, static_cast<std::int32_t>(surfaces_.part_name.size()));
      if (is_new) {
        surfaces_.part_name.push_back(name);
        members.push_back(0);
      }
      surfaces_.part_of_surface.push_back(found->second);
      surfaces_.surface_name.push_back(fmt::format("{} {}", name, ++members[at(found->second)]));
    };
    for (const MaterialShape& shape : shapes) {
      first_surface_.push_back(static_cast<std::int32_t>(surfaces_.surface_name.size()));
      if (!shape.facets) {
        add(shape.package);
        continue;
      }
      for (const std::string& name : names_of_surfaces(*shape.facets, shape.package)) {
        surface_of_feature_.push_back(static_cast<std::int32_t>(surfaces_.surface_name.size()));
        add(name);
      }
    }
    first_surface_.push_back(static_cast<std::int32_t>(surfaces_.surface_name.size()));
  }
  // The solid that each smooth surface begins in: its name, or that of the package.
  [[nodiscard]] static std::vector<std::string> names_of_surfaces(const FacetMesh& mesh,
                                                                  const std::string& package) {
    std::vector<std::string> names(at(mesh.surfaces));
    for (std::size_t t = mesh.triangles.size(); t-- > 0;) {
      const std::string& solid = mesh.part_names[at(mesh.part[t])];
      names[at(mesh.surface[t])] = solid.empty() ? package : solid;
    }
    return names;
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
  Log log_;
  FractionMethod method_;
  int threads_;
  MaterialTable table_;
  std::shared_ptr<const std::vector<InsertedShape>> shapes_;
  struct Faceted {
    std::shared_ptr<const FacetMesh> mesh;
    std::int32_t material;
  };
  std::vector<Faceted> faceted_;
  GeometrySurfaces surfaces_;                // without nearest
  std::vector<std::int32_t> first_surface_;  // per shape, and the number of all
  std::vector<std::int32_t> surface_of_feature_;
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
