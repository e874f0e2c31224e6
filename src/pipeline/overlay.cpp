#include "pipeline/overlay.hpp"

#include "pipeline/adapted_overlay.hpp"
#include "pipeline/console.hpp"
#include "pipeline/idle_options.hpp"
#include "pipeline/layers.hpp"
#include "pipeline/periodicity.hpp"
#include "pipeline/unstructured_overlay.hpp"
#include "pipeline/vfrac_source.hpp"
#include "sculpt/distribute/cartesian.hpp"
#include "sculpt/vfrac/fractions.hpp"

namespace sculpt {
namespace {

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

// The cells of the grid as they are.
Overlay read_uniform(const Comm& comm, const Deck& deck, MaterialSource& source, const Grid& grid,
                     const Log& log, Stages& stages) {
  CartesianParts parts = cut_grid(grid.cells, comm.size(), {deck.iproc, deck.jproc, deck.kproc});
  parts.periodic = periodic_axes(deck, grid.cells);
  print_decomposition(log, parts);
  const int layers = layer_plan(deck).ghost_layers();

  // The ghosts of a periodic grid are no box of the source: their fractions come from their owners.
  std::vector<IndexBox> wanted;
  for (int r = 0; r < comm.size(); ++r)
    wanted.push_back(deck.periodic
                         ? parts.owned(r)
                         : source_of(parts.ghosted(r, layers), deck.micro_expand, source.grid().cells));
  MaterialData data = source.read(comm, wanted);
  if (deck.periodic && deck.check_periodic && !source.is_data())
    check_period(comm, deck, grid, parts.periodic, parts.owned(comm.rank()),
                 *source.field({}, parts.owned(comm.rank())), data.table, log);
  stages.end(source.is_data() ? "read input" : "volume fractions");

  Overlay overlay{lattice_mesh(comm, grid, parts, layers),
                  std::move(data.fractions),
                  std::move(data.table),
                  {},
                  {},
                  grid.cells,
                  source.axes(),
                  numbered_grid(parts, layers),
                  true,
                  source.exact_surface(),
                  source.features(),
                  wanted_surfaces(deck, source),
                  {},
                  {},
                  {},
                  {}};
  if (deck.periodic) overlay.fractions = with_ghosts(overlay.cells, overlay.fractions);
  const bool pure = overlay.fractions.material.size() == static_cast<std::size_t>(overlay.fractions.cells());
  overlay.pure = comm.min(std::int64_t{pure}) == 1;
  if (deck.micro_expand > 0)
    overlay.fractions =
        expand_fractions(overlay.fractions, wanted[static_cast<std::size_t>(comm.rank())],
                         parts.ghosted(comm.rank(), layers), deck.micro_expand, source.grid().cells);
  stages.end("distribute");
  return overlay;
}

}  // namespace

GeometrySurfaces wanted_surfaces(const Deck& deck, const MaterialSource& source) {
  if (deck.gen_sidesets != kSidesetsGeometricSurfaces && deck.gen_sidesets != kSidesetsGeometricSidesets &&
      deck.gen_sidesets != kSidesetsInputMeshAndStl)
    return {};
  GeometrySurfaces surfaces = source.geometry_surfaces();
  check(!surfaces.empty(), "the geometry does not tell its surfaces");
  return surfaces;
}

Overlay read_on_grid(const Comm& comm, const Deck& deck, MaterialSource& source, const Log& log,
                     Stages& stages) {
  for (const std::string& idle : idle_adapt_options(deck)) log.line("WARNING: {}", idle);
  if ((deck.given("check_periodic") || deck.given("check_periodic_tol")) &&
      (!deck.periodic || source.is_data()))
    log.line("WARNING: {}; no effect: check_periodic",
             deck.periodic ? "data on a grid are taken as one period" : "the mesh is not periodic");
  const Grid grid = overlay_grid(deck, source.grid());
  return is_adapted(deck) ? read_adapted(comm, deck, source, grid, log, stages)
                          : read_uniform(comm, deck, source, grid, log, stages);
}

Overlay read_overlay(const Comm& comm, const Deck& deck, const Log& log, Stages& stages) {
  for (const std::string& idle : idle_grid_options(deck)) log.line("WARNING: {}", idle);
  if (has_input_mesh(deck)) return read_unstructured(comm, deck, log, stages);
  const auto source =
      deck.input_vfrac.empty() ? open_source(comm, deck, log, std::nullopt) : open_vfrac(comm, deck, log);
  if (!source->is_data()) stages.end("read geometry");
  return read_on_grid(comm, deck, *source, log, stages);
}

}  // namespace sculpt
