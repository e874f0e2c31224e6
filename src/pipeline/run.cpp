#include "sculpt/pipeline/run.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <limits>
#include <map>
#include <optional>

#include "pipeline/adapted_overlay.hpp"
#include "pipeline/classify.hpp"
#include "pipeline/console.hpp"
#include "pipeline/interface_geometry.hpp"
#include "pipeline/layers.hpp"
#include "pipeline/mesh_sets.hpp"
#include "pipeline/overlay.hpp"
#include "pipeline/periodicity.hpp"
#include "pipeline/unstructured_overlay.hpp"
#include "pipeline/vfrac_source.hpp"
#include "pipeline/void_regions.hpp"
#include "sculpt/base/fixed_point.hpp"
#include "sculpt/brep/brep.hpp"
#include "sculpt/brep/exterior.hpp"
#include "sculpt/brep/interfaces.hpp"
#include "sculpt/contour/capture.hpp"
#include "sculpt/contour/contour.hpp"
#include "sculpt/contour/interface_smoothing.hpp"
#include "sculpt/exo/rank_mesh.hpp"
#include "sculpt/input/material_source.hpp"
#include "sculpt/launch/launch.hpp"
#include "sculpt/mesh/edge_walk.hpp"
#include "sculpt/mesh/edit.hpp"
#include "sculpt/pillow/pillow.hpp"
#include "sculpt/pipeline/stages.hpp"
#include "sculpt/quality/fidelity.hpp"
#include "sculpt/smooth/smooth.hpp"
#include "sculpt/smooth/volume_correction.hpp"
#include "sculpt/vfrac/fractions.hpp"
#include "sculpt/write/node_sets.hpp"
#include "sculpt/write/quality_file.hpp"
#include "sculpt/write/side_set_stats.hpp"
#include "sculpt/write/side_sets.hpp"
#include "sculpt/write/write_mesh.hpp"

