#include "input/stl.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <set>

#include "input/geometry_grid.hpp"
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
  const char* reason = "";
  std::set<std::string> seen;
  for (const StlFile& file : files) {
    if (!seen.insert(file.path).second || ::access(file.path.c_str(), R_OK) == 0) continue;
    if (first == nullptr) {
      first = &file;
      reason = std::strerror(errno);
    }
    if (missing++ < kMostNamed) names += fmt::format("{}'{}'", names.empty() ? "" : ", ", file.path);
  }
  if (missing == 0) return;
  if (missing > kMostNamed) names += fmt::format(" and {} more", missing - kMostNamed);
  if (missing == 1) throw Error(fmt::format("{}: cannot open {}: {}", first->named_by, names, reason));
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

// The smooth surfaces of a mesh, by the numbers that capture_side takes: from `before` + 1.
void tell_surfaces(const FacetMesh& mesh, std::int64_t before, const Log& log) {
  constexpr std::int32_t kMostTold = 50;
  struct Surface {
    std::int64_t facets = 0;
    Vec3 sum;  // of the middles of facets
  };
  std::vector<Surface> surfaces(at(mesh.surfaces));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Surface& s = surfaces[at(mesh.surface[t])];
    ++s.facets;
    for (const LocalId v : mesh.triangles[t]) s.sum += (1.0 / 3) * mesh.vertices[at(v)];
  }
  log.line("  Smooth surfaces      {}, corners {}", mesh.surfaces, mesh.corners);
  for (std::int32_t s = 0; s < std::min(mesh.surfaces, kMostTold); ++s) {
    const Vec3 middle = (1 / static_cast<double>(surfaces[at(s)].facets)) * surfaces[at(s)].sum;
    log.line("    {}: {} facets around ({:g}, {:g}, {:g})", before + s + 1, surfaces[at(s)].facets, middle.x,
             middle.y, middle.z);
  }
  if (mesh.surfaces > kMostTold) log.line("    and {} more", mesh.surfaces - kMostTold);
}

// A mesh of rank 0, divided into its surfaces.
void share(const Comm& comm, FacetMesh& mesh) {
  comm.broadcast(mesh.vertices, 0);
  comm.broadcast(mesh.triangles, 0);
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
  std::int64_t told = 0;                        // surfaces
  std::vector<FacetMesh> meshes(files.size());  // where their surfaces are asked for
  std::vector<StlSolid> solids(files.size());
  std::vector<Box> bounds;  // of each file that has facets
  std::vector<std::int64_t> facets;
  collectively(comm, "reading STL files", [&] {
    if (comm.rank() != 0) return;
    for (std::size_t f = 0; f < files.size(); ++f) {
      FacetMesh mesh = repaired(files[f], log);
      facets.push_back(static_cast<std::int64_t>(mesh.triangles.size()));
      bounds.push_back(mesh.triangles.empty() ? Box{} : bounds_of(mesh));
      if (facets[f] > 0) solids[f].solid = std::make_unique<FacetedSolid>(mesh);
      if (!divides) continue;
      divide_facets(mesh, deck.capture_angle);
      tell_surfaces(mesh, told, log);
      told += mesh.surfaces;
      meshes[f] = std::move(mesh);
    }
  });
  comm.broadcast(facets, 0);
  comm.broadcast(bounds, 0);
  for (std::size_t f = 0; f < files.size() && comm.rank() != 0; ++f)
    if (facets[f] > 0) solids[f].solid = std::make_unique<FacetedSolid>(bounds[f]);
  for (std::size_t f = 0; f < files.size() && divides; ++f) {
    if (facets[f] == 0) continue;
    share(comm, meshes[f]);
    solids[f].facets = std::make_shared<const FacetMesh>(std::move(meshes[f]));
  }
  return solids;
}

std::vector<FacetedSolid*> solids_of(std::span<const StlSolid> stl) {
  std::vector<FacetedSolid*> solids;
  for (const StlSolid& s : stl)
    if (s.solid) solids.push_back(s.solid.get());
  return solids;
}

void hand_out(const Comm& comm, std::span<FacetedSolid* const> solids, std::span<const Box> regions) {
  constexpr std::size_t kMostBytes = std::size_t{1} << 26;  // of the parts that are on their way at a time
  const std::size_t ranks = regions.size(), parts = solids.size() * ranks;
  std::size_t sent = 0, received = 0;  // parts, by solids and descending ranks; solids
  while (comm.max(std::int64_t{comm.rank() == 0 && sent < parts}) == 1) {
    std::vector<std::vector<char>> to(ranks);
    std::vector<std::vector<std::int64_t>> sizes(ranks);
    collectively(comm, "cutting facets into parts", [&] {
      for (std::size_t bytes = 0; comm.rank() == 0 && sent < parts && bytes < kMostBytes; ++sent) {
        const std::size_t r = ranks - 1 - sent % ranks;
        const std::vector<char> part = solids[sent / ranks]->part(regions[r]);
        to[r].insert(to[r].end(), part.begin(), part.end());
        sizes[r].push_back(static_cast<std::int64_t>(part.size()));
        bytes += part.size();
      }
    });
    const std::vector<char> bytes = comm.all_to_all(to)[0];
    const std::vector<std::int64_t> size = comm.all_to_all(sizes)[0];
    collectively(comm, "receiving facets", [&] {
      std::span<const char> rest = bytes;
      for (const std::int64_t s : size) {
        solids[received++]->become(rest.first(static_cast<std::size_t>(s)));
        rest = rest.subspan(static_cast<std::size_t>(s));
      }
    });
  }
}

std::unique_ptr<MaterialSource> open_stl(const Comm& comm, const Deck& deck, const Log& log,
                                         const std::optional<Box>& overlay) {
  log.line("initializing geometry...");
  collectively(comm, "opening " + deck.stl_file, [&] {
    if (!overlay) check_geometry_grid(deck, "stl_file");
  });
  std::vector<StlSolid> solids = open_solids(comm, deck, {{deck.stl_file, "stl_file"}}, log);
  if (solids[0].solid == nullptr)
    throw AgreedError(fmt::format("stl_file: '{}' has no facets, expected a closed surface of at least four",
                                  deck.stl_file));
  const std::vector<FacetedSolid*> faceted = solids_of(solids);
  std::vector<MaterialShape> shapes;
  shapes.push_back({std::move(solids[0].solid), 1, std::move(solids[0].facets), "stl"});
  return shape_source(comm, deck, "stl_file", std::move(shapes), faceted, overlay, log);
}

}  // namespace sculpt
