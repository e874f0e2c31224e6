#include "pipeline/unstructured_overlay.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <tuple>

#include "pipeline/hex_materials.hpp"
#include "pipeline/idle_options.hpp"
#include "pipeline/layers.hpp"
#include "sculpt/base/lot.hpp"
#include "sculpt/brep/exterior.hpp"
#include "sculpt/distribute/cartesian_grid.hpp"
#include "sculpt/distribute/conformity.hpp"
#include "sculpt/distribute/repartition.hpp"
#include "sculpt/distribute/unstructured.hpp"
#include "sculpt/input/input_mesh.hpp"
#include "sculpt/input/pamgen.hpp"
#include "sculpt/mesh/edit.hpp"
#include "sculpt/par/finding.hpp"
#include "sculpt/vfrac/fractions.hpp"

namespace sculpt {
namespace {

PartitionMethod partition_method(const Deck& deck) {
  switch (deck.input_mesh_partition) {
    case kPartitionRib:
      return PartitionMethod::kRib;
    case kPartitionHsfc:
      return PartitionMethod::kHsfc;
    case kPartitionGraph:
      return PartitionMethod::kGraph;
    default:
      return PartitionMethod::kRcb;
  }
}

bool carries_sets(const Deck& deck) {
  return deck.gen_sidesets == kSidesetsInputMesh || deck.gen_sidesets == kSidesetsInputMeshAndStl ||
         deck.gen_sidesets == kSidesetsInputMeshAndFreeSurfaces;
}

// Whether materials come from shapes or voxels; otherwise from the element variables of the mesh.
bool has_geometry(const Deck& deck) { return !deck.input_spn.empty() || has_shapes(deck); }

class InputMeshOverlay {
 public:
  InputMeshOverlay(const Comm& comm, const Deck& deck, const Log& log, Stages& stages)
      : comm_(comm), deck_(deck), log_(log), stages_(stages) {}

  Overlay run() {
    mesh_ = deck_.input_mesh.empty() ? read_pamgen(comm_, deck_.input_mesh_pamgen, log_)
                                     : read_input_mesh(comm_, deck_.input_mesh, log_);
    if (deck_.input_mesh.empty()) check_hexes(comm_, mesh_, path());
    stages_.end("read input mesh");
    find_blocks();
    check_conformity(comm_, mesh_.share, block_ids());
    if (!keeps_something())
      if (const auto grid = cartesian_grid_of(comm_, mesh_.share)) return on_grid(*grid);
    refuse_what_needs_a_grid();
    for (const std::string& idle : idle_without_grid(deck_)) log_.line("WARNING: {}", idle);
    stages_.end("check input mesh");
    return on_mesh();
  }

 private:
  [[nodiscard]] const std::string& path() const {
    return deck_.input_mesh.empty() ? deck_.input_mesh_pamgen : deck_.input_mesh;
  }
  [[nodiscard]] bool keeps_blocks() const {
    return deck_.input_mesh_material == kMeshMaterialGeometryAndBlocks && has_geometry(deck_);
  }
  [[nodiscard]] bool restricted() const {
    return std::find(kept_block_.begin(), kept_block_.end(), 1) != kept_block_.end();
  }

  // What a Cartesian grid does not have.
  [[nodiscard]] bool keeps_something() const { return restricted() || keeps_blocks() || carries_sets(deck_); }

  [[nodiscard]] std::vector<std::int64_t> block_ids() const {
    std::vector<std::int64_t> ids;
    for (const InputMesh::Block& block : mesh_.blocks) ids.push_back(block.id);
    return ids;
  }

  // Which blocks stay as they are.
  void find_blocks() {
    kept_block_.assign(mesh_.blocks.size(), deck_.input_mesh_blocks.empty() ? 0 : 1);
    for (const std::int64_t id : deck_.input_mesh_blocks) {
      const auto found = std::find_if(mesh_.blocks.begin(), mesh_.blocks.end(),
                                      [id](const InputMesh::Block& b) { return b.id == id; });
      if (found == mesh_.blocks.end()) {
        throw AgreedError(fmt::format("option 'input_mesh_blocks' ({}): '{}' has no block {}, only {}",
                                      deck_.given_options.place("input_mesh_blocks"), path(), id,
                                      fmt::join(block_ids(), " ")));
      }
      kept_block_[static_cast<std::size_t>(found - mesh_.blocks.begin())] = 0;
    }
  }