namespace sculpt {
namespace {

// The material that is left out, or kNone.
std::int32_t unmeshed_material(const Deck& deck, const MaterialTable& materials) {
  return deck.mesh_void ? kNone : materials.void_material.value_or(kNone);
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
  if (overlay.grid[0] == 0)
    throw Error(
        "nothing to mesh: none of the hexes of the input mesh that are to be filled belongs to a material; "
        "the "
        "geometry lies outside of them or fills less than half of every one");
  throw Error(fmt::format(
      "nothing to mesh: none of the {} x {} x {} cells of the grid belongs to a material; the geometry "
      "lies outside the box or fills less than half of every cell",
      overlay.grid[0], overlay.grid[1], overlay.grid[2]));
}

// Whether smoothing the volume needs to know where the interface is, and not only where its nodes are.
bool holds_interfaces(const Deck& deck) {
  return goes_to_geometry(deck) || deck.smooth == kSmoothGeoSmooth ||
         (deck.smooth != kSmoothOff && deck.opt_method == kOptJacobi);
}

constexpr int kLeastCapturePasses = 5;  // that spread nodes along curves of the geometry

// Interface nodes placed and smoothed on the overlay grid; what the smoother must know of them.
struct Contour {
  Interfaces faces;
  std::vector<Weight> weights;
  std::vector<Vec3> placed;  // per interface node: where it was before the smoothing
  Capture capture;
  // Kept where holds_interfaces().
  std::vector<Crossing> crossings;
  std::vector<Vec3> grid_position;
};

void refuse_nothing_to_capture(const Deck& deck, const Overlay& overlay) {
  if (deck.capture != kCaptureCurves) return;
  if (overlay.features && deck.given("capture_side") &&
      (deck.capture_side < 1 || deck.capture_side > overlay.features->surfaces()))
    throw AgreedError(fmt::format(
        "option 'capture_side' ({}): found {}, expected one of the {} surfaces of the geometry",
        deck.given_options.place("capture_side"), deck.capture_side, overlay.features->surfaces()));
  if (overlay.features) return;
  throw AgreedError(
      fmt::format("option 'capture' ({}): the input has no facets whose edges could be captured; expected "
                  "stl_file, or a diatom file with 'insert stl'",
                  deck.given_options.place("capture")));
}

// Ties the interface to the curves and corners of the geometry and takes it there.
void capture(const Deck& deck, Overlay& overlay, Contour& c, const Log& log) {
  HexMesh& cells = overlay.cells;
  c.capture =
      capture_geometry(cells, c.faces, overlay.features,
                       deck.given("capture_side") ? static_cast<std::int32_t>(deck.capture_side) - 1 : kNone);
  log.line("  capture: {} nodes are tied to curves of the geometry, {} to corners", c.capture.curve_nodes,
           c.capture.corner_nodes);
  InterfaceSmoothing passes = interface_smoothing(deck, overlay.pure, overlay.exact);
  passes.pairs = std::max(passes.pairs, kLeastCapturePasses);
  passes.tied = [&](std::size_t i, const Vec3& p) { return c.capture.onto(i, p); };
  smooth_interface(cells, c.faces, c.crossings, c.grid_position, passes);
}

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
  for (const LocalId n : c.faces.nodes) c.placed.push_back(cells.position[at(n)]);
  stages.end("contour");
  if (deck.smooth != kSmoothOff)
    smooth_interface(cells, c.faces, c.crossings, c.grid_position,
                     interface_smoothing(deck, overlay.pure, overlay.exact));
  if (deck.capture == kCaptureCurves) capture(deck, overlay, c, log);
  c.weights = deviation_weights(cells, c.faces);
  if (!holds_interfaces(deck)) {
    c.crossings = {};
    c.grid_position = {};
  }
  stages.end("smooth interfaces");
  return c;
}

// Volume of each material, in cells of level 0, if the cells were meshed as they are now (stair) or
// contoured.
std::vector<double> contoured_volumes(const Comm& comm, const Deck& deck, Overlay& overlay) {
  HexMesh& cells = overlay.cells;
  const std::vector<Vec3> grid = cells.position;
  Stages untimed;
  Contour shape;
  if (deck.stair == kStairOff) shape = contour(deck, overlay, Log(false), untimed);
  const double cell = cells.cell_size.x * cells.cell_size.y * cells.cell_size.z;
  std::vector<std::int64_t> units(overlay.materials.block_id.size(), 0);
  for (LocalId c = 0; c < cells.size(); ++c) {
    if (cells.layer[at(c)] != 0) continue;
    bool bent = false;
    for (const LocalId n : cells.hexes[at(c)])
      bent = bent || (!shape.faces.index_of.empty() && shape.faces.index_of[at(n)] != kNone);
    units[at(cells.material[at(c)])] +=
        to_units(bent ? hex_volume(cells.corners(c)) / cell : cells.volume_in_cells(c));
  }
  comm.sum(units);
  cells.position = grid;
  std::vector<double> volumes;
  for (const std::int64_t u : units) volumes.push_back(from_units(u));
  return volumes;
}

// The interfaces of a mesh that keeps the shape of the cells. Cells that are left out count as one material.
Contour stair_interfaces(Overlay& overlay, const std::vector<std::uint8_t>& drop, const Log& log) {
  log.line("(4/9) computing dual edge intersections...");
  log.line("(5/9) computing material interfaces...");
  for (std::size_t c = 0; c < drop.size(); ++c)
    if (drop[c]) overlay.cells.material[c] = -1;
  return {trace_interfaces(overlay.cells, overlay.neighbours), {}, {}, {}, {}, {}};
}

// Adds the faces of the side sets of the input mesh whose hexes are meshed.
void carry_sets(const Comm& comm, const Overlay& overlay, const std::vector<std::uint8_t>& drop,
                SidePlan& plan, const Log& log) {
  std::int64_t lost = 0;
  const auto owned = [](const HexMesh& mesh, GlobalId id) {
    const auto found = std::lower_bound(mesh.hex_id.begin(), mesh.hex_id.end(), id);
    const auto h = static_cast<LocalId>(found - mesh.hex_id.begin());
    return found != mesh.hex_id.end() && *found == id && mesh.layer[at(h)] == 0 ? h : kNone;
  };
  for (const SidePlan::Item& item : overlay.sets.faces) {
    const LocalId cell = owned(overlay.cells, item.cell);
    const bool meshed =
        cell != kNone ? drop[at(cell)] == 0 : overlay.kept && owned(*overlay.kept, item.cell) != kNone;
    if (meshed) plan.inner.push_back(item);
    lost += cell != kNone && !meshed;
  }
  if (lost = comm.sum(lost); lost > 0)
    log.line("WARNING: {} faces in side sets of the input mesh belong to hexes that are not meshed", lost);
}

// The sets of the geometry: a surface or a part has the id after `last` that its place in the geometry has.
class GeometrySets {
 public:
  GeometrySets(const Deck& deck, const Overlay& overlay, const std::vector<std::uint8_t>& drop,
               std::int64_t last)
      : overlay_(overlay),
        drop_(drop),
        parts_(deck.gen_sidesets == kSidesetsGeometricSidesets),
        last_(last) {}

