#include "pipeline/periodicity.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sculpt {
namespace {

constexpr char kAxisName[] = "xyz";
constexpr double kSlice = 1e-3;  // of a cell

// The largest difference found so far and where it is.
struct Difference {
  double value = 0;
  std::int64_t key = std::numeric_limits<std::int64_t>::max();  // of equal ones the smallest counts
  std::size_t axis = 0;
  bool beyond_high = false;  // the cell outside lies beyond the high side
  Index3 inside{0, 0, 0};    // the cell of the grid one period away from it
  std::int32_t material = 0;
  double fraction_inside = 0, fraction_outside = 0;
};

// Compares cells 0 and 1 of a list, material by material.
void compare(const Fractions& pair, Difference here, Difference& worst) {
  for (const std::int32_t material : pair.material) {
    here.material = material;
    here.fraction_inside = fraction_of(pair, 0, material);
    here.fraction_outside = fraction_of(pair, 1, material);
    here.value = std::fabs(here.fraction_inside - here.fraction_outside);
    if (here.value > worst.value || (here.value == worst.value && here.key < worst.key)) worst = here;
  }
}

// Over the cells at the periodic sides.
Difference worst_difference(const Grid& grid, const std::array<bool, 3>& periodic, const IndexBox& cells,
                            MaterialField& field) {
  Difference worst;
  for (std::size_t d = 0; d < 3; ++d) {
    if (!periodic[d]) continue;
    const double period = grid.planes[d].back() - grid.planes[d].front();
    for (const bool beyond_high : {false, true}) {
      IndexBox inside = cells;
      (beyond_high ? inside.hi[d] : inside.lo[d]) = beyond_high ? 1 : grid.cells[d] - 1;
      inside = intersection(inside, cells);
      for (std::int64_t c = 0; c < inside.size(); ++c) {
        const Index3 cell = inside.cell(c);
        // A slice at the side: shapes that end inside the grid need no copy beyond the other side.
        Box slice{grid.corner(cell), grid.corner({cell[0] + 1, cell[1] + 1, cell[2] + 1})};
        const double thickness = kSlice * (slice.hi[d] - slice.lo[d]);
        if (beyond_high)
          slice.hi[d] = slice.lo[d] + thickness;
        else
          slice.lo[d] = slice.hi[d] - thickness;
        Fractions pair;
        field.measure(slice, pair);
        slice.lo[d] += beyond_high ? period : -period;
        slice.hi[d] += beyond_high ? period : -period;
        field.measure(slice, pair);
        const std::int64_t key =
            6 * grid.cell_id(cell) + static_cast<std::int64_t>(2 * d) + (beyond_high ? 1 : 0);
        compare(pair, {0, key, d, beyond_high, cell, 0, 0, 0}, worst);
      }
    }
  }
  return worst;
}

Error not_periodic(const Difference& d, const Grid& grid, const MaterialTable& materials, double tolerance) {
  Vec3 p;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::vector<double>& planes = grid.planes[k];
    const auto i = static_cast<std::size_t>(d.inside[k]);
    p[k] = 0.5 * (planes[i] + planes[i + 1]);
  }
  const double period = grid.planes[d.axis].back() - grid.planes[d.axis].front();
  return Error(fmt::format(
      "check_periodic: the geometry is not periodic in {}: the side of the cell at ({:g}, {:g}, {:g}) has "
      "{:.4f} of "
      "material {}, the place one period ({:g}) {} has {:.4f}; check_periodic_tol = {:g}. Repeat the shapes "
      "beyond the sides of the grid that they cross, or go on with check_periodic = false",
      kAxisName[d.axis], p.x, p.y, p.z, d.fraction_inside,
      materials.block_id[static_cast<std::size_t>(d.material)], period,
      d.beyond_high ? "farther, just outside," : "before, just outside,", d.fraction_outside, tolerance));
}

}  // namespace

std::array<bool, 3> periodic_axes(const Deck& deck, const Index3& cells) {
  std::array<bool, 3> axes{false, false, false};
  for (std::size_t d = 0; d < 3; ++d) {
    axes[d] = deck.periodic && (deck.periodic_directions >> d & 1) != 0;
    if (axes[d] && cells[d] < 2)
      throw Error(fmt::format(
          "periodic: the grid has 1 cell in {0}, but a node there would be its own neighbour; at least 2 are "
          "needed, or periodic_directions without {0}",
          kAxisName[d]));
  }
  return axes;
}

std::array<std::array<std::int64_t, 2>, 3> periodic_node_sets(const Deck& deck) {
  std::array<std::array<std::int64_t, 2>, 3> ids{};
  auto next = deck.periodic_nodesets.begin();
  for (std::size_t d = 0; d < 3 && next != deck.periodic_nodesets.end(); ++d)
    if ((deck.periodic_directions >> d & 1) != 0)
      for (std::int64_t& id : ids[d]) id = *next++;
  return ids;
}

void check_period(const Comm& comm, const Deck& deck, const Grid& grid, const std::array<bool, 3>& periodic,
                  const IndexBox& cells, MaterialField& field, const MaterialTable& materials,
                  const Log& log) {
  Difference worst;
  collectively(comm, "checking the period", [&] { worst = worst_difference(grid, periodic, cells, field); });
  const double largest = comm.max(worst.value);
  const std::int64_t first =
      comm.min(worst.value == largest ? worst.key : std::numeric_limits<std::int64_t>::max());
  collectively(comm, "checking the period", [&] {
    if (largest > deck.check_periodic_tol && worst.key == first)
      throw not_periodic(worst, grid, materials, deck.check_periodic_tol);
  });
  log.line("check_periodic: volume fractions one period apart differ by at most {:.2g}", largest);
}

}  // namespace sculpt
