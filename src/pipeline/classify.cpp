#include "pipeline/classify.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/thickening.hpp"
#include "sculpt/base/fixed_point.hpp"
#include "sculpt/filter/filter.hpp"
#include "sculpt/filter/thicken.hpp"
#include "sculpt/vfrac/fractions.hpp"

namespace sculpt {
namespace {

constexpr int kSeparations = 5;  // rounds of separating and filtering; one is enough but for odd places

std::int32_t material_with_id(const MaterialTable& materials, std::int64_t id, const Deck& deck) {
  const auto found = std::find(materials.block_id.begin(), materials.block_id.end(), id);
  if (found != materials.block_id.end()) return static_cast<std::int32_t>(found - materials.block_id.begin());
  std::string known;
  for (std::size_t m = 0; m < std::min<std::size_t>(materials.block_id.size(), 10); ++m)
    known += fmt::format(" {}", materials.block_id[m]);
  throw Error(fmt::format(
      "option 'thicken_material' ({}): no material with id {} in the input; it has {} material{}:{}{}",
      deck.given_options.place("thicken_material"), id, materials.block_id.size(),
      materials.block_id.size() == 1 ? "" : "s", known, materials.block_id.size() > 10 ? " ..." : ""));
}

FilterOptions filter_options(const Deck& deck, const MaterialTable& materials) {
  FilterOptions o;
  const bool first_is_void = materials.void_material == 0 && materials.block_id.size() > 1;
  if (deck.micro_shave) o.shave_to = first_is_void ? 1 : 0;
  o.defeature = deck.defeature == kDefeatureFilter || deck.defeature == kDefeatureAll;
  o.collapse = deck.defeature == kDefeatureCollapse || deck.defeature == kDefeatureAll;
  o.min_vol_cells = deck.min_vol_cells;
  o.defeature_box = deck.defeature_bbox;
  o.defeature_rounds = deck.defeature_iters;
  o.reversals = deck.resolve_reversals;
  if (deck.keep_materials) o.keep_materials = static_cast<std::int64_t>(materials.block_id.size());
  return o;
}

void report_filter(const Deck& deck, const FilterReport& report, const Log& log) {
  if (deck.micro_shave)
    log.line("  micro_shave: {} isolated cells at the boundary reassigned", report.shaved);
  log.line("  {} non-manifold nodes, {} cells reassigned in {} passes", report.bad_nodes,
           report.manifold_cells, report.manifold_passes);
  if (deck.resolve_reversals) log.line("  {} nodes with reversals", report.reversals);
  if (report.forced_nodes > 0)
    log.line("  WARNING: {} nodes were settled by merging their materials", report.forced_nodes);
  if (!report.settled)
    log.line("  WARNING: defeaturing did not settle in {} iterations; a larger defeature_iters lets it go on",
             report.rounds);
}

// stair = fast keeps the cells as they come.
void warn_of_idle_options(const Deck& deck, const Log& log) {
  std::string idle;
  const auto add = [&idle](bool given, const char* name) {
    if (given) idle += fmt::format("{}{}", idle.empty() ? "" : ", ", name);
  };
  add(deck.defeature != kDefeatureOff, "defeature");
  add(!deck.thicken_material.empty(), "thicken_material");
  add(deck.thicken_void > 0, "thicken_void");
  add(deck.micro_shave, "micro_shave");
  add(deck.resolve_reversals, "resolve_reversals");
  add(deck.keep_materials, "keep_materials");
  if (!idle.empty()) log.line("  WARNING: stair = fast filters nothing; no effect: {}", idle);
}

// The table's void, made when there is none.
std::int32_t void_of(MaterialTable& materials, const Deck& deck) {
  if (!materials.void_material) {
    const std::int64_t largest = *std::max_element(materials.block_id.begin(), materials.block_id.end());
    if (deck.void_mat == 0 && largest >= std::numeric_limits<std::int32_t>::max())
      throw Error(
          fmt::format("thicken_void needs an id for the void, but {} is taken; give void_mat", largest));
    materials.void_material = static_cast<std::int32_t>(materials.block_id.size());
    materials.block_id.push_back(deck.void_mat > 0 ? deck.void_mat : largest + 1);
  }
  return *materials.void_material;
}

// Owned cells of each material, all ranks.
std::vector<std::int64_t> count_cells(const Comm& comm, const HexMesh& cells, std::size_t materials) {
  std::vector<std::int64_t> count(materials, 0);
  for (std::size_t c = 0; c < cells.hexes.size(); ++c)
    if (cells.layer[c] == 0) ++count[static_cast<std::size_t>(cells.material[c])];
  comm.sum(count);
  return count;
}

// Says which materials of the input have no cell left.
void report_lost(const Comm& comm, const HexMesh& cells, const std::vector<std::int64_t>& before,
                 const MaterialTable& materials, const Log& log) {
  const std::vector<std::int64_t> after = count_cells(comm, cells, materials.block_id.size());
  std::string ids;
  std::int64_t lost = 0, lost_cells = 0;
  for (std::size_t m = 0; m < before.size(); ++m) {
    if (before[m] == 0 || after[m] > 0) continue;
    if (lost++ < 10) ids += fmt::format(" {}", materials.block_id[m]);
    lost_cells += before[m];
  }
  if (lost > 0)
    log.line("  {} of {} materials ({} cells) have no cell left:{}{}", lost, before.size(), lost_cells, ids,
             lost > 10 ? " ..." : "");
}

// Faces of owned cells towards other materials, per material, all ranks. Each counts with the volume of its
// cell, in cells of level 0: what a material gains there with the thickening value.
std::vector<double> areas(const Comm& comm, const HexMesh& cells, const FaceNeighbours& neighbours,
                          std::size_t materials) {
  std::vector<std::int64_t> units(materials, 0);
  for (std::size_t c = 0; c < cells.hexes.size(); ++c) {
    if (cells.layer[c] != 0) continue;
    std::int64_t faces = 0;
    for (const LocalId n : neighbours[c]) faces += n != kNone && cells.material[at(n)] != cells.material[c];
    if (faces > 0)
      units[at(cells.material[c])] += faces * to_units(cells.volume_in_cells(static_cast<LocalId>(c)));
  }
  comm.sum(units);
  std::vector<double> sums;
  for (const std::int64_t u : units) sums.push_back(from_units(u));
  return sums;
}

// The steps from fractions to materials, which may be tried with several thickening values.
class Classifier {
 public:
  Classifier(const Comm& comm, const Deck& deck, HexMesh& cells, Fractions& fractions,
             MaterialTable& materials, const FaceNeighbours& neighbours, const NodeHexes& around,
             const Log& log)
      : comm_(comm),
        deck_(deck),
        cells_(cells),
        fractions_(fractions),
        materials_(materials),
        neighbours_(neighbours),
        around_(around),
        log_(log) {}