  // The set of an interface face; 0, which is counted, where no surface is near.
  std::int64_t set_of(const InterfaceQuad& quad) {
    Vec3 middle;
    for (const LocalId n : quad.node) middle += 0.25 * overlay_.cells.position[at(n)];
    const auto material = [&](LocalId cell) {
      return drop_[at(cell)] != 0 ? unmeshed() : overlay_.cells.material[at(cell)];
    };
    const auto surface = overlay_.geometry.nearest(middle, material(quad.cell[0]), material(quad.cell[1]));
    if (!surface) {
      ++lost_;
      return 0;
    }
    return last_ + 1 + (parts_ ? overlay_.geometry.part_of_surface[at(*surface)] : *surface);
  }

  // Collective.
  void finish(const Comm& comm, SidePlan& plan, const Log& log) const {
    const auto& names = parts_ ? overlay_.geometry.part_name : overlay_.geometry.surface_name;
    for (const std::int64_t id : plan.ids) plan.names[id] = names[static_cast<std::size_t>(id - last_ - 1)];
    if (const std::int64_t lost = comm.sum(lost_); lost > 0)
      log.line("WARNING: {} faces of interfaces are near no surface of the geometry; they are in no sideset",
               lost);
  }

 private:
  [[nodiscard]] std::int32_t unmeshed() const { return overlay_.materials.void_material.value_or(-1); }