  void refuse_what_needs_a_grid() const {
    const auto refuse = [&](const char* option, const std::string& why) {
      throw AgreedError(
          fmt::format("option '{}' ({}): {}; {}", option, deck_.given_options.place(option), why,
                      keeps_something() ? fmt::format("blocks or sets of '{}' are to be kept", path())
                                        : fmt::format("'{}' is not a Cartesian grid", path())));
    };
    if (deck_.adapt_type != kAdaptOff)
      refuse("adapt_type", "refinement and coarsening pair the layers of a Cartesian grid");
    if (deck_.capture == kCaptureCurves)
      refuse("capture", "edges and corners are captured on a Cartesian grid only");
    if (deck_.periodic) refuse("periodic", "periodic meshes need a Cartesian grid");
    if (deck_.micro_expand > 0) refuse("micro_expand", "layers can be added to a Cartesian grid only");
    if (deck_.gen_sidesets == kSidesetsRve || deck_.gen_sidesets == kSidesetsRveVariable)
      refuse("gen_sidesets",
             "rve and rve_variable name the six sides of a box; variable names the surfaces of any mesh");
    if (deck_.rve_sets) refuse("rve_sets", "it names the sides, edges and corners of a box");
  }

  // The mesh is a Cartesian grid.
  Overlay on_grid(const CartesianShare& shape) {
    const Index3& n = shape.grid.cells;
    log_.line("The input mesh is a Cartesian grid of {} x {} x {} cells", n[0], n[1], n[2]);
    stages_.end("check input mesh");
    if (has_shapes(deck_)) {  // shapes are known everywhere
      Deck on_grid = deck_;
      for (const char* option : {"nelx", "nely", "nelz", "xmin", "ymin", "zmin", "xmax", "ymax", "zmax"})
        on_grid.given_options.add(option, "from the input mesh");
      on_grid.given_options.remove("cell_size");
      on_grid.nelx = n[0];
      on_grid.nely = n[1];
      on_grid.nelz = n[2];
      const auto& [x, y, z] = shape.grid.planes;
      std::tie(on_grid.xmin, on_grid.ymin, on_grid.zmin) = std::tuple(x.front(), y.front(), z.front());
      std::tie(on_grid.xmax, on_grid.ymax, on_grid.zmax) = std::tuple(x.back(), y.back(), z.back());
      const auto source = open_source(comm_, on_grid, log_, std::nullopt);
      return read_on_grid(comm_, on_grid, *source, log_, stages_);
    }
    const HexList hexes{mesh_.share.element.size(), [&](std::size_t e) {
                          const Index3 c = whole(n).cell(shape.cell[e]);
                          HexCorners corners;
                          for (std::size_t v = 0; v < 8; ++v)
                            corners[v] =
                                shape.grid.corner({c[0] + kCornerOffset[v][0], c[1] + kCornerOffset[v][1],
                                                   c[2] + kCornerOffset[v][2]});
                          return corners;
                        }};
    HexMaterials materials = measure(hexes, mesh_.share.element, mesh_.share.value);
    (void)add_blocks(comm_, deck_, materials, {}, log_);
    const auto source = grid_of_hexes(shape.grid, shape.cell, std::move(materials));
    return read_on_grid(comm_, deck_, *source, log_, stages_);
  }

  HexMaterials measure(const HexList& hexes, std::span<const GlobalId> element,
                       std::span<const double> value) const {
    return has_geometry(deck_) ? materials_of_source(comm_, deck_, hexes, log_)
                               : materials_of_variables(comm_, path(), mesh_.variables, element, value);
  }