  // Thickening by the lines of the deck, after its automatic values were found. Answers the volumes that the
  // materials with automatic lines should have, below 0 for the others.
  std::vector<double> run(const std::vector<double>& input_volume, const MeshVolumes& mesh_volumes) {
    std::vector<Thickening> lines;
    bool search = false;
    for (const MaterialValue& t : deck_.thicken_material) {
      const bool automatic = t.value == MaterialValue::kAuto;
      const auto same = [&t](const MaterialValue& o) {
        return o.id == t.id && o.value == MaterialValue::kAuto;
      };
      if (automatic && std::count_if(deck_.thicken_material.begin(), deck_.thicken_material.end(), same) > 1)
        throw Error(
            fmt::format("option 'thicken_material' ({}): material {} has more than one automatic value",
                        deck_.given_options.place("thicken_material"), t.id));
      lines.push_back({material_with_id(materials_, t.id, deck_), automatic ? 0 : t.value, automatic});
      search = search || automatic;
    }
    std::vector<double> wanted(materials_.block_id.size(), -1);
    if (search) {
      find(lines, input_volume, mesh_volumes);
      const double cell = cells_.cell_size.x * cells_.cell_size.y * cells_.cell_size.z;
      for (const Thickening& line : lines)
        if (line.automatic) wanted[at(line.material)] = cell * input_volume[at(line.material)];
    } else {
      thicken_and_filter(lines, log_);
    }
    wanted.resize(materials_.block_id.size(), -1);  // thicken_void may have added the void
    return wanted;
  }

