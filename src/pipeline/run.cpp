#include "sculpt/pipeline/run.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <ctime>
#include <limits>
#include <optional>

#include "pipeline/console.hpp"
#include "pipeline/interface_geometry.hpp"
#include "sculpt/brep/brep.hpp"
#include "sculpt/brep/interfaces.hpp"
#include "sculpt/contour/contour.hpp"
#include "sculpt/contour/interface_smoothing.hpp"
#include "sculpt/distribute/cartesian.hpp"
#include "sculpt/exo/rank_mesh.hpp"
#include "sculpt/filter/filter.hpp"
#include "sculpt/input/material_source.hpp"
#include "sculpt/pillow/pillow.hpp"
#include "sculpt/pipeline/stages.hpp"
#include "sculpt/smooth/smooth.hpp"
#include "sculpt/vfrac/fractions.hpp"
#include "sculpt/write/side_sets.hpp"
#include "sculpt/write/write_mesh.hpp"

namespace sculpt {
namespace {

constexpr double kFirstOffset = 0.3, kSecondOffset = 0.5;  // of pillow copies towards the inside

// The overlay mesh with its materials, and its adjacency for the stages that work on it.
struct Overlay {
  HexMesh cells;
  Fractions fractions;
  MaterialTable materials;
  FaceNeighbours neighbours;
  std::optional<NodeHexes> around;
  Index3 grid{0, 0, 0};  // cells per axis, all ranks
  bool pure = true;      // on all ranks every cell holds one material only
  ExactSurface exact;    // what the input knows of its surfaces
};

bool surface_pillows(const Deck& deck) { return deck.pillow_surfaces || deck.pillow == kPillowSurfaces; }

// The source's grid with the expansion layers around it.
Grid overlay_grid(const Deck& deck, const Grid& source) {
  if (deck.micro_expand == 0) return source;
  const Vec3 h = source.cell_size();
  Index3 cells = source.cells;
  Vec3 origin;
  for (std::size_t d = 0; d < 3; ++d) {
    cells[d] += 2 * deck.micro_expand;
    origin[d] = source.planes[d].front() - deck.micro_expand * h[d];
  }
  return uniform_grid(cells, origin, h);
}

Overlay read_overlay(const Comm& comm, const Deck& deck, const Log& log, Stages& stages) {
  const auto source = open_source(comm, deck, log);
  const Grid grid = overlay_grid(deck, source->grid());
  const CartesianParts parts = cut_grid(grid.cells, comm.size(), {deck.iproc, deck.jproc, deck.kproc});
  print_decomposition(log, parts);
  const int layers = surface_pillows(deck) ? 3 : 2;

  std::vector<IndexBox> wanted;
  for (int r = 0; r < comm.size(); ++r)
    wanted.push_back(source_of(parts.ghosted(r, layers), deck.micro_expand, source->grid().cells));
  MaterialData data = source->read(comm, wanted);
  stages.end("read input");

  Overlay overlay{lattice_mesh(comm, grid, parts, layers),
                  std::move(data.fractions),
                  std::move(data.table),
                  {},
                  {},
                  grid.cells,
                  true,
                  source->exact_surface()};
  const bool pure = overlay.fractions.material.size() == static_cast<std::size_t>(overlay.fractions.cells());
  overlay.pure = comm.min(std::int64_t{pure}) == 1;
  if (deck.micro_expand > 0)
    overlay.fractions =
        expand_fractions(overlay.fractions, wanted[static_cast<std::size_t>(comm.rank())],
                         parts.ghosted(comm.rank(), layers), deck.micro_expand, source->grid().cells);
  stages.end("distribute");
  return overlay;
}

// 1 for every cell that is no part of the mesh.
std::vector<std::uint8_t> unmeshed_cells(const Deck& deck, const Overlay& overlay) {
  std::vector<std::uint8_t> drop(overlay.cells.hexes.size(), 0);
  for (std::size_t c = 0; c < drop.size(); ++c) {
    const bool is_void =
        overlay.materials.void_material && overlay.cells.material[c] == *overlay.materials.void_material;
    const bool mixed = overlay.fractions.offset[c + 1] - overlay.fractions.offset[c] > 1;
    drop[c] = (is_void && !deck.mesh_void) || (mixed && deck.stair == kStairInterior);
  }
  return drop;
}

void refuse_empty_mesh(const Comm& comm, const Overlay& overlay, const std::vector<std::uint8_t>& drop) {
  std::int64_t meshed = 0;
  for (std::size_t c = 0; c < drop.size(); ++c) meshed += overlay.cells.layer[c] == 0 && !drop[c];
  if (comm.sum(meshed) > 0) return;
  throw Error(fmt::format(
      "nothing to mesh: none of the {} x {} x {} cells of the grid belongs to a material; the geometry "
      "lies outside the box or fills less than half of every cell",
      overlay.grid[0], overlay.grid[1], overlay.grid[2]));
}

void classify(const Comm& comm, const Deck& deck, Overlay& overlay, const Log& log, Stages& stages) {
  HexMesh& cells = overlay.cells;
  const FaceNeighbours& neighbours = overlay.neighbours = face_neighbours(cells);
  log.line("(2/9) classifying materials...");
  assign_materials(cells, overlay.fractions, neighbours);
  if (deck.micro_shave) {
    const bool first_is_void = overlay.materials.void_material == 0 && overlay.materials.block_id.size() > 1;
    const std::int64_t shaved = shave_boundary(cells, neighbours, first_is_void ? 1 : 0);
    log.line("  micro_shave: {} isolated cells at the boundary reassigned", shaved);
  }
  stages.end("classify materials");
  log.line("(3/9) resolving non-manifolds...");
  if (deck.stair == kStairFast) return;
  const NodeHexes& around = overlay.around.emplace(cells);
  const ManifoldReport report = resolve_non_manifold(cells, overlay.fractions, neighbours, around);
  log.line("  {} non-manifold nodes, {} cells reassigned in {} passes", report.bad_nodes,
           report.changed_cells, report.passes);
  if (report.forced_nodes > 0)
    log.line("  WARNING: {} nodes were settled by merging their materials", report.forced_nodes);
  follow_assignment(overlay.fractions, cells.material);
  collectively(comm, "resolving non-manifolds", [&] {
    check(interfaces_are_manifold(cells, neighbours, around), "a material interface is not manifold");
  });
  stages.end("resolve non-manifolds");
}

// Whether smoothing the volume needs to know where the interface is, and not only where its nodes are.
bool holds_interfaces(const Deck& deck) {
  return deck.smooth == kSmoothToGeometry || deck.smooth == kSmoothGeoSmooth ||
         (deck.smooth != kSmoothOff && deck.opt_method == kOptJacobi);
}

// Interface nodes placed and smoothed on the overlay grid; what the smoother must know of them.
struct Contour {
  Interfaces faces;
  std::vector<Weight> weights;
  // Kept where holds_interfaces().
  std::vector<Crossing> crossings;
  std::vector<Vec3> grid_position;
};

Contour contour(const Deck& deck, Overlay& overlay, const Log& log, Stages& stages) {
  HexMesh& cells = overlay.cells;
  Contour c;
  c.faces = trace_interfaces(cells, overlay.neighbours);
  log.line("(4/9) computing dual edge intersections...");
  c.crossings = edge_crossings(cells, c.faces, overlay.fractions, *overlay.around);
  log.line("(5/9) computing material interfaces...");
  for (const LocalId n : c.faces.nodes)
    c.grid_position.push_back(cells.position[static_cast<std::size_t>(n)]);
  place_nodes(cells, c.faces, c.crossings);
  stages.end("contour");
  if (deck.smooth != kSmoothOff)
    smooth_interface(cells, c.faces, c.crossings, c.grid_position,
                     interface_smoothing(deck, overlay.pure, overlay.exact));
  c.weights = deviation_weights(cells, c.faces);
  if (!holds_interfaces(deck)) {
    c.crossings = {};
    c.grid_position = {};
  }
  stages.end("smooth interfaces");
  return c;
}

// The interfaces of a mesh that keeps the shape of the cells. Cells that are left out count as one material.
Contour stair_interfaces(Overlay& overlay, const std::vector<std::uint8_t>& drop, const Log& log) {
  log.line("(4/9) computing dual edge intersections...");
  log.line("(5/9) computing material interfaces...");
  for (std::size_t c = 0; c < drop.size(); ++c)
    if (drop[c]) overlay.cells.material[c] = -1;
  return {trace_interfaces(overlay.cells, overlay.neighbours), {}, {}, {}};
}

SidePlan generate_geometry(const Comm& comm, const Deck& deck, const Overlay& overlay,
                           const Interfaces& faces, const std::vector<std::uint8_t>& drop, const Log& log) {
  log.line("(6/9) generating geometry...");
  const Brep brep = build_brep(comm, overlay.cells, overlay.neighbours, faces);
  log.line("  {} volumes, {} surfaces, {} curves, {} vertices", brep.volumes, brep.surfaces, brep.curves,
           brep.vertices);
  return plan_side_sets(comm, overlay.cells, overlay.neighbours, faces, brep, drop, overlay.grid,
                        deck.gen_sidesets);
}

// Hexes of the cells, without smoothing (stair) or with buffer layers and smoothing; and what their side sets
// will be.
HexMesh build_mesh(const Comm& comm, const Deck& deck, Overlay overlay, SidePlan& sides, const Log& log,
                   Stages& stages) {
  const std::vector<std::uint8_t> drop = unmeshed_cells(deck, overlay);
  refuse_empty_mesh(comm, overlay, drop);
  const bool stair = deck.stair != kStairOff;
  Contour shape = stair ? stair_interfaces(overlay, drop, log) : contour(deck, overlay, log, stages);
  overlay.fractions = {};
  overlay.around.reset();
  sides = generate_geometry(comm, deck, overlay, shape.faces, drop, log);
  overlay.neighbours = {};
  stages.end("generate geometry");
  log.line("(7/9) generating buffer hexes...");
  log.line("(8/9) generating interior hexes...");
  if (stair) {
    HexMesh mesh = pillow(comm, overlay.cells, std::vector<std::int32_t>(drop.size(), -1), drop, 0).mesh;
    stages.end("generate hexes");
    log.line("(9/9) begin smoothing...");
    return mesh;
  }
  std::vector<std::int32_t> label = overlay.cells.material;
  for (std::size_t c = 0; c < label.size(); ++c)
    if (drop[c]) label[c] = -1;
  Pillowed result = pillow(comm, overlay.cells, label, drop, kFirstOffset);
  if (surface_pillows(deck)) {
    const std::vector<std::uint8_t> keep(result.mesh.hexes.size(), 0);
    result = stacked(result, pillow(comm, result.mesh, surface_labels(result.mesh), keep, kSecondOffset));
  }
  Geometry geometry = interface_geometry(result, overlay.cells, shape.faces, shape.weights);
  if (holds_interfaces(deck)) {
    const bool quadrics = deck.opt_method == kOptJacobi && deck.smooth != kSmoothToGeometry && overlay.pure;
    hold(geometry, result,
         {std::move(overlay.cells), std::move(shape.faces), std::move(shape.crossings),
          std::move(shape.grid_position), deck.smooth == kSmoothToGeometry ? overlay.exact : ExactSurface{},
          quadrics});
  }
  overlay.cells = {};
  stages.end("generate hexes");
  log.line("(9/9) begin smoothing...");
  if (deck.smooth != kSmoothOff) {
    print_smoothing_banner(log, deck);
    smooth_mesh(result.mesh, geometry, smooth_options(deck, overlay.pure, result.mesh.cell_size), log);
  }
  stages.end("smooth volume");
  return std::move(result.mesh);
}

WriteOptions write_options(const Deck& deck, const MaterialTable& materials) {
  WriteOptions w;
  w.base = deck.exodus_file;
  w.large = deck.large_exodus;
  w.scale = {deck.scale * deck.xscale, deck.scale * deck.yscale, deck.scale * deck.zscale};
  w.translate = {deck.xtranslate, deck.ytranslate, deck.ztranslate};
  w.block_id = materials.block_id;
  for (const IdName& n : deck.material_name) w.block_names[n.id] = n.name;
  for (const IdName& n : deck.sideset_name) w.side_set_names[n.id] = n.name;
  return w;
}

void check_names(const Deck& deck) {
  for (const auto* names : {&deck.material_name, &deck.sideset_name})
    for (const IdName& n : *names)
      if (n.name.size() > kLongestExodusName)
        throw Error(fmt::format("the name of id {} has {} characters; Exodus files hold at most {}: {}...",
                                n.id, n.name.size(), kLongestExodusName, n.name.substr(0, 40)));
}

}  // namespace

void run(const Comm& comm, const Deck& deck) {
  const Log log(comm.rank() == 0 && !deck.quiet);
  Stages stages;
  check_names(deck);
  check_output_folder(comm, deck.exodus_file);
  Overlay overlay = read_overlay(comm, deck, log, stages);
  log.line("begin SCULPT meshing...");
  log.line("(1/9) computing normals...");
  const MaterialTable materials = overlay.materials;
  std::optional<VolumeTable> input_volumes;
  if (deck.compare_volume) input_volumes.emplace(comm, overlay.cells, overlay.fractions, materials);
  classify(comm, deck, overlay, log, stages);
  SidePlan sides;
  const HexMesh mesh = build_mesh(comm, deck, std::move(overlay), sides, log, stages);

  log.line("building exodus mesh...");
  log.line("generating global ids...");
  const QualitySummary quality = summarise(comm, mesh);
  stages.end("check quality");
  if (deck.gen_sidesets != kSidesetsOff) log.line("building sidesets...");
  const int pillows = deck.stair == kStairOff && surface_pillows(deck) ? 2 : 1;
  const std::vector<SideFace> side_set_faces = side_faces(sides, mesh, pillows);
  if (comm.size() > 1) log.line("generating parallel communication maps...");
  const WriteSummary written = write_mesh(comm, mesh, side_set_faces, write_options(deck, materials));
  stages.end("write files");
  if (input_volumes) input_volumes->compare(comm, mesh, log);
  print_mesh_summary(comm, log, deck, written, quality);
  stages.print(comm, log, written.hexes);
  print_end(comm, log, stages.seconds());
}

}  // namespace sculpt
