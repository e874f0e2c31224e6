#include "support/stages.hpp"

#include <algorithm>
#include <cmath>

#include "pipeline/interface_geometry.hpp"
#include "pipeline/layers.hpp"
#include "sculpt/brep/exterior.hpp"
#include "sculpt/contour/contour.hpp"
#include "sculpt/distribute/cartesian.hpp"
#include "sculpt/mesh/colour.hpp"
#include "sculpt/mesh/edit.hpp"
#include "sculpt/pillow/pillow.hpp"
#include "sculpt/vfrac/fractions.hpp"
#include "support/mesh_checks.hpp"

namespace sculpt::test {
Overlay overlay(const Comm& comm, const Case& input, int layers) {
  CartesianParts parts = cut_grid(input.grid.cells, comm.size(), {0, 0, 0});
  parts.periodic = input.periodic;
  Overlay o{lattice_mesh(comm, input.grid, parts, layers), {}};
  o.fractions = with_ghosts(o.cells, fractions_in(input, parts.owned(comm.rank())));
  if (input.level) {
    o.cells.lattice = {0, 0, 0};
    o.cells.cell_size = input.cell_size;
    const IndexBox nodes{{0, 0, 0},
                         {input.grid.cells[0] + 1, input.grid.cells[1] + 1, input.grid.cells[2] + 1}};
    for (const GlobalId n : o.cells.node_id)
      o.cells.node_unit.push_back(std::ldexp(1.0F, -input.level(nodes.cell(n))));
  }
  assign_materials(o.cells, o.fractions, face_neighbours(o.cells));
  return o;
}
Overlay overlay(const Case& input) { return overlay(Comm::self(), input); }

HexMesh lattice(const Index3& cells) {
  return overlay(voxels(cells, std::vector<std::int32_t>(static_cast<std::size_t>(whole(cells).size()), 0)))
      .cells;
}

HexMesh turned(HexMesh mesh) {
  constexpr std::array<std::array<std::size_t, 8>, 3> kTurns{
      {{1, 2, 3, 0, 5, 6, 7, 4}, {4, 7, 6, 5, 0, 3, 2, 1}, {0, 3, 7, 4, 1, 2, 6, 5}}};
  mesh.lattice = {0, 0, 0};
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h)
    for (std::size_t turn = 0; turn < 3; ++turn)
      if (scatter(turn, static_cast<std::uint64_t>(mesh.hex_id[h])) & 8) {
        const Hex before = mesh.hexes[h];
        for (std::size_t c = 0; c < 8; ++c) mesh.hexes[h][c] = before[kTurns[turn][c]];
      }
  return mesh;
}

Overlay filtered(const Comm& comm, const Case& input, int layers) {
  Overlay o = overlay(comm, input, layers);
  (void)filter_materials(o.cells, o.fractions, face_neighbours(o.cells), NodeHexes(o.cells));
  follow_assignment(o.fractions, o.cells.material);
  return o;
}
Overlay filtered(const Case& input) { return filtered(Comm::self(), input); }

Overlay irregular(const Comm& comm, const Index3& cells, std::int32_t grains, std::uint64_t seed,
                  int layers) {
  const auto in_middle = [&](const Index3& c) {
    for (std::size_t d = 0; d < 3; ++d)
      if (3 * c[d] < cells[d] || 3 * c[d] >= 2 * cells[d]) return -1;
    return 0;
  };
  const HexMesh grid =
      overlay(comm, voxels("cells", cells, 1, [](const Index3&) { return 0; }), layers + 1).cells;
  std::vector<std::int32_t> label;
  for (const GlobalId id : grid.hex_id) label.push_back(in_middle(whole(cells).cell(id)));
  Overlay o{pillow(comm, grid, face_neighbours(grid), label, {}, {.offset = 0.4}).mesh, {}};
  o.cells.node_exchange.copy_to_ghosts(o.cells.position);
  o.cells.node_unit.assign(o.cells.position.size(), 1);
  std::vector<Vec3> points;
  for (std::uint64_t g = 0; g < 3 * static_cast<std::uint64_t>(grains); g += 3)
    points.push_back({static_cast<double>(cells[0]) * scatter_unit(seed, g),
                      static_cast<double>(cells[1]) * scatter_unit(seed, g + 1),
                      static_cast<double>(cells[2]) * scatter_unit(seed, g + 2)});
  for (LocalId h = 0; h < o.cells.size(); ++h) {
    Vec3 centre;
    for (const LocalId n : o.cells.hexes[at(h)]) {
      centre += 0.125 * o.cells.position[at(n)];
      if (o.cells.hex_id[at(h)] % 8 != 0) o.cells.node_unit[at(n)] = 0.5F;
    }
    const auto nearest = std::min_element(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) {
      return dot(a - centre, a - centre) < dot(b - centre, b - centre);
    });
    o.fractions.add(static_cast<std::int32_t>(nearest - points.begin()), 1);
    o.fractions.end_cell();
  }
  o.cells.node_exchange.copy_to_ghosts(o.cells.node_unit);
  colour_nodes(o.cells, std::vector<std::uint8_t>(o.cells.position.size(), kNoColour));
  assign_materials(o.cells, o.fractions, face_neighbours(o.cells));
  return o;
}

