#include "input/stl.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <filesystem>
#include <set>

#include "input/deck_grid.hpp"
#include "input/shape_source.hpp"
#include "input/text_file.hpp"
#include "sculpt/facets/facet_surfaces.hpp"
#include "sculpt/facets/faceted_solid.hpp"

namespace sculpt {
namespace {

constexpr std::size_t kMostNamed = 20;  // files in a message

void refuse_missing(const std::vector<StlFile>& files) {
  std::string names;
  std::size_t missing = 0;
  const StlFile* first = nullptr;
  std::set<std::string> seen;
  for (const StlFile& file : files) {
    if (!seen.insert(file.path).second || ::access(file.path.c_str(), R_OK) == 0) continue;
    if (first == nullptr) first = &file;
    if (missing++ < kMostNamed) names += fmt::format("{}'{}'", names.empty() ? "" : ", ", file.path);
  }
  if (missing == 0) return;
  if (missing > kMostNamed) names += fmt::format(" and {} more", missing - kMostNamed);
  if (missing == 1) throw Error(fmt::format("{}: cannot open {}: no such file", first->named_by, names));
  throw Error(
      fmt::format("{}: cannot open {} of {} STL files: {}", first->named_by, missing, seen.size(), names));
}

FacetMesh read_facets(const StlFile& file) {
  std::error_code error;
  if (std::filesystem::file_size(file.path, error) == 0 && !error) return {};
  const TextFile text_file(file.path, file.named_by);
  std::string text(static_cast<std::size_t>(text_file.size()), '\0');
  text_file.read(0, text);
  FacetMesh mesh = parse_stl(text, file.path);
  for (Vec3& vertex : mesh.vertices) vertex = file.placement.placed(vertex);
  return mesh;
}

void warn(const Log& log, const std::string& path, const Defects& defects, const char* what) {
  if (defects.count == 0) return;
  const std::string facet = defects.facet > 0 ? fmt::format("facet {} ", defects.facet) : "";
  log.line("WARNING: {}: {} {}; the first: {}at ({:g}, {:g}, {:g})", path, defects.count, what, facet,
           defects.place.x, defects.place.y, defects.place.z);
}

void report(const Log& log, const std::string& path, const FacetMesh& mesh, const FacetReport& found) {
  const Box box = bounds_of(mesh);
  const FacetSizes sizes = sizes_of(mesh);
  log.line("STL summary: fn={} vertices={} Triangles={}", path, 3 * mesh.triangles.size(),
           mesh.triangles.size());
  log.line("  Distinct vertices    {}", mesh.vertices.size());
  log.line("  Components           {}", found.components);
  log.line("  Bounding Box Min     {:f} {:f} {:f}", box.lo.x, box.lo.y, box.lo.z);
  log.line("  Bounding Box Max     {:f} {:f} {:f}", box.hi.x, box.hi.y, box.hi.z);
  log.line("  Side Length Min Max  {:g} {:g}", sizes.side_min, sizes.side_max);
  log.line("  Angle Min Max        {:g} {:g}", sizes.angle_min, sizes.angle_max);
  log.line("  Area Min Max         {:g} {:g}", sizes.area_min, sizes.area_max);
  log.line("  Enclosed Volume      {:g}", sizes.volume);
  warn(log, path, found.degenerate, "degenerate facets dropped");
  warn(log, path, found.duplicate, "duplicate facets dropped");
  warn(log, path, found.welded, "vertices welded to one close by");
  warn(log, path, found.flipped, "facets flipped, so that all normals point outwards");
  warn(log, path, found.open, "open edges: the surface has holes, cells there may get wrong materials");
  warn(log, path, found.non_manifold, "edges of more than two facets");
  warn(log, path, found.inconsistent, "edges whose facets cannot be oriented alike");
  if (found.open.count + found.non_manifold.count + found.inconsistent.count == 0)
    log.line(" Diatom STL All Sides Properly matched");
}

// Whether anything is made of the smooth surfaces of solids.
bool wants_surfaces(const Deck& deck) {
  return deck.capture == kCaptureCurves || deck.gen_sidesets == kSidesetsGeometricSurfaces ||
         deck.gen_sidesets == kSidesetsGeometricSidesets || deck.gen_sidesets == kSidesetsInputMeshAndStl;
}

// On rank 0: the surface of a file, repaired.
FacetMesh repaired(const StlFile& file, const Log& log) {
  FacetMesh mesh = read_facets(file);
  const FacetReport found = repair(mesh);
  if (mesh.triangles.empty())
    log.line("WARNING: {}: '{}' has no facets and fills nothing", file.named_by, file.path);
  else
    report(log, file.path, mesh, found);
  return mesh;
}

// What divide_facets() found on rank 0, and the names of the parts.
void share_surfaces(const Comm& comm, FacetMesh& mesh) {
  comm.broadcast(mesh.surface, 0);
  comm.broadcast(mesh.corner, 0);
  comm.broadcast(mesh.part, 0);
  mesh.surfaces = static_cast<std::int32_t>(comm.max(std::int64_t{mesh.surfaces}));
  mesh.corners = static_cast<std::int32_t>(comm.max(std::int64_t{mesh.corners}));
  std::vector<std::string> names = mesh.part_names;
  const std::int64_t parts = comm.max(static_cast<std::int64_t>(names.size()));
  names.resize(static_cast<std::size_t>(parts));
  for (std::string& name : names) name = comm.broadcast(std::move(name), 0);
  mesh.part_names = std::move(names);
}

}  // namespace

std::vector<StlSolid> open_solids(const Comm& comm, const Deck& deck, const std::vector<StlFile>& files,
                                  const Log& log) {
  collectively(comm, "looking for STL files", [&] {
    if (comm.rank() == 0) refuse_missing(files);
  });
  const bool divides = wants_surfaces(deck);
  std::vector<StlSolid> solids;
  for (const StlFile& file : files) {
    FacetMesh mesh;
    collectively(comm, "reading " + file.path, [&] {
      if (comm.rank() != 0) return;
      mesh = repaired(file, log);
      if (!divides) return;
      divide_facets(mesh, deck.capture_angle);
      log.line("  Smooth surfaces      {}, corners {}", mesh.surfaces, mesh.corners);
    });
    comm.broadcast(mesh.vertices, 0);
    comm.broadcast(mesh.triangles, 0);
    if (divides) share_surfaces(comm, mesh);
    collectively(comm, "indexing the facets of " + file.path, [&] {
      StlSolid& solid = solids.emplace_back();
      if (mesh.triangles.empty()) return;
      solid.shape = std::make_unique<FacetedSolid>(mesh);
      if (divides) solid.facets = std::make_shared<const FacetMesh>(std::move(mesh));
    });
  }
  return solids;
}

std::unique_ptr<MaterialSource> open_stl(const Comm& comm, const Deck& deck, const Log& log,
                                         const std::optional<Box>& overlay) {
  log.line("initializing geometry...");
  Grid grid;
  collectively(comm, "opening " + deck.stl_file,
               [&] { grid = overlay ? grid_over(*overlay, 1) : deck_box_grid(deck, "stl_file"); });
  std::vector<StlSolid> solids = open_solids(comm, deck, {{deck.stl_file, "stl_file"}}, log);
  if (solids[0].shape == nullptr)
    throw AgreedError(fmt::format("stl_file: '{}' has no facets, expected a closed surface of at least four",
                                  deck.stl_file));
  std::vector<MaterialShape> shapes;
  shapes.push_back({std::move(solids[0].shape), 1, std::move(solids[0].facets), "stl"});
  return shape_source(deck, std::move(shapes), std::move(grid), log);
}

}  // namespace sculpt