  const Overlay& overlay_;
  const std::vector<std::uint8_t>& drop_;
  bool parts_;
  std::int64_t last_, lost_ = 0;
};

// The side sets of gen_sidesets.
SidePlan generated_sets(const Comm& comm, const Deck& deck, const Overlay& overlay, const Interfaces& faces,
                        const Brep& brep, const std::vector<std::uint8_t>& drop, const Log& log) {
  SideSetWish wish;
  wish.gen_sidesets = deck.gen_sidesets;
  if (overlay.cells.lattice[0] != 0) wish.grid = overlay.numbered;
  for (const InputSets::Set& set : overlay.sets.side_sets) wish.after = std::max(wish.after, set.id);
  if (overlay.kept) wish.kept = &*overlay.kept;
  GeometrySets geometry(deck, overlay, drop, wish.after);
  wish.set_of = [&](const InterfaceQuad& quad) { return geometry.set_of(quad); };
  SidePlan plan = plan_side_sets(comm, overlay.cells, overlay.neighbours, faces, brep, drop, wish);
  if (!overlay.geometry.empty()) geometry.finish(comm, plan, log);
  if (overlay.sets.wanted) carry_sets(comm, overlay, drop, plan, log);
  check_set_ids(deck, plan.ids, overlay.sets);
  return plan;
}

SidePlan generate_geometry(const Comm& comm, const Deck& deck, const Overlay& overlay,
                           const Interfaces& faces, const std::vector<std::uint8_t>& drop, const Log& log) {
  log.line("(6/9) generating geometry...");
  const Brep brep = build_brep(comm, overlay.cells, overlay.neighbours, faces);
  log.line("  {} volumes, {} surfaces, {} curves, {} vertices", brep.volumes, brep.surfaces, brep.curves,
           brep.vertices);
  return generated_sets(comm, deck, overlay, faces, brep, drop, log);
}

// The volumes that materials shall have, in units of the overlay mesh; below 0: free.
struct WantedVolumes {
  std::vector<double> volume;
  double most = std::numeric_limits<double>::infinity();  // relative error of one that is corrected
};

// Whether all materials get the volumes of the input.
bool corrects_volumes(const Deck& deck, const Overlay& overlay) {
  constexpr std::size_t kMostMaterials = 1000;  // their pressures are found from a full matrix
  if (deck.volume_correction == kVolumesOn) return true;
  return deck.volume_correction == kVolumesAutomatic && !overlay.pure && !goes_to_geometry(deck) &&
         deck.stair == kStairOff && deck.smooth != kSmoothOff && deck.thicken_material.empty() &&
         !deck.given("thicken_void") && !overlay.kept && overlay.materials.block_id.size() <= kMostMaterials;
}

WantedVolumes wanted_volumes(const Deck& deck, const Overlay& overlay, std::vector<double> thickened,
                             const std::vector<double>& input_volume) {
  if (!corrects_volumes(deck, overlay)) return {std::move(thickened)};
  constexpr double kMostCorrected = 0.02;
  const Vec3& h = overlay.cells.cell_size;
  const std::int32_t unmeshed = unmeshed_material(deck, overlay.materials);
  for (std::size_t m = 0; m < thickened.size(); ++m)
    if (unmeshed != static_cast<std::int32_t>(m)) thickened[m] = h.x * h.y * h.z * input_volume[m];
  // Where all of the domain is meshed the largest material has what the others leave.
  if (unmeshed == kNone)
    thickened[static_cast<std::size_t>(std::max_element(input_volume.begin(), input_volume.end()) -
                                       input_volume.begin())] = -1;
  return {std::move(thickened), kMostCorrected};
}

// Smoothing moves volumes a little; materials get the rest of what they should have here.
void correct_to(const WantedVolumes& wanted, const Deck& deck, HexMesh& mesh, const Geometry& geometry,
                const Log& log, Stages& stages) {
  if (std::none_of(wanted.volume.begin(), wanted.volume.end(), [](double v) { return v >= 0; })) return;
  const VolumeCorrection done =
      correct_volumes(mesh, geometry.index, wanted.volume, deck.pcol_threshold, wanted.most);
  log.line("Volume correction: {} rounds, largest error left {:.4f} %, farthest move of a node {:.3f} cells",
           done.rounds, 100 * done.error, done.farthest);
  if (done.left_alone > 0)
    log.line("{}  {} materials are off by more than {:g} % of their volume, which is not corrected",
             deck.volume_correction == kVolumesOn ? "WARNING:" : "", done.left_alone, 100 * wanted.most);
  stages.end("correct volumes");
}

// The interface nodes that this rank owns, by their ids on the overlay grid.
InterfaceTrack interface_track(const HexMesh& cells, const Interfaces& faces,
                               const std::vector<Vec3>& contoured) {
  InterfaceTrack track;
  for (std::size_t i = 0; i < faces.nodes.size(); ++i) {
    const std::size_t n = at(faces.nodes[i]);
    if (cells.node_owner[n] != cells.node_exchange.comm().rank()) continue;
    track.node.push_back(cells.node_id[n]);
    track.contoured.push_back(contoured[i]);
    track.smoothed.push_back(cells.position[n]);
  }
  return track;
}

struct Meshed {
  HexMesh mesh;
  int pillows = 1;  // how often pillow() was called
  SidePlan sides;   // what its side sets will be
  std::vector<ExteriorPart> parts;
  std::vector<NodeSetMembers> node_sets;
  InterfaceTrack track;  // empty in a mesh that keeps the shape of the cells
};

// The nodes of the sets of the input mesh, and of the faces of the boundary that lay between four of them.
std::vector<NodeSetMembers> carried_node_sets(const InputSets& sets, const HexMesh& mesh,
                                              GlobalId node_factor) {
  std::vector<NodeSetMembers> out;
  for (std::size_t s = 0; s < sets.node_sets.size(); ++s) {
    const std::vector<GlobalId>& nodes = sets.nodes[s];
    const auto in = [&](GlobalId id) { return std::binary_search(nodes.begin(), nodes.end(), id); };
    NodeSetMembers members{sets.node_sets[s].id, {}};
    for (const GlobalId id : nodes) members.node.push_back(id * node_factor);
    for (const ExteriorFace& f : mesh.exterior.faces) {
      const auto& corner = mesh.exterior.facets[at(f.facet)].node;
      if (!std::all_of(corner.begin(), corner.end(), in)) continue;
      for (const LocalId n : face_nodes(mesh, {f.hex, f.face})) members.node.push_back(mesh.node_id[at(n)]);
    }
    out.push_back(std::move(members));
  }
  return out;
}

// The cells of a refined grid with valid transitions; cubes stay cubes.
HexMesh smooth_transitions(HexMesh cells) {
  Geometry none;
  none.index.assign(cells.position.size(), kNone);
  smooth_mesh(cells, none, {}, Log(false));
  return cells;
}

// The hexes of the cells as they are, without what is left out.
Meshed stair_mesh(const Comm& comm, const Deck& deck, const Overlay& overlay,
                  const std::vector<std::uint8_t>& drop, const Log& log, Stages& stages) {
  if (layer_plan(deck).any())
    log.line("WARNING: stair keeps the cells as they are; the pillow options have no effect");
  const std::vector<std::int32_t> none(drop.size(), -1);
  Pillowed mesh = pillow(comm, is_adapted(deck) ? smooth_transitions(overlay.cells) : overlay.cells,
                         overlay.neighbours, none, drop, {});
  stages.end("generate hexes");
  log.line("(9/9) begin smoothing...");
  std::vector<NodeSetMembers> node_sets = carried_node_sets(overlay.sets, mesh.mesh, mesh.node_factor);
  std::vector<ExteriorPart> parts = exterior_parts(mesh.mesh);
  if (overlay.kept) join_hexes(comm, mesh.mesh, *overlay.kept, mesh.node_factor, kHexFactor);
  return {std::move(mesh.mesh), 1, {}, std::move(parts), std::move(node_sets), {}};
}

Meshed layered_mesh(const Comm& comm, const Deck& deck, Overlay& overlay, Contour& shape,
                    const std::vector<std::uint8_t>& drop, const WantedVolumes& wanted, const Log& log,
                    Stages& stages) {
  InterfaceTrack track = interface_track(overlay.cells, shape.faces, shape.placed);
  const LayerPlan plan = layer_plan(deck);
  keep_whole(comm, overlay.cells.exterior, overlay.cells, shape.faces);
  const bool held = holds_interfaces(deck);
  HexMesh contoured = held ? overlay.cells : HexMesh{};
  LayeredMesh layered = add_layers(comm, std::move(overlay.cells), std::move(overlay.neighbours), drop,
                                   shape.faces, shape.weights, plan, log);
  if (held)
    hold(
        layered.geometry,
        {std::move(contoured), std::move(shape.faces), std::move(shape.crossings),
         std::move(shape.grid_position), goes_to_geometry(deck) ? overlay.exact : ExactSurface{},
         deck.opt_method == kOptJacobi && !goes_to_geometry(deck) && overlay.pure, std::move(shape.capture)});
  stages.end("generate hexes");
  log.line("(9/9) begin smoothing...");
  const auto smooth = [&](LayeredMesh& l) {
    smooth_mesh(l.mesh, l.geometry, smooth_options(deck, overlay.pure, l.mesh.cell_size), log);
  };
  const bool smooths = deck.smooth != kSmoothOff;
  // Curves are judged after the smoothing, so that with curve pillows only the smoothing after those is off.
  if (smooths && (plan.smooth_after || plan.curves)) {
    print_smoothing_banner(log, deck);
    smooth(layered);
  }
  stages.end("smooth volume");
  if (plan.curves) {
    add_curve_layers(comm, layered, plan,
                     smooths && plan.smooth_after ? smooth : std::function<void(LayeredMesh&)>{}, log);
    stages.end("pillow curves");
  }
  correct_to(wanted, deck, layered.mesh, layered.geometry, log, stages);
  for (GlobalId& node : track.node) node *= layered.node_factor;
  std::vector<NodeSetMembers> node_sets = carried_node_sets(overlay.sets, layered.mesh, layered.node_factor);
  std::vector<ExteriorPart> parts = exterior_parts(layered.mesh);
  if (overlay.kept) {
    GlobalId hex_factor = 1;
    for (int i = 0; i < layered.pillows; ++i) hex_factor *= kHexFactor;
    join_hexes(comm, layered.mesh, std::move(*overlay.kept), layered.node_factor, hex_factor);
  }
  return {std::move(layered.mesh), layered.pillows,      {},
          std::move(parts),        std::move(node_sets), std::move(track)};
}

Meshed build_mesh(const Comm& comm, const Deck& deck, Overlay overlay, const WantedVolumes& wanted,
                  const Log& log, Stages& stages) {
  const std::vector<std::uint8_t> drop = unmeshed_cells(deck, overlay);
  refuse_empty_mesh(comm, overlay, drop);
  const bool stair = deck.stair != kStairOff;
  Contour shape = stair ? stair_interfaces(overlay, drop, log) : contour(deck, overlay, log, stages);
  overlay.fractions = {};
  overlay.around.reset();
  SidePlan sides = generate_geometry(comm, deck, overlay, shape.faces, drop, log);
  if (deck.gen_sidesets != kSidesetsOff && has_input_mesh(deck)) share_exterior_faces(overlay.cells, sides);
  stages.end("generate geometry");
  log.line("(7/9) generating buffer hexes...");
  log.line("(8/9) generating interior hexes...");
  Meshed meshed = stair ? stair_mesh(comm, deck, overlay, drop, log, stages)
                        : layered_mesh(comm, deck, overlay, shape, drop, wanted, log, stages);
  meshed.sides = std::move(sides);
  return meshed;
}

// The faces of the mesh that belong to side sets.
std::vector<SideFace> side_set_faces(const Deck& deck, const Meshed& meshed, const Log& log) {
  if (deck.gen_sidesets != kSidesetsOff || !deck.sideset.empty() || deck.rve_sets)
    log.line("building sidesets...");
  return side_faces(meshed.sides, meshed.mesh, meshed.pillows, meshed.parts);
}

// Takes hexes below remove_bad out of the mesh, and their faces out of the side sets.
void remove_bad_hexes(const Comm& comm, const Deck& deck, const MaterialTable& materials, HexMesh& mesh,
                      std::vector<SideFace>& faces, const Log& log) {
  if (!deck.given("remove_bad")) return;
  const std::vector<double> quality = scaled_jacobians(mesh);
  std::vector<std::uint8_t> remove(quality.size());
  std::vector<std::int64_t> removed(materials.block_id.size(), 0);
  std::int64_t left = 0;
  for (std::size_t h = 0; h < remove.size(); ++h) {
    remove[h] = quality[h] < deck.remove_bad;
    if (mesh.layer[h] == 0) ++(remove[h] ? removed[at(mesh.material[h])] : left);
  }
  comm.sum(removed);
  print_removed(log, deck, materials, removed);
  if (comm.sum(left) == 0)
    throw Error(
        fmt::format("remove_bad = {}: no hex of the mesh has a scaled Jacobian that large", deck.remove_bad));
  if (std::all_of(removed.begin(), removed.end(), [](std::int64_t n) { return n == 0; })) return;
  const std::vector<LocalId> index = remove_hexes(comm, mesh, remove);
  std::erase_if(faces, [&](const SideFace& f) { return index[at(f.hex)] == kNone; });
  for (SideFace& f : faces) f.hex = index[at(f.hex)];
}

// Makes the regions of the void blocks of their own where the deck asks for it.
VoidRegions separate_void_blocks(const Comm& comm, const Deck& deck, HexMesh& mesh, MaterialTable& materials,
                                 const Log& log) {
  const auto block = void_block(deck, materials);
  if (!deck.separate_void_blocks || !deck.mesh_void || !block) return {};
  const std::int64_t id = materials.block_id[at(*block)];
  const VoidRegions regions = separate_void(comm, mesh, materials, *block);
  log.line("separate_void_blocks: block {} has {} regions", id, regions.count);
  return regions;
}

// Interfaces between blocks of the input mesh stay where they are.
void hold_block_interfaces(const Comm& comm, const Deck& deck, Overlay& overlay) {
  if (overlay.is_block.empty()) return;
  overlay.is_block.resize(overlay.materials.block_id.size(), 0);
  const std::vector<std::int32_t>& material = overlay.cells.material;
  hold_inside(comm, overlay.cells, overlay.neighbours, deck.exterior_sliding == kSlidingSurface,
              [&](LocalId a, LocalId b) {
                const std::size_t m = at(material[at(a)]), n = at(material[at(b)]);
                return m != n && overlay.is_block[m] != 0 && overlay.is_block[n] != 0;
              });
}

// Adds the volumes of hexes of one material each, in cells.
void add_volumes(const Comm& comm, const HexMesh& hexes, std::vector<double>& volume) {
  std::vector<std::int64_t> units(volume.size(), 0);
  for (LocalId h = 0; h < hexes.size(); ++h)
    if (hexes.layer[at(h)] == 0) units[at(hexes.material[at(h)])] += to_units(hexes.volume_in_cells(h));
  comm.sum(units);
  for (std::size_t m = 0; m < units.size(); ++m) volume[m] += from_units(units[m]);
}

// Everything that is told about the mesh in the end; displacement, input volumes and the like are known.
QualityReport report_of(const Comm& comm, const Deck& deck, const MaterialTable& materials,
                        const HexMesh& mesh, const VoidRegions& regions, std::vector<double> input_volume,
                        const Displacement& displacement) {
  QualityReport report;
  report.summary = summarise(comm, mesh);
  if (regions.count > 1) share_void_volume(report.summary, regions, input_volume);
  report.kink = measure_kink(comm, mesh);
  report.displacement = displacement;
  report.cell_volume = mesh.cell_size.x * mesh.cell_size.y * mesh.cell_size.z;
  const std::optional<std::int32_t> unmeshed = deck.mesh_void ? std::nullopt : materials.void_material;
  report.volume_moved = volume_moved(report.summary, input_volume, unmeshed);
  for (std::size_t m = 0; m < materials.block_id.size(); ++m) {
    if (unmeshed == static_cast<std::int32_t>(m)) continue;
    QualityReport::Block block{static_cast<std::int32_t>(m), materials.block_id[m], {}, input_volume[m]};
    for (const IdName& n : deck.material_name)
      if (n.id == block.id) block.name = n.name;
    report.blocks.push_back(std::move(block));
  }
  return report;
}

std::vector<std::int64_t> blocks_with_hexes(const QualityReport& report) {
  std::vector<std::int64_t> ids;
  for (const auto& block : report.blocks)
    if (report.of(block).hexes > 0) ids.push_back(block.id);
  return ids;
}

// The exit status that require_quality asks for.
int judge(const Deck& deck, const QualitySummary& quality, const Log& log) {
  if (!deck.given("require_quality")) return 0;
  if (quality.not_positive_inside == 0 && quality.least >= deck.require_quality) return 0;
  log.line(
      "WARNING: the mesh misses require_quality = {:g}: least scaled Jacobian {:f}, {} hexes not valid; "
      "exit status {}",
      deck.require_quality, quality.least, quality.not_positive_inside, kPoorMeshStatus);
  return kPoorMeshStatus;
}

Vec3 scale_of(const Deck& deck) {
  return {deck.scale * deck.xscale, deck.scale * deck.yscale, deck.scale * deck.zscale};
}

WriteOptions write_options(const Deck& deck, const MaterialTable& materials, const HexMesh& mesh) {
  WriteOptions w;
  w.base = deck.exodus_file;
  w.large = deck.large_exodus;
  w.block_id = materials.block_id;
  for (const IdName& n : deck.material_name) w.block_names[n.id] = n.name;
  for (const IdName& n : deck.sideset_name) w.side_set_names[n.id] = n.name;
  for (const IdName& n : deck.nodeset_name) w.node_set_names[n.id] = n.name;
  if (deck.quality_variable)
    w.variables.push_back(
        {"scaled_jacobian", [quality = scaled_jacobians(mesh)](LocalId h) { return quality[at(h)]; }});
  return w;
}

// Names and sets of the input mesh; names that the deck gives come first.
struct Carried {
  std::map<std::int64_t, std::string> block_names;
  std::vector<InputSets::Set> side_sets, node_sets;
};
void add_carried(WriteOptions& options, const Carried& carried) {
  options.block_names.insert(carried.block_names.begin(), carried.block_names.end());
  for (const InputSets::Set& set : carried.side_sets) {
    options.side_sets.push_back(set.id);
    if (!set.name.empty()) options.side_set_names.emplace(set.id, set.name);
  }
  for (const InputSets::Set& set : carried.node_sets)
    if (!set.name.empty()) options.node_set_names.emplace(set.id, set.name);
}

std::string export_name(const Deck& deck) { return deck.exodus_file + "_adapt"; }
bool exports_grid(const Deck& deck) { return deck.adapt_export && deck.adapt_type != kAdaptOff; }

// The cells of the overlay with their materials as a mesh of its own (adapt_export). Transitions are
// smoothed, so that it is a valid mesh.
void write_grid(const Comm& comm, const Deck& deck, const Overlay& overlay, const Log& log, Stages& stages) {
  HexMesh cells = smooth_transitions(overlay.cells);
  if (overlay.axes) turn(cells, *overlay.axes);
  transform(cells, scale_of(deck), {deck.xtranslate, deck.ytranslate, deck.ztranslate});
  WriteOptions options = write_options(deck, overlay.materials, cells);
  options.base = export_name(deck);
  const WriteSummary written = write_mesh(comm, cells, {}, options);
  log.line("adapt_export: the grid, {} cells, is in {}", written.hexes, options.base);
  stages.end("export grid");
}

// Before any work is done: whether all files could be written.
void check_outputs(const Comm& comm, const Deck& deck, const std::string& quality_file) {
  check_output_folder(comm, "exodus_file", deck.exodus_file);
  if (exports_grid(deck)) check_output_folder(comm, "exodus_file", export_name(deck));
  if (!deck.volfrac_file.empty()) check_output_folder(comm, "volfrac_file", deck.volfrac_file);
  if (!quality_file.empty()) check_output_file(comm, "quality", quality_file);
}

void check_names(const Deck& deck) {
  for (const auto* names : {&deck.material_name, &deck.sideset_name, &deck.nodeset_name})
    for (const IdName& n : *names)
      if (n.name.size() > kLongestExodusName)
        throw Error(fmt::format("the name of id {} has {} characters; Exodus files hold at most {}: {}...",
                                n.id, n.name.size(), kLongestExodusName, n.name.substr(0, 40)));
}

}  // namespace