StagesResult run_stages(const Comm& comm, const Case& input, const StageOptions& options) {
  return run_stages(comm, overlay(comm, input, options.layers.ghost_layers()), input.pure, options);
}

StagesResult run_stages(const Comm& comm, Overlay o, bool pure, const StageOptions& options) {
  StagesResult result;
  const auto note = [&](const char* stage, const HexMesh& mesh) {
    result.checksums.push_back({stage, checksum(comm, mesh)});
    const std::string problem = ghost_problem(mesh);
    if (!problem.empty() && result.ghosts.empty())
      result.ghosts = std::string("after ") + stage + ": " + problem;
  };
  HexMesh& cells = o.cells;
  note("assign", cells);
  const FaceNeighbours neighbours = face_neighbours(cells);
  const NodeHexes around(cells);
  (void)filter_materials(cells, o.fractions, neighbours, around, options.filter);
  note("filter", cells);
  follow_assignment(o.fractions, cells.material);
  if (!o.is_block.empty())
    hold_inside(comm, cells, neighbours, cells.exterior.slides, [&](LocalId a, LocalId b) {
      const std::int32_t m = cells.material[at(a)], n = cells.material[at(b)];
      return m != n && o.is_block[at(m)] != 0 && o.is_block[at(n)] != 0;
    });

  Interfaces faces = trace_interfaces(cells, neighbours);
  for (const InterfaceQuad& q : faces.quads) result.quads += cells.layer[at(q.cell[0])] == 0;
  const std::vector<Crossing> crossings = edge_crossings(cells, faces, o.fractions, around);
  std::vector<Vec3> grid_position;
  for (const LocalId n : faces.nodes) grid_position.push_back(cells.position[at(n)]);
  place_nodes(cells, faces, crossings);
  note("contour", cells);
  InterfaceSmoothing smoothing = options.interfaces;
  if (!pure && smoothing.projection == SurfaceProjection::kOff)
    smoothing.projection = SurfaceProjection::kInterface;
  smooth_interface(cells, faces, crossings, grid_position, smoothing);
  note("smooth interfaces", cells);
  Capture capture;
  if (options.features) {
    capture = capture_geometry(cells, faces, options.features, kNone);
    smoothing.tied = [&](std::size_t i, const Vec3& p) { return capture.onto(i, p); };
    smooth_interface(cells, faces, crossings, grid_position, smoothing);
    note("capture", cells);
  }

  std::vector<std::uint8_t> drop(cells.hexes.size());
  for (std::size_t c = 0; c < drop.size(); ++c) {
    drop[c] = cells.material[c] == options.void_material;
    result.cells += cells.layer[c] == 0 && !drop[c];
  }
  result.cells = comm.sum(result.cells);
  keep_whole(comm, cells.exterior, cells, faces);
  LayeredMesh layered = add_layers(comm, cells, neighbours, drop, faces, deviation_weights(cells, faces),
                                   options.layers, Log());
  note("pillow", layered.mesh);
  SmoothOptions volume_smoothing = options.smoothing;
  volume_smoothing.fidelity = pure ? 1 : 2.5;
  const bool published = volume_smoothing.method == OptimisationMethod::kPublished;
  if (published || volume_smoothing.hold_on_geometry || std::isfinite(volume_smoothing.max_deviation))
    hold(layered.geometry,
         {cells, faces, crossings, grid_position, smoothing.exact, published && pure, std::move(capture)});
  const auto smooth = [&](LayeredMesh& l) { smooth_mesh(l.mesh, l.geometry, volume_smoothing, options.log); };
  smooth(layered);
  note("smooth", layered.mesh);
  if (options.layers.curves) {
    add_curve_layers(comm, layered, options.layers,
                     options.layers.smooth_after ? smooth : std::function<void(LayeredMesh&)>{}, Log());
    note("pillow curves", layered.mesh);
  }
  if (o.kept) {
    result.joined = layered.mesh;
    GlobalId hex_factor = 1;
    for (int i = 0; i < layered.pillows; ++i) hex_factor *= kHexFactor;
    join_hexes(comm, *result.joined, *o.kept, layered.node_factor, hex_factor);
    note("join", *result.joined);
  }
  result.pillows = layered.pillows;
  result.geometry = std::move(layered.geometry);
  result.mesh = std::move(layered.mesh);
  return result;
}

}  // namespace sculpt::test
