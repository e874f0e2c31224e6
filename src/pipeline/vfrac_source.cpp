#include "pipeline/vfrac_source.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "pipeline/hex_materials.hpp"
#include "sculpt/deck/parse.hpp"
#include "sculpt/distribute/cartesian_grid.hpp"
#include "sculpt/input/volfrac_files.hpp"
#include "sculpt/write/write_mesh.hpp"

namespace sculpt {
namespace {

constexpr std::int64_t kBlock = 1;  // of the cells in the files

// The option that names the input of the run; that of the files of input_vfrac is handed on.
std::string input_option(const Comm& comm, const Deck& deck) {
  if (!deck.input_vfrac.empty()) return find_volfrac_files(comm, deck.input_vfrac, Log(false)).block;
  for (const char* option : {"input_spn", "input_micro", "diatom_file", "stl_file", "input_cart_exo"})
    if (deck.given(option)) return option;
  return "input_mesh";
}

// The planes of the grid as they are in the files, where all nodes agree; the grid was recognised up to
// rounding.
void take_planes(const Comm& comm, const ElementShare& share, Grid& grid) {
  for (std::size_t d = 0; d < 3; ++d) {
    std::vector<double> places;
    places.reserve(share.position.size());
    for (const Vec3& p : share.position) places.push_back(p[d]);
    const auto sort = [&places] {
      std::sort(places.begin(), places.end());
      places.erase(std::unique(places.begin(), places.end()), places.end());
    };
    sort();
    places = comm.concatenate(places);
    sort();
    if (places.size() == grid.planes[d].size()) grid.planes[d] = std::move(places);
  }
}

void print_summary(const Log& log, const std::string& base, const VolfracFiles& files, const Grid& grid,
                   const MaterialTable& table) {
  const auto& [x, y, z] = grid.planes;
  log.line("Summary of imported volume fractions");
  log.line("  Base Name            {}", base);
  log.line("  Files                {}, the first is {}", files.names.size(), files.names[0]);
  log.line("  Written from         {}", files.block);
  log.line("  Intervals            {} {} {}", grid.cells[0], grid.cells[1], grid.cells[2]);
  log.line("  Grid Bounds Min      {:f} {:f} {:f}", x.front(), y.front(), z.front());
  log.line("  Grid Bounds Max      {:f} {:f} {:f}", x.back(), y.back(), z.back());
  log.line("  Number of Materials  {}", table.block_id.size());
}

}  // namespace

Deck with_defaults_of_fractions(const Comm& comm, const Deck& deck, const Log& log) {
  if (deck.input_vfrac.empty() || input_option(comm, deck) != "input_spn") return deck;
  Deck settled = deck;
  apply_voxel_defaults(settled);
  log.line(
      "The volume fractions come from input_spn, whose defaults are used: smooth, csmooth and "
      "laplacian_iters");
  return settled;
}

std::unique_ptr<MaterialSource> open_vfrac(const Comm& comm, const Deck& deck, const Log& log) {
  const VolfracFiles files = find_volfrac_files(comm, deck.input_vfrac, log);
  VolfracCells cells = read_volfrac(comm, deck.input_vfrac, files);
  std::optional<CartesianShare> shape = cartesian_grid_of(comm, cells.share);
  if (!shape)
    throw AgreedError(fmt::format(
        "'{}' is not a Cartesian grid of equal cells, each once; expected the files that volfrac_file writes "
        "without adapt_type and without a general input_mesh",
        deck.input_vfrac));
  take_planes(comm, cells.share, shape->grid);
  HexMaterials materials;
  materials.table = std::move(cells.table);
  materials.owned = std::move(cells.fractions);
  print_summary(log, deck.input_vfrac, files, shape->grid, materials.table);
  return grid_of_hexes(std::move(shape->grid), std::move(shape->cell), std::move(materials));
}

void write_fractions(const Comm& comm, const Deck& deck, Overlay& overlay, const Log& log, Stages& stages) {
  overlay.cells.material.assign(overlay.cells.hexes.size(), 0);
  WriteOptions options;
  options.base = deck.volfrac_file;
  options.large = deck.large_exodus;
  options.block_id = {kBlock};
  options.block_names[kBlock] = input_option(comm, deck);
  for (const std::string& name : volfrac_names(overlay.materials)) {
    const auto m = static_cast<std::int32_t>(options.variables.size());
    options.variables.push_back(
        {name, [&fractions = overlay.fractions, m](LocalId h) { return fraction_of(fractions, h, m); }});
  }
  const WriteSummary written = write_mesh(comm, overlay.cells, {}, options);
  log.line("volfrac_file: the fractions of {} materials in {} cells are in {}", options.variables.size(),
           written.hexes, options.base);
  stages.end("write fractions");
}

}  // namespace sculpt