 private:
  // Finds the automatic values and leaves the cells filtered with them.
  void find(std::vector<Thickening>& lines, const std::vector<double>& input_volume,
            const MeshVolumes& mesh_volumes) {
    const Fractions input = fractions_;
    const Log quiet(false);
    const auto run_trial = [&](const std::vector<Thickening>& trial) {
      fractions_ = input;
      assign_materials(cells_, fractions_, neighbours_);
      thicken_and_filter(trial, quiet);
      return ThickeningTrial{mesh_volumes(), areas(comm_, cells_, neighbours_, materials_.block_id.size())};
    };
    const ThickeningResult found = find_thickening(lines, input_volume, run_trial);
    for (const Thickening& line : lines)
      if (line.automatic)
        log_.line("  thicken_material = {} {:.6f}  (found by auto)", materials_.block_id[at(line.material)],
                  line.value);
    log_.line("  volumes reached within {:.3f} % in {} trials", 100 * found.error, found.trials);
    report_filter(deck_, report_, log_);
  }

  void thicken_and_filter(const std::vector<Thickening>& lines, const Log& log) {
    for (const Thickening& line : lines)
      if (line.value > 0) thicken(cells_, fractions_, neighbours_, around_, line.material, line.value);
    filter(log);
    if (deck_.thicken_void <= 0) return;
    const std::int32_t empty = void_of(materials_, deck_);
    for (int i = 0; i < kSeparations; ++i) {
      const std::int64_t emptied =
          separate_by_void(cells_, fractions_, around_, empty, deck_.thicken_void > 0.5);
      log.line("  thicken_void: {} cells between materials became void", emptied);
      if (emptied == 0) break;
      filter(log);
    }
  }

  void filter(const Log& log) {
    report_ = filter_materials(cells_, fractions_, neighbours_, around_, filter_options(deck_, materials_),
                               [&](const std::string& line) { log.line("  {}", line); });
    report_filter(deck_, report_, log);
    follow_assignment(fractions_, cells_.material);
  }

  const Comm& comm_;
  const Deck& deck_;
  HexMesh& cells_;
  Fractions& fractions_;
  MaterialTable& materials_;
  const FaceNeighbours& neighbours_;
  const NodeHexes& around_;
  const Log& log_;
  FilterReport report_;
};

}  // namespace

std::vector<double> classify(const Comm& comm, const Deck& deck, HexMesh& cells, Fractions& fractions,
                             MaterialTable& materials, const FaceNeighbours& neighbours,
                             std::optional<NodeHexes>& around, const std::vector<double>& input_volume,
                             const MeshVolumes& mesh_volumes, const Log& log, Stages& stages) {
  log.line("(2/9) classifying materials...");
  assign_materials(cells, fractions, neighbours);
  const std::vector<std::int64_t> input_cells = count_cells(comm, cells, materials.block_id.size());
  stages.end("classify materials");
  log.line("(3/9) resolving non-manifolds...");
  std::vector<double> wanted(materials.block_id.size(), -1);
  if (deck.stair == kStairFast) {
    warn_of_idle_options(deck, log);
    return wanted;
  }
  around.emplace(cells);
  wanted = Classifier(comm, deck, cells, fractions, materials, neighbours, *around, log)
               .run(input_volume, mesh_volumes);
  report_lost(comm, cells, input_cells, materials, log);
  collectively(comm, "resolving non-manifolds", [&] {
    check(interfaces_are_manifold(cells, neighbours, *around), "a material interface is not manifold");
  });
  stages.end("resolve non-manifolds");
  return wanted;
}

}  // namespace sculpt
