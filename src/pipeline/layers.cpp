#include "pipeline/layers.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include "pipeline/interface_geometry.hpp"
#include "sculpt/quality/summary.hpp"

namespace sculpt {
namespace {

constexpr double kFirstOffset = 0.3, kSecondOffset = 0.5;  // of pillow copies towards the inside
constexpr std::uint8_t kAllSides = kXmin | kXmax | kYmin | kYmax | kZmin | kZmax;

std::int64_t owned_hexes(const Comm& comm, const HexMesh& mesh) {
  std::int64_t count = 0;
  for (const std::uint8_t layer : mesh.layer) count += layer == 0;
  return comm.sum(count);
}

// One more pillow of a mesh; its neighbours are replaced as well.
void add_layer(const Comm& comm, LayeredMesh& layered, FaceNeighbours& neighbours,
               std::span<const std::int32_t> label, const PillowRules& rules,
               std::span<const std::int32_t> captured = {}) {
  Pillowed next = pillow(comm, layered.mesh, neighbours, label, {}, rules);
  layered.geometry = followed(layered.geometry, next, captured);
  layered.mesh = std::move(next.mesh);
  neighbours = std::move(next.neighbours);
  ++layered.pillows;
  layered.node_factor *= next.node_factor;
}

// The parts of interface surfaces, by the faces of the cells on both sides, and the sets of buffer hexes that
// are wrapped for them.
class CapturedSets {
 public:
  // others: surfaces that are on no part of the geometry are wrapped as well.
  CapturedSets(const HexMesh& cells, const FaceNeighbours& neighbours, const Interfaces& faces, bool others) {
    std::map<std::tuple<std::array<std::int32_t, 2>, std::int32_t>, std::int32_t> sets;
    for (std::size_t i = 0; i < faces.quads.size(); ++i) {
      const InterfaceQuad& q = faces.quads[i];
      if (faces.part[i] == kNone && !others) continue;
      const auto [set, added] = sets.try_emplace({Interfaces::materials(cells, q), faces.part[i]},
                                                 static_cast<std::int32_t>(sets.size()));
      if (added) surface_.push_back(faces.part[i]);
      const auto& back = neighbours[at(q.cell[1])];
      const auto opposite = std::find(back.begin(), back.end(), q.cell[0]) - back.begin();
      sides_.push_back({cells.hex_id[at(q.cell[0])], q.face, set->second});
      sides_.push_back({cells.hex_id[at(q.cell[1])], static_cast<int>(opposite), set->second});
    }
    std::sort(sides_.begin(), sides_.end());
  }

  // Of the volume pillow of the cells: the set of every hex, -1 for hexes away from interfaces.
  [[nodiscard]] std::vector<std::int32_t> labels(const HexMesh& mesh) const {
    std::vector<std::int32_t> label(mesh.hexes.size(), -1);
    for (std::size_t h = 0; h < label.size(); ++h) {
      const auto face = static_cast<int>(mesh.hex_id[h] % kHexFactor) - 1;
      if (face < 0) continue;
      const Side side{mesh.hex_id[h] / kHexFactor, face, 0};
      const auto found = std::lower_bound(sides_.begin(), sides_.end(), side);
      if (found != sides_.end() && found->cell == side.cell && found->face == face) label[h] = found->set;
    }
    return label;
  }
  // Per set: its surface of the geometry, or kNone.
  [[nodiscard]] std::span<const std::int32_t> surface() const { return surface_; }