int run(const Comm& comm, const Deck& given) {
  const Log log(comm.rank() == 0 && !given.quiet);
  Stages stages;
  const Deck deck = with_defaults_of_fractions(comm, given, log);
  check_names(deck);
  const std::string quality_file = quality_file_name(deck);
  check_outputs(comm, deck, quality_file);
  Overlay overlay = read_overlay(comm, deck, log, stages);
  if (!deck.volfrac_file.empty()) write_fractions(comm, deck, overlay, log, stages);
  refuse_nothing_to_capture(deck, overlay);
  log.line("begin SCULPT meshing...");
  log.line("(1/9) computing normals...");
  std::vector<double> input_volume =
      input_volumes(comm, overlay.cells, overlay.fractions, overlay.materials.block_id.size());
  if (overlay.kept) add_volumes(comm, *overlay.kept, input_volume);
  overlay.neighbours = face_neighbours(overlay.cells);
  std::vector<double> thickened = classify(
      comm, deck, overlay.cells, overlay.fractions, overlay.materials, overlay.neighbours, overlay.around,
      input_volume, [&] { return contoured_volumes(comm, deck, overlay); }, log, stages);
  hold_block_interfaces(comm, deck, overlay);
  MaterialTable materials = overlay.materials;
  const std::optional<std::array<Vec3, 3>> axes = overlay.axes;
  for (const std::string& idle : idle_set_options(deck, materials)) log.line("WARNING: {}", idle);
  const Carried carried{overlay.block_names, overlay.sets.side_sets, overlay.sets.node_sets};
  if (exports_grid(deck)) write_grid(comm, deck, overlay, log, stages);
  input_volume.resize(materials.block_id.size(), 0);  // thicken_void may have added the void
  const WantedVolumes wanted = wanted_volumes(deck, overlay, std::move(thickened), input_volume);
  Meshed meshed = build_mesh(comm, deck, std::move(overlay), wanted, log, stages);

  log.line("building exodus mesh...");
  log.line("generating global ids...");
  HexMesh& mesh = meshed.mesh;
  const Displacement moved = displacement(comm, mesh, meshed.track);
  if (axes) turn(mesh, *axes);
  transform(mesh, scale_of(deck), {deck.xtranslate, deck.ytranslate, deck.ztranslate});
  std::vector<SideFace> faces = side_set_faces(deck, meshed, log);
  const VoidRegions regions = separate_void_blocks(comm, deck, mesh, materials, log);
  remove_bad_hexes(comm, deck, materials, mesh, faces, log);
  const QualityReport report = report_of(comm, deck, materials, mesh, regions, input_volume, moved);
  stages.end("check quality");
  if (comm.size() > 1) log.line("generating parallel communication maps...");
  WriteOptions options = write_options(deck, materials, mesh);
  add_carried(options, carried);
  for (const NodeSetMembers& members : meshed.node_sets) options.node_sets.push_back(gathered(mesh, members));
  options.side_set_names.insert(meshed.sides.names.begin(), meshed.sides.names.end());
  add_mesh_sets(comm, deck, mesh, meshed.sides.ids, blocks_with_hexes(report), faces, options, log);
  const WriteSummary written = write_mesh(comm, mesh, faces, options);
  if (!quality_file.empty()) write_quality_file(comm, report, deck.exodus_file, quality_file);
  stages.end("write files");
  if (deck.compare_volume) print_volumes(log, report);
  print_mesh_summary(comm, log, deck, written, report);
  if (deck.compute_ss_stats)
    print_side_sets(log, side_set_stats(comm, mesh, options.side_sets, faces), options.side_set_names);
  const int status = judge(deck, report.summary, log);
  stages.print(comm, log, written.hexes);
  print_end(comm, log, stages.seconds());
  return status;
}

}  // namespace sculpt