  Overlay on_mesh() {
    if (!mesh_.decomposed && comm_.size() > 1) {
      repartition(comm_, mesh_.share, partition_method(deck_));
      stages_.end("partition");
    }
    const int layers = layer_plan(deck_).ghost_layers();
    UnstructuredMesh full = unstructured_mesh(comm_, mesh_.share, layers);
    mesh_.share = {};
    Overlay overlay;
    overlay.cells = std::move(full.cells);
    HexMesh& cells = overlay.cells;
    set_units(cells);
    std::vector<std::uint8_t> kept(cells.hexes.size());
    for (std::size_t c = 0; c < kept.size(); ++c) kept[c] = kept_block_[at(full.block[c])];
    overlay.sets = collect_sets(cells);
    find_exterior(comm_, cells, face_neighbours(cells), kept, exterior_options(cells, overlay.sets));
    refuse_pinched(cells);
    tell_exterior(cells);
    stages_.end("distribute");

    // The hexes that receive the microstructure.
    std::vector<LocalId> cell;
    std::vector<GlobalId> element;
    std::vector<double> value;
    std::vector<std::int32_t> block;  // of each
    std::size_t owned = 0;
    const std::size_t per_hex = mesh_.variables.size();
    for (LocalId c = 0; c < cells.size(); ++c) {
      if (cells.layer[at(c)] != 0) continue;
      const std::size_t first = per_hex * owned++;
      if (kept[at(c)]) continue;
      cell.push_back(c);
      element.push_back(cells.hex_id[at(c)]);
      block.push_back(full.block[at(c)]);
      value.insert(value.end(), full.value.begin() + static_cast<std::ptrdiff_t>(first),
                   full.value.begin() + static_cast<std::ptrdiff_t>(first + per_hex));
    }
    refuse_empty_blocks(cell.size());
    HexMaterials materials =
        measure({cell.size(), [&](std::size_t h) { return cells.corners(cell[h]); }}, element, value);
    if (!keeps_blocks()) block.clear();
    const std::vector<std::int32_t> material_of_block =
        add_blocks(comm_, deck_, materials, {block_ids(), kept_block_, std::move(block)}, log_);
    for (std::size_t b = 0; b < mesh_.blocks.size(); ++b)
      if (material_of_block[b] != kNone && !mesh_.blocks[b].name.empty())
        overlay.block_names[mesh_.blocks[b].id] = mesh_.blocks[b].name;

    if (keeps_blocks()) {
      overlay.is_block.assign(materials.table.block_id.size(), 0);
      for (const std::int32_t m : material_of_block) overlay.is_block[at(m)] = 1;
    }
    overlay.materials = std::move(materials.table);
    overlay.exact = std::move(materials.exact);
    overlay.geometry = std::move(materials.geometry);
    overlay.pure = materials.pure;
    if (restricted()) {
      overlay.kept = cells;
      overlay.kept->material.resize(kept.size(), 0);
      for (std::size_t c = 0; c < kept.size(); ++c)
        if (kept[c]) overlay.kept->material[c] = material_of_block[at(full.block[c])];
      std::vector<std::uint8_t> others(kept.size());
      for (std::size_t c = 0; c < kept.size(); ++c) others[c] = !kept[c];
      overlay.kept->exterior = {};
      (void)remove_hexes(comm_, *overlay.kept, others);
      cells.material.assign(kept.size(), 0);
      (void)remove_hexes(comm_, cells, kept);
    }
    cells.material.assign(cells.hexes.size(), 0);
    overlay.fractions = with_ghosts(cells, materials.owned);
    stages_.end("volume fractions");
    return overlay;
  }

  // Layers of two parts cannot end at one edge.
  void refuse_pinched(const HexMesh& cells) const {
    Finding pinched;
    if (const GlobalId id = cells.exterior.pinched; id >= 0) {
      const auto found = std::lower_bound(cells.node_id.begin(), cells.node_id.end(), id);
      const Vec3& p = cells.position[static_cast<std::size_t>(found - cells.node_id.begin())];
      pinched = {
          id, fmt::format("'{}': the hexes {} touch each other along an edge only, at node {} ({:g}, {:g}, "
                          "{:g}); expected two boundary faces at every edge of their boundary",
                          path(), restricted() ? "that input_mesh_blocks fills" : "of the mesh", id + 1, p.x,
                          p.y, p.z)};
    }
    refuse_first(comm_, pinched);
  }
  void refuse_empty_blocks(std::size_t mine) const {
    if (comm_.sum(static_cast<std::int64_t>(mine)) == 0)
      throw AgreedError(
          fmt::format("option 'input_mesh_blocks' ({}): the blocks to be filled have no hexes in '{}'",
                      deck_.given_options.place("input_mesh_blocks"), path()));
  }
  void tell_exterior(const HexMesh& cells) const {
    const Exterior& exterior = cells.exterior;
    std::int64_t facets = 0;
    for (const ExteriorFace& f : exterior.faces) facets += cells.layer[at(f.hex)] == 0;
    log_.line("  {} boundary faces in {} surfaces, {} of them curved (feature_angle = {:g})",
              comm_.sum(facets), exterior.curved.size(),
              std::count(exterior.curved.begin(), exterior.curved.end(), 1), deck_.feature_angle);
  }