 private:
  struct Side {
    GlobalId cell;
    int face;
    std::int32_t set;
    auto operator<=>(const Side&) const = default;
  };
  std::vector<Side> sides_;  // ascending
  std::vector<std::int32_t> surface_;
};

// Layers of equal thickness, made by cutting the cells at the box from the inside outwards.
void add_boundary_layers(const Comm& comm, LayeredMesh& layered, FaceNeighbours& neighbours, int layers,
                         std::uint8_t sides) {
  for (int layer = 1; layer <= layers; ++layer) {
    // The outermost hexes are 1 - (layer - 1) / (layers + 1) cells thick; the middle is at half of that.
    const double kept = static_cast<double>(layers + 1 - layer) / (layers + 2 - layer);
    const std::vector<std::int32_t> everywhere(layered.mesh.hexes.size(), 0);
    add_layer(comm, layered, neighbours, everywhere,
              {.offset = 2 * kept, .along_edges = true, .box_sides = sides, .with_neighbours = true});
  }
}

}  // namespace

LayerPlan layer_plan(const Deck& deck) {
  LayerPlan p;
  const bool curves_by_number = deck.pillow == kPillowCurves || deck.pillow > kPillowSurfacesNoSmoothing;
  const bool unsmoothed_curves =
      deck.pillow >= kPillowCurvesNoSmoothing && deck.pillow < kPillowCurvesSmoothed;
  p.surfaces =
      deck.pillow_surfaces || deck.pillow == kPillowSurfaces || deck.pillow == kPillowSurfacesNoSmoothing;
  p.captured = deck.capture == kCaptureCurves;
  p.curves = deck.pillow_curves || curves_by_number;
  p.curve_layers = deck.pillow >= kPillowCurvesNoSmoothing ? deck.pillow % 10 : deck.pillow_curve_layers;
  p.curve_threshold = deck.pillow_curve_thresh;
  p.boundaries = deck.pillow_boundaries || deck.pillow == kPillowDomainBoundaries;
  p.refined = deck.adapt_type != kAdaptOff;
  p.boundary_layers = deck.pillow_boundary_layers;
  p.smooth_after = !deck.pillow_smooth_off && deck.pillow != kPillowSurfacesNoSmoothing && !unsmoothed_curves;
  return p;
}

LayeredMesh add_layers(const Comm& comm, HexMesh cells, FaceNeighbours neighbours,
                       std::span<const std::uint8_t> drop, const Interfaces& faces,
                       const std::vector<Weight>& weights, const LayerPlan& plan, const Log& log) {
  std::vector<std::int32_t> label = cells.material;
  for (std::size_t c = 0; c < label.size(); ++c)
    if (drop[c]) label[c] = -1;
  const bool boundaries = plan.boundaries && plan.refined;
  const bool more = plan.surfaces || plan.captured || boundaries || plan.boundary_layers > 0;
  std::optional<CapturedSets> captured;
  if (plan.captured) captured.emplace(cells, neighbours, faces, plan.surfaces);
  Pillowed first =
      pillow(comm, cells, neighbours, label, drop, {.offset = kFirstOffset, .with_neighbours = more});
  cells = {};
  neighbours = std::move(first.neighbours);
  LayeredMesh layered{{}, interface_geometry(first, faces, weights), 1, first.node_factor};
  layered.mesh = std::move(first.mesh);
  first = {};
  if (plan.surfaces || captured)
    add_layer(comm, layered, neighbours,
              captured ? captured->labels(layered.mesh) : surface_labels(layered.mesh, neighbours),
              {.offset = kSecondOffset,
               .along_edges = true,
               .with_neighbours = boundaries || plan.boundary_layers > 0},
              captured ? captured->surface() : std::span<const std::int32_t>{});
  if (plan.boundaries) {
    const std::uint8_t sides = boundaries ? sides_with_flat_hexes(comm, layered.mesh) : std::uint8_t{0};
    if (sides != 0)
      add_boundary_layers(comm, layered, neighbours, 1, sides);
    else
      log.line("  pillow_boundaries: no hex has two faces on one side of the box, so no layer is added");
  }
  if (plan.boundary_layers > 0)
    add_boundary_layers(comm, layered, neighbours, plan.boundary_layers, kAllSides);
  share_positions(layered.mesh);
  return layered;
}

void add_curve_layers(const Comm& comm, LayeredMesh& layered, const LayerPlan& plan,
                      const std::function<void(LayeredMesh&)>& smooth, const Log& log) {
  const HexMesh& mesh = layered.mesh;
  std::vector<std::uint8_t> curve_node(mesh.position.size(), 0);
  for (std::size_t n = 0; n < curve_node.size(); ++n) {
    const LocalId entry = layered.geometry.index[n];
    curve_node[n] = entry != kNone && layered.geometry.on_curve[at(entry)] != 0;
  }
  const CurveSet set = poor_curves(comm, mesh, curve_node, plan.curve_threshold, plan.curve_layers);
  if (set.poor == 0) {
    log.line("pillow_curves: no hex at a curve has a scaled Jacobian below {:f}, so no layer is added",
             plan.curve_threshold);
    return;
  }
  const std::int64_t before = owned_hexes(comm, mesh);
  const double worst = summarise(comm, mesh).least;
  Pillowed next = pillow(comm, mesh, face_neighbours(mesh), set.label, {},
                         {.offset = kSecondOffset, .along_edges = true});
  LayeredMesh wrapped{
      {}, followed(layered.geometry, next, {}), layered.pillows + 1, layered.node_factor * next.node_factor};
  wrapped.mesh = std::move(next.mesh);
  share_positions(wrapped.mesh);
  log.line("pillow_curves: {} hexes at curves are below {:f}; a layer of {} hexes is put around {}", set.poor,
           plan.curve_threshold, owned_hexes(comm, wrapped.mesh) - before, set.wrapped);
  if (smooth) {
    smooth(wrapped);
    const double now = summarise(comm, wrapped.mesh).least;
    if (now < worst) {
      log.line("pillow_curves: the worst hex would fall from {:f} to {:f}; the layer is taken out again",
               worst, now);
      return;
    }
    log.line("pillow_curves: the worst hex rose from {:f} to {:f}", worst, now);
  }
  layered = std::move(wrapped);
}

}  // namespace sculpt
