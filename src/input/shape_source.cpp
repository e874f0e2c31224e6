#include "input/shape_source.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "input/geometry_grid.hpp"
#include "input/principal_axes.hpp"
#include "input/shape_fractions.hpp"
#include "input/shape_index.hpp"
#include "input/shape_surfaces.hpp"
#include "input/stl.hpp"
#include "sculpt/facets/facet_features.hpp"
#include "sculpt/geom/solids.hpp"

namespace sculpt {
namespace {

constexpr double kFeatureReach = 3;  // in cells

class ShapeSource final : public MaterialSource {
 public:
  ShapeSource(const Deck& deck, std::vector<MaterialShape> shapes, std::vector<FacetedSolid*> solids,
              Grid grid, const std::optional<std::array<Vec3, 3>>& axes, const Log& log)
      : grid_(std::move(grid)),
        axes_(axes),
        periodic_(deck.periodic),
        solids_(std::move(solids)),
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
    const std::vector<Box> regions = regions_of(wanted);
    if (comm.size() > 1) hand_out(comm, solids_, regions);
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
  [[nodiscard]] std::optional<std::array<Vec3, 3>> axes() const override { return axes_; }

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
  // Where each rank will ask of the shapes: near the cells it wants. Without cells that anyone wants, and
  // when space is periodic or solids are turned, everywhere.
  [[nodiscard]] std::vector<Box> regions_of(std::span<const IndexBox> wanted) const {
    constexpr std::int64_t kMargin = 3;  // cells, for the surfaces near those of the rank
    constexpr double kFar = std::numeric_limits<double>::max();
    const bool anywhere =
        periodic_ || axes_ ||
        std::all_of(wanted.begin(), wanted.end(), [](const IndexBox& w) { return w.empty(); });
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
  std::optional<std::array<Vec3, 3>> axes_;  // of the grid in space
  bool periodic_;
  std::vector<FacetedSolid*> solids_;  // those among the shapes and parts of them
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

// A grid to find shapes by within the bounds of an overlay mesh: cubes, about eight per shape.
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

Box bounds_of(const std::vector<MaterialShape>& shapes) {
  Box all = shapes.front().shape->bounds();
  for (const MaterialShape& s : shapes) {
    const Box b = s.shape->bounds();
    for (std::size_t d = 0; d < 3; ++d) {
      all.lo[d] = std::min(all.lo[d], b.lo[d]);
      all.hi[d] = std::max(all.hi[d], b.hi[d]);
    }
  }
  return all;
}

bool overlap(const Box& a, const Box& b) {
  for (std::size_t d = 0; d < 3; ++d)
    if (a.lo[d] > b.hi[d] || b.lo[d] > a.hi[d]) return false;
  return true;
}

// Packages, which are shapes in a row, that lie outside of the space of the mesh.
void warn_of_packages_outside(const std::vector<MaterialShape>& shapes, const std::string& path,
                              const Box& space, const Log& log) {
  constexpr std::int64_t kMostWarnings = 20;
  std::int64_t outside = 0;
  for (std::size_t first = 0; first < shapes.size();) {
    std::size_t last = first;
    bool reaches = false;
    for (; last < shapes.size() && shapes[last].line == shapes[first].line; ++last)
      reaches = reaches || overlap(shapes[last].shape->bounds(), space);
    if (!reaches && ++outside <= kMostWarnings)
      log.line("WARNING: {}, line {}: package '{}' fills nothing: it lies outside the box of the grid", path,
               shapes[first].line, shapes[first].package);
    first = last;
  }
  if (outside > kMostWarnings)
    log.line("WARNING: {}: {} more packages fill nothing", path, outside - kMostWarnings);
}

// Collective. The principal axes of what the shapes fill; rank 0 knows all of it.
std::array<Vec3, 3> axes_of(const Comm& comm, std::vector<MaterialShape>& shapes) {
  std::vector<Vec3> axes(3);
  collectively(comm, "finding the principal axes", [&] {
    if (comm.rank() != 0) return;
    const Box bounds = bounds_of(shapes);
    std::vector<InsertedShape> inserted;
    for (MaterialShape& s : shapes) inserted.push_back({std::move(s.shape), 0});
    const ShapeIndex index(inserted, bounds, 0);
    const std::array<Vec3, 3> found = principal_axes(bounds, [&](const Vec3& p) {
      const auto near = index.around(p);
      return std::any_of(near.begin(), near.end(), [&](std::int32_t s) {
        return index.is_near(s, p) && inserted[at(s)].shape->contains({p, p});
      });
    });
    for (std::size_t s = 0; s < shapes.size(); ++s) shapes[s].shape = std::move(inserted[s].shape);
    axes.assign(found.begin(), found.end());
  });
  comm.broadcast(axes, 0);
  return {axes[0], axes[1], axes[2]};
}

// Collective. Turns the shapes so that these directions become those of the coordinates.
void turn(const Comm& comm, std::vector<MaterialShape>& shapes, const std::array<Vec3, 3>& axes) {
  Frame frame;
  for (std::size_t d = 0; d < 3; ++d) frame.axis[d] = {axes[0][d], axes[1][d], axes[2][d]};
  for (MaterialShape& s : shapes) {
    auto* solid = dynamic_cast<FacetedSolid*>(s.shape.get());
    if (solid == nullptr) {
      s.shape = moved(std::move(s.shape), frame);
      continue;
    }
    collectively(comm, "turning facets", [&] {
      if (comm.rank() == 0) solid->turn(axes);
    });
    std::vector<Box> bounds{solid->bounds()};
    comm.broadcast(bounds, 0);
    if (comm.rank() != 0) *solid = FacetedSolid(bounds[0]);
    if (!s.facets) continue;
    FacetMesh mesh = *s.facets;
    turn_facets(mesh, axes);
    s.facets = std::make_shared<const FacetMesh>(std::move(mesh));
  }
}

}  // namespace

std::unique_ptr<MaterialSource> shape_source(const Comm& comm, const Deck& deck, const std::string& option,
                                             std::vector<MaterialShape> shapes,
                                             std::vector<FacetedSolid*> solids,
                                             const std::optional<Box>& overlay, const Log& log) {
  std::optional<std::array<Vec3, 3>> axes;
  if (deck.align && !overlay) {
    axes = axes_of(comm, shapes);
    turn(comm, shapes, *axes);
    const auto& [x, y, z] = *axes;
    log.line("The grid is turned: its axes are ({:g}, {:g}, {:g}), ({:g}, {:g}, {:g}) and ({:g}, {:g}, {:g})",
             x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z);
  }
  std::unique_ptr<MaterialSource> source;
  collectively(comm, "making the grid of " + option, [&] {
    Grid grid = overlay ? grid_over(*overlay, shapes.size()) : geometry_grid(deck, option, bounds_of(shapes));
    if (!overlay) tell_geometry_grid(deck, grid, log);
    if (!deck.diatom_file.empty())
      warn_of_packages_outside(shapes, deck.diatom_file, overlay ? *overlay : space_of(grid), log);
    source =
        std::make_unique<ShapeSource>(deck, std::move(shapes), std::move(solids), std::move(grid), axes, log);
  });
  return source;
}

}  // namespace sculpt
