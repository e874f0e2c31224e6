#include "pipeline/console.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <ctime>

namespace sculpt {
namespace {

constexpr std::size_t kLines = 20;  // most lines of a list of hexes or blocks

std::string time_text() {
  const std::time_t now = std::time(nullptr);
  std::string text = std::ctime(&now);
  text.pop_back();
  return text;
}

void print_hex(const Log& log, const QualityReport& report, const ListedHex& hex, const char* begin,
               const char* end) {
  std::int64_t block = 0;
  for (const auto& b : report.blocks)
    if (b.material == hex.material) block = b.id;
  log.line("{} hex {} of block {} at {:g} {:g} {:g}: scaled Jacobian {:f}{}", begin, hex.element, block,
           hex.centre.x, hex.centre.y, hex.centre.z, hex.scaled_jacobian, end);
}

// Hexes that no solver can use.
void print_invalid(const Log& log, const QualityReport& report) {
  const QualitySummary& q = report.summary;
  if (q.not_positive_inside == 0) return;
  log.line("WARNING: the Jacobian of {} hexes is not positive everywhere inside", q.not_positive_inside);
  for (std::size_t i = 0; i < std::min(kLines, q.invalid.size()); ++i)
    print_hex(log, report, q.invalid[i],
              "WARNING:", q.invalid[i].scaled_jacobian > 0 ? ", folds inside" : "");
}

// Valid hexes below the floor that was asked for, as far as the list of the worst hexes goes.
void print_below_floor(const Log& log, const QualityReport& report, double floor) {
  std::vector<const ListedHex*> below;
  for (const ListedHex& hex : report.summary.worst)
    if (hex.scaled_jacobian < floor && hex.valid != 0) below.push_back(&hex);
  if (below.empty()) return;
  if (below.size() > kLines) below.resize(kLines);
  log.line("  Worst valid hexes below {:g}:", floor);
  for (const ListedHex* hex : below) print_hex(log, report, *hex, "   ", "");
}

void print_fidelity(const Log& log, const QualityReport& report) {
  const Displacement& d = report.displacement;
  log.line("  Min Edge Len (cells)  {:f}", report.summary.shortest_edge_cells);
  log.line("  Interface Kink (deg)  {:f}", report.kink.mean);
  log.line("  From Contour (cells)  max {:f}, mean {:f}", d.largest_from_contour, d.mean_from_contour);
  log.line("  From Target (cells)   max {:f}, mean {:f}", d.largest_from_target, d.mean_from_target);
  log.line("  Volume Moved (%)      {:f}", report.volume_moved);
}

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
                        const QualityReport& report) {
  const QualitySummary& quality = report.summary;
  log.line();
  log.line("MESH SUMMARY");
  log.line("  Base Filename         {}", deck.exodus_file);
  log.line("  Num Procs             {}", comm.size());
  log.line("  Num Nodes             {}", written.nodes);
  log.line("  Num Elements          {}", written.hexes);
  log.line("  Num Blocks            {}", written.blocks);
  log.line("  Num Nodesets          {}", written.node_sets);
  log.line("  Num Sidesets          {}", written.side_sets);
  log.line("  Num Bad Qual (SJ<0)   {}", quality.not_positive);
  log.line("  Num Poor Qual (SJ<0.2) {}", quality.below_02);
  log.line("  Min Quality           {:f}", quality.least);
  log.line("  Avg Quality           {:f}", quality.average);
  log.line("  Min Edge Len          {:f}", quality.shortest_edge);
  log.line("  Min Qual Rank         {}", quality.worst.empty() ? 0 : quality.worst.front().owner);
  print_fidelity(log, report);
  print_below_floor(
      log, report,
      deck.max_gq_iters > 0 ? std::max(deck.pcol_threshold, deck.gq_threshold) : deck.pcol_threshold);
  print_invalid(log, report);
}

void print_volumes(const Log& log, const QualityReport& report) {
  log.line();
  log.line("VOLUME COMPARISON");
  log.line("  {:>10} {:>18} {:>18} {:>10}", "Material", "Input Volume", "Mesh Volume", "Error (%)");
  const auto row = [&](const std::string& name, double input, double meshed) {
    log.line("  {:>10} {:>18.6f} {:>18.6f} {:>10.4f}", name, input * report.cell_volume,
             meshed * report.cell_volume, input > 0 ? 100 * (meshed - input) / input : 0.0);
  };
  double input = 0, meshed = 0;
  for (const auto& block : report.blocks) {
    const double volume = report.of(block).volume;
    row(std::to_string(block.id), block.input_volume, volume);
    input += block.input_volume;
    meshed += volume;
  }
  row("Total", input, meshed);
}

void print_side_sets(const Log& log, std::span<const SideSetStats> stats,
                     const std::map<std::int64_t, std::string>& names) {
  log.line();
  log.line("SIDESETS");
  log.line("  {:>8} {:>9} {:>14} {:>9} {:>9} {:>9}  {:<38}  {}", "Id", "Faces", "Area", "Min SJ", "Avg SJ",
           "Max SJ", "Bounds", "Name");
  for (const SideSetStats& s : stats) {
    const auto name = names.find(s.id);
    const auto& [lo, hi] = s.bounds;
    log.line(
        "  {:>8} {:>9} {:>14.6g} {:>9.4f} {:>9.4f} {:>9.4f}  {:<38}  {}", s.id, s.faces, s.area, s.least,
        s.mean, s.most,
        s.faces == 0 ? "" : fmt::format("{:g} {:g} {:g}, {:g} {:g} {:g}", lo.x, lo.y, lo.z, hi.x, hi.y, hi.z),
        name == names.end() ? "" : name->second);
  }
}

void print_removed(const Log& log, const Deck& deck, const MaterialTable& materials,
                   const std::vector<std::int64_t>& removed) {
  std::int64_t all = 0;
  std::string blocks;
  std::size_t listed = 0;
  for (std::size_t m = 0; m < removed.size(); ++m) {
    if (removed[m] == 0) continue;
    all += removed[m];
    if (++listed <= kLines)
      blocks +=
          fmt::format("{}{} of block {}", blocks.empty() ? "" : ", ", removed[m], materials.block_id[m]);
  }
  if (listed > kLines) blocks += fmt::format(", and others in {} more blocks", listed - kLines);
  log.line("remove_bad = {:g}: {} hexes removed{}{}", deck.remove_bad, all, all > 0 ? ": " : "", blocks);
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

}  // namespace sculpt