  // Side sets as faces of the local cells, and node sets, of the input mesh. Every rank has all node sets.
  [[nodiscard]] InputSets collect_sets(const HexMesh& cells) const {
    InputSets sets;
    if (!carries_sets(deck_)) return sets;
    sets.wanted = true;
    struct Entry {
      GlobalId element;
      std::int32_t face;
      auto operator<=>(const Entry&) const = default;
    };
    for (const InputMesh::SideSet& set : mesh_.side_sets) {
      sets.side_sets.push_back({set.id, set.name});
      std::vector<Entry> mine;
      for (std::size_t i = 0; i < set.element.size(); ++i) mine.push_back({set.element[i], set.face[i]});
      std::vector<Entry> all = comm_.concatenate(mine);  // some programs list a face twice
      std::sort(all.begin(), all.end());
      all.erase(std::unique(all.begin(), all.end()), all.end());
      for (const Entry& e : all)
        if (std::binary_search(cells.hex_id.begin(), cells.hex_id.end(), e.element))
          sets.faces.push_back({e.element, e.face, set.id});
    }
    for (const InputMesh::NodeSet& set : mesh_.node_sets) {
      sets.node_sets.push_back({set.id, set.name});
      std::vector<GlobalId> nodes = comm_.concatenate(set.node);
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
      sets.nodes.push_back(std::move(nodes));
    }
    return sets;
  }

  [[nodiscard]] ExteriorOptions exterior_options(const HexMesh& cells, const InputSets& sets) const {
    ExteriorOptions options;
    options.feature_angle = deck_.feature_angle;
    options.slides = deck_.exterior_sliding == kSlidingSurface;
    if (!sets.faces.empty()) {
      // Faces in the same sets have the same label.
      auto label = std::make_shared<std::map<std::pair<GlobalId, std::int32_t>, std::int64_t>>();
      for (const SidePlan::Item& f : sets.faces) {
        std::int64_t& l = (*label)[{f.cell, f.at}];
        l = static_cast<std::int64_t>(lot_of(l) ^ lot_of(f.set));
      }
      options.label = [label, &cells](LocalId cell, int face) {
        const auto found = label->find({cells.hex_id[at(cell)], face});
        return found == label->end() ? std::int64_t{0} : found->second;
      };
    }
    return options;
  }

  const Comm& comm_;
  const Deck& deck_;
  const Log& log_;
  Stages& stages_;
  InputMesh mesh_;
  std::vector<std::uint8_t> kept_block_;  // per block
};

}  // namespace

void set_units(HexMesh& cells) {
  std::vector<double> shortest(cells.position.size(), std::numeric_limits<double>::infinity());
  for (const Hex& hex : cells.hexes)
    for (std::size_t c = 0; c < 8; ++c)
      for (const int d : kCornerNeighbours[c]) {
        const LocalId n = hex[c];
        shortest[at(n)] =
            std::min(shortest[at(n)],
                     norm(cells.position[at(hex[static_cast<std::size_t>(d)])] - cells.position[at(n)]));
      }
  cells.node_unit.clear();
  for (const double s : shortest) cells.node_unit.push_back(static_cast<float>(s / cells.cell_size.x));
  cells.node_exchange.copy_to_ghosts(cells.node_unit);  // the outermost ghosts lack cells
}

bool has_input_mesh(const Deck& deck) { return !deck.input_mesh.empty() || !deck.input_mesh_pamgen.empty(); }

Overlay read_unstructured(const Comm& comm, const Deck& deck, const Log& log, Stages& stages) {
  return InputMeshOverlay(comm, deck, log, stages).run();
}

}  // namespace sculpt
