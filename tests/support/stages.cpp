#include "support/stages.hpp"

#include <cmath>

#include "pipeline/interface_geometry.hpp"
#include "sculpt/contour/contour.hpp"
#include "sculpt/distribute/cartesian.hpp"
#include "sculpt/pillow/pillow.hpp"
#include "sculpt/vfrac/fractions.hpp"
#include "support/mesh_checks.hpp"

namespace sculpt::test {
namespace {

constexpr double kFirstOffset = 0.3, kSecondOffset = 0.5;  // those of the program

Pillowed pillow_cells(const Comm& comm, const HexMesh& cells, const std::vector<std::uint8_t>& drop,
                      bool surfaces) {
  std::vector<std::int32_t> label = cells.material;
  for (std::size_t c = 0; c < label.size(); ++c)
    if (drop[c]) label[c] = -1;
  const Pillowed first = pillow(comm, cells, label, drop, kFirstOffset);
  if (!surfaces) return first;
  const std::vector<std::uint8_t> keep(first.mesh.hexes.size(), 0);
  return stacked(first, pillow(comm, first.mesh, surface_labels(first.mesh), keep, kSecondOffset));
}

}  // namespace

Overlay overlay(const Comm& comm, const Case& input, int layers) {
  const CartesianParts parts = cut_grid(input.grid.cells, comm.size(), {0, 0, 0});
  Overlay o{lattice_mesh(comm, input.grid, parts, layers),
            fractions_in(input, parts.ghosted(comm.rank(), layers))};
  assign_materials(o.cells, o.fractions, face_neighbours(o.cells));
  return o;
}
Overlay overlay(const Case& input) { return overlay(Comm::self(), input); }

Overlay filtered(const Comm& comm, const Case& input, int layers) {
  Overlay o = overlay(comm, input, layers);
  (void)resolve_non_manifold(o.cells, o.fractions, face_neighbours(o.cells), NodeHexes(o.cells));
  follow_assignment(o.fractions, o.cells.material);
  return o;
}
Overlay filtered(const Case& input) { return filtered(Comm::self(), input); }

StagesResult run_stages(const Comm& comm, const Case& input, const StageOptions& options) {
  StagesResult result;
  const auto note = [&](const char* stage, const HexMesh& mesh) {
    result.checksums.push_back({stage, checksum(comm, mesh)});
    const std::string problem = ghost_problem(mesh);
    if (!problem.empty() && result.ghosts.empty())
      result.ghosts = std::string("after ") + stage + ": " + problem;
  };
  Overlay o = overlay(comm, input, options.pillow_surfaces ? 3 : 2);
  HexMesh& cells = o.cells;
  note("assign", cells);
  const FaceNeighbours neighbours = face_neighbours(cells);
  const NodeHexes around(cells);
  (void)resolve_non_manifold(cells, o.fractions, neighbours, around);
  note("filter", cells);
  follow_assignment(o.fractions, cells.material);

  const Interfaces faces = trace_interfaces(cells, neighbours);
  for (const InterfaceQuad& q : faces.quads) result.quads += cells.layer[at(q.cell[0])] == 0;
  const std::vector<Crossing> crossings = edge_crossings(cells, faces, o.fractions, around);
  std::vector<Vec3> grid_position;
  for (const LocalId n : faces.nodes) grid_position.push_back(cells.position[at(n)]);
  place_nodes(cells, faces, crossings);
  note("contour", cells);
  InterfaceSmoothing smoothing = options.interfaces;
  if (!input.pure && smoothing.projection == SurfaceProjection::kOff)
    smoothing.projection = SurfaceProjection::kInterface;
  smooth_interface(cells, faces, crossings, grid_position, smoothing);
  note("smooth interfaces", cells);

  std::vector<std::uint8_t> drop(cells.hexes.size());
  for (std::size_t c = 0; c < drop.size(); ++c) {
    drop[c] = cells.material[c] == options.void_material;
    result.cells += cells.layer[c] == 0 && !drop[c];
  }
  result.cells = comm.sum(result.cells);
  Pillowed pillowed = pillow_cells(comm, cells, drop, options.pillow_surfaces);
  note("pillow", pillowed.mesh);
  SmoothOptions volume_smoothing = options.smoothing;
  volume_smoothing.fidelity = input.pure ? 1 : 2.5;
  Geometry geometry = interface_geometry(pillowed, cells, faces, deviation_weights(cells, faces));
  const bool published = volume_smoothing.method == OptimisationMethod::kPublished;
  if (published || volume_smoothing.hold_on_geometry || std::isfinite(volume_smoothing.max_deviation))
    hold(geometry, pillowed,
         {cells, faces, crossings, grid_position, smoothing.exact, published && input.pure});
  smooth_mesh(pillowed.mesh, geometry, volume_smoothing, options.log);
  result.geometry = std::move(geometry);
  note("smooth", pillowed.mesh);
  result.mesh = std::move(pillowed.mesh);
  return result;
}

}  // namespace sculpt::test
