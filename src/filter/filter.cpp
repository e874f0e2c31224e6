#include "sculpt/filter/filter.hpp"

#include <fmt/core.h>

#include "filter/edits.hpp"

namespace sculpt {
namespace {

// micro_shave. Returns the number of cells changed on all ranks.
std::int64_t shave_boundary(Edits& edits, std::int32_t to) {
  std::vector<LocalId> isolated;
  for (LocalId c = 0; c < edits.mesh.size(); ++c) {
    if (!edits.owned(c) || edits.locked(c) || edits.material(c) == to) continue;
    bool on_box = false, alone = true, has_neighbour = false;
    for (const LocalId n : edits.neighbours[at(c)]) {
      on_box = on_box || n == kNone;
      if (n == kNone) continue;
      has_neighbour = true;
      alone = alone && edits.material(n) != edits.material(c);
    }
    if (on_box && alone && has_neighbour) isolated.push_back(c);
  }
  for (const LocalId c : isolated) edits.change_owned(c, to);
  edits.share();
  return edits.comm().sum(static_cast<std::int64_t>(isolated.size()));
}

}  // namespace

FilterReport filter_materials(HexMesh& mesh, const Fractions& fractions, const FaceNeighbours& neighbours,
                              const NodeHexes& around, const FilterOptions& options,
                              const std::function<void(const std::string&)>& said) {
  Edits edits(mesh, fractions, neighbours, around);
  FilterReport report;
  edits.count_materials();
  if (options.keep_materials > 0) edits.lock_materials(options.keep_materials);
  if (options.shave_to) report.shaved = shave_boundary(edits, *options.shave_to);
  ManifoldRepair repair(edits);
  Protrusions protrusions(edits, options.defeature_box);
  Collapses collapses(edits);
  const bool rounds = options.defeature || options.collapse;
  std::int64_t changes = 1;
  while (rounds && changes > 0 && report.rounds < options.defeature_rounds) {
    const IslandReport islands =
        options.defeature ? remove_islands(edits, options.min_vol_cells - 1) : IslandReport{};
    const std::int64_t protruding = options.defeature ? protrusions.run() : 0;
    std::int64_t repaired = repair.run(report);
    const std::int64_t collapsed = options.collapse ? collapses.run() : 0;
    changes = islands.cells + protruding + repaired + collapsed;
    if (options.reversals && changes == 0) changes = repaired = repair.remove_reversals(report);
    ++report.rounds;
    report.islands += islands.islands;
    report.island_cells += islands.cells;
    report.protrusions += protruding;
    report.collapses += collapsed;
    if (said)
      said(fmt::format(
          "defeature iter {}: {} islands ({} cells), {} protrusions, {} cells for manifolds, {} collapsed",
          report.rounds, islands.islands, islands.cells, protruding, repaired, collapsed));
  }
  report.settled = !rounds || changes == 0;
  repair.run(report);
  if (options.reversals && (!rounds || !report.settled)) repair.remove_reversals(report);
  return report;
}

}  // namespace sculpt
