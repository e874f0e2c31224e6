#include "pipeline/console.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <ctime>

namespace sculpt {
namespace {

constexpr double kUnits =
    1073741824.0;  // 2^30 per unit of volume of a cell: sums of integers do not depend on ranks

std::string time_text() {
  const std::time_t now = std::time(nullptr);
  std::string text = std::ctime(&now);
  text.pop_back();
  return text;
}

double cell_volume(const HexMesh& mesh) { return mesh.cell_size.x * mesh.cell_size.y * mesh.cell_size.z; }

}  // namespace

void print_decomposition(const Log& log, const CartesianParts& parts) {
  constexpr char kAxis[3] = {'X', 'Y', 'Z'};
  const IndexBox first = parts.owned(0);
  log.line("Decomposing Cartesian grid for parallel...");
  for (std::size_t d = 0; d < 3; ++d)
    log.line("  Rank 0 Number of cells/segment in directions {}   {}", kAxis[d], first.extent(d));
  for (std::size_t d = 0; d < 3; ++d)
    log.line("  Global Number of grid segments in directions {}   {}", kAxis[d], parts.segments[d]);
}

void print_mesh_summary(const Comm& comm, const Log& log, const Deck& deck, const WriteSummary& written,
                        const QualitySummary& quality) {
  log.line();
  log.line("MESH SUMMARY");
  log.line("  Base Filename         {}", deck.exodus_file);
  log.line("  Num Procs             {}", comm.size());
  log.line("  Num Nodes             {}", written.nodes);
  log.line("  Num Elements          {}", written.hexes);
  log.line("  Num Blocks            {}", written.blocks);
  log.line("  Num Nodesets          0");
  log.line("  Num Sidesets          {}", written.side_sets);
  log.line("  Num Bad Qual (SJ<0)   {}", quality.not_positive);
  log.line("  Num Poor Qual (SJ<0.2) {}", quality.below_02);
  log.line("  Min Quality           {:f}", quality.least);
  log.line("  Avg Quality           {:f}", quality.average);
  log.line("  Min Edge Len          {:f}", quality.shortest_edge);
  log.line("  Min Qual Rank         {}", quality.least_rank);
  if (quality.hexes > 0 && quality.least < deck.pcol_threshold)
    log.line("  Worst hex at          {:g} {:g} {:g}", quality.least_at.x, quality.least_at.y,
             quality.least_at.z);
  if (quality.not_positive_inside > 0)
    log.line("WARNING: the Jacobian of {} hexes is not positive everywhere inside",
             quality.not_positive_inside);
}

void print_end(const Comm& comm, const Log& log, double seconds) {
  const std::vector<double> all = comm.gather_all(seconds);
  std::size_t slow = 0;
  double total = 0;
  for (std::size_t r = 0; r < all.size(); ++r) {
    total += all[r];
    if (all[r] > all[slow]) slow = r;
  }
  log.line("Job Completed {}", time_text());
  log.line("Elapsed Time          {:f} sec. ({:f} min.)", all[slow], all[slow] / 60);
  log.line("Total Time on {} Procs {:f} sec. ({:f} min.)", comm.size(), total, total / 60);
  log.line("Slow Rank             {}", slow);
  log.line("Done!");
}

VolumeTable::VolumeTable(const Comm& comm, const HexMesh& cells, const Fractions& fractions,
                         const MaterialTable& materials)
    : block_id_(materials.block_id) {
  std::vector<std::int64_t> units(block_id_.size(), 0);
  for (std::size_t c = 0; c < cells.hexes.size(); ++c) {
    if (cells.layer[c] != 0) continue;
    for (auto e = static_cast<std::size_t>(fractions.offset[c]);
         e < static_cast<std::size_t>(fractions.offset[c + 1]); ++e)
      units[static_cast<std::size_t>(fractions.material[e])] += std::llround(kUnits * fractions.value[e]);
  }
  comm.sum(units);
  for (const std::int64_t u : units) volume_.push_back(static_cast<double>(u) / kUnits * cell_volume(cells));
}

void VolumeTable::compare(const Comm& comm, const HexMesh& mesh, const Log& log) const {
  std::vector<std::int64_t> units(block_id_.size(), 0);
  for (LocalId h = 0; h < mesh.size(); ++h)
    if (mesh.layer[static_cast<std::size_t>(h)] == 0)
      units[static_cast<std::size_t>(mesh.material[static_cast<std::size_t>(h)])] +=
          std::llround(kUnits * hex_volume(mesh.corners(h)) / cell_volume(mesh));
  comm.sum(units);
  log.line();
  log.line("VOLUME COMPARISON");
  log.line("  {:>10} {:>18} {:>18} {:>10}", "Material", "Input Volume", "Mesh Volume", "Error (%)");
  for (std::size_t m = 0; m < block_id_.size(); ++m) {
    const double meshed = static_cast<double>(units[m]) / kUnits * cell_volume(mesh);
    log.line("  {:>10} {:>18.6f} {:>18.6f} {:>10.4f}", block_id_[m], volume_[m], meshed,
             volume_[m] > 0 ? 100 * (meshed - volume_[m]) / volume_[m] : 0.0);
  }
}

}  // namespace sculpt
