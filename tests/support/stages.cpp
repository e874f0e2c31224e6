#include "support/stages.hpp"

#include <cmath>

#include "pipeline/interface_geometry.hpp"
#include "pipeline/layers.hpp"
#include "sculpt/contour/contour.hpp"
#include "sculpt/distribute/cartesian.hpp"
#include "sculpt/pillow/pillow.hpp"
#include "sculpt/vfrac/fractions.hpp"
#include "support/mesh_checks.hpp"

namespace sculpt::test {
Overlay overlay(const Comm& comm, const Case& input, int layers) {
  CartesianParts parts = cut_grid(input.grid.cells, comm.size(), {0, 0, 0});
  parts.periodic = input.periodic;
  Overlay o{lattice_mesh(comm, input.grid, parts, layers), {}};
  o.fractions = with_ghosts(o.cells, fractions_in(input, parts.owned(comm.rank())));
  assign_materials(o.cells, o.fractions, face_neighbours(o.cells));
  return o;
}
Overlay overlay(const Case& input) { return overlay(Comm::self(), input); }

HexMesh lattice(const Index3& cells) {
  return overlay(voxels(cells, std::vector<std::int32_t>(static_cast<std::size_t>(whole(cells).size()), 0)))
      .cells;
}

Overlay filtered(const Comm& comm, const Case& input, int layers) {
  Overlay o = overlay(comm, input, layers);
  (void)filter_materials(o.cells, o.fractions, face_neighbours(o.cells), NodeHexes(o.cells));
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
  Overlay o = overlay(comm, input, options.layers.ghost_layers());
  HexMesh& cells = o.cells;
  note("assign", cells);
  const FaceNeighbours neighbours = face_neighbours(cells);
  const NodeHexes around(cells);
  (void)filter_materials(cells, o.fractions, neighbours, around);
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
  LayeredMesh layered = add_layers(comm, cells, neighbours, drop, faces, deviation_weights(cells, faces),
                                   options.layers, Log());
  note("pillow", layered.mesh);
  SmoothOptions volume_smoothing = options.smoothing;
  volume_smoothing.fidelity = input.pure ? 1 : 2.5;
  const bool published = volume_smoothing.method == OptimisationMethod::kPublished;
  if (published || volume_smoothing.hold_on_geometry || std::isfinite(volume_smoothing.max_deviation))
    hold(layered.geometry,
         {cells, faces, crossings, grid_position, smoothing.exact, published && input.pure});
  const auto smooth = [&](LayeredMesh& l) { smooth_mesh(l.mesh, l.geometry, volume_smoothing, options.log); };
  smooth(layered);
  note("smooth", layered.mesh);
  if (options.layers.curves) {
    add_curve_layers(comm, layered, options.layers,
                     options.layers.smooth_after ? smooth : std::function<void(LayeredMesh&)>{}, Log());
    note("pillow curves", layered.mesh);
  }
  result.pillows = layered.pillows;
  result.geometry = std::move(layered.geometry);
  result.mesh = std::move(layered.mesh);
  return result;
}

}  // namespace sculpt::test
