#include "input/geometry_grid.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "input/deck_grid.hpp"
#include "sculpt/base/error.hpp"

namespace sculpt {
namespace {

constexpr double kMargin = 2.5;            // cells beyond the geometry
constexpr double kFewCellsMargin = 0.1;    // of the size of the geometry, where there are too few for that
constexpr double kMostCells = 2147483647;  // per axis

// One axis of the grid that is to be.
struct Axis {
  const char* letter;
  bool has_lo, has_hi;
  double lo, hi;  // of the deck, where it gives them
  double geometry_lo, geometry_hi;
  std::int64_t cells;
};

std::string bound_name(const Axis& a, bool high) {
  return fmt::format("{}{}", a.letter, high ? "max" : "min");
}

// The size of the geometry from the bound of the deck on, or as it is.
double size_of(const Axis& a) {
  const double from = a.has_lo ? a.lo : a.geometry_lo, to = a.has_hi ? a.hi : a.geometry_hi;
  if (from < to) return to - from;
  if (!a.has_lo && !a.has_hi)
    throw Error(fmt::format("the geometry is flat: in {} it reaches from {} to {}", a.letter, a.geometry_lo,
                            a.geometry_hi));
  throw Error(fmt::format("{} = {} lies beyond the geometry, which reaches from {} to {}",
                          bound_name(a, a.has_hi), a.has_hi ? a.hi : a.lo, a.geometry_lo, a.geometry_hi));
}

// Puts the ends that the deck does not give this far beyond the geometry.
void grow(Axis& a, double margin) {
  if (!a.has_lo) a.lo = a.geometry_lo - margin;
  if (!a.has_hi) a.hi = a.geometry_hi + margin;
}

void fit_counts(Axis& a, const Deck& deck) {
  const int free_ends = !a.has_lo + !a.has_hi;
  if (free_ends == 0) return;
  const double size = size_of(a), inner = static_cast<double>(a.cells) - free_ends * kMargin;
  if (deck.given("bbox_expand"))
    grow(a, deck.bbox_expand / 100 * size);
  else
    grow(a, inner >= 1 ? kMargin * size / inner : kFewCellsMargin * size);
}

void fit_cell_size(Axis& a, const Deck& deck) {
  const int free_ends = !a.has_lo + !a.has_hi;
  const double h = deck.cell_size, size = size_of(a);
  double cells = std::round(size / h);
  if (free_ends > 0)
    cells = deck.given("bbox_expand") ? std::ceil(size * (1 + free_ends * deck.bbox_expand / 100) / h)
                                      : cells + std::ceil(free_ends * kMargin);
  if (!(cells < kMostCells))
    throw Error(fmt::format("cell_size = {}: more cells than can be numbered between {} and {}", h,
                            a.geometry_lo, a.geometry_hi));
  a.cells = std::max<std::int64_t>(1, static_cast<std::int64_t>(cells));
  const double length = static_cast<double>(a.cells) * h;
  if (free_ends == 2) {
    a.lo = 0.5 * (a.geometry_lo + a.geometry_hi) - 0.5 * length;
    a.hi = a.lo + length;
  } else if (a.has_lo && !a.has_hi) {
    a.hi = a.lo + length;
  } else if (a.has_hi && !a.has_lo) {
    a.lo = a.hi - length;
  }
}

std::array<Axis, 3> axes_of(const Deck& deck, const Box& geometry) {
  const auto axis = [&](const char* letter, double lo, double hi, std::int64_t cells, std::size_t d) {
    return Axis{letter,
                deck.given(fmt::format("{}min", letter)),
                deck.given(fmt::format("{}max", letter)),
                lo,
                hi,
                geometry.lo[d],
                geometry.hi[d],
                cells};
  };
  return {axis("x", deck.xmin, deck.xmax, deck.nelx, 0), axis("y", deck.ymin, deck.ymax, deck.nely, 1),
          axis("z", deck.zmin, deck.zmax, deck.nelz, 2)};
}

}  // namespace

void check_geometry_grid(const Deck& deck, const std::string& option) {
  for (const Axis& a : axes_of(deck, {})) {
    for (const bool high : {false, true})
      if ((high ? a.has_hi : a.has_lo) && !std::isfinite(high ? a.hi : a.lo))
        throw Error(fmt::format("{} = {}, expected a number", bound_name(a, high), high ? a.hi : a.lo));
    if (a.has_lo && a.has_hi && !(a.lo < a.hi))
      throw Error(fmt::format("{} = {}, {} = {}: expected {} < {}", bound_name(a, false), a.lo,
                              bound_name(a, true), a.hi, bound_name(a, false), bound_name(a, true)));
  }
  if (deck.given("cell_size")) {
    if (!(deck.cell_size > 0))
      throw Error(fmt::format("cell_size = {}, expected a size > 0", deck.cell_size));
  } else if (!deck.given("nelx") && !deck.given("nely") && !deck.given("nelz")) {
    throw Error(option + " needs a grid: expected cell_size, or nelx, nely and nelz");
  } else {
    (void)deck_intervals(deck, option);
  }
}

Grid geometry_grid(const Deck& deck, const std::string& option, const Box& geometry) {
  check_geometry_grid(deck, option);
  Index3 cells{};
  Vec3 lo, hi;
  double room = static_cast<double>(std::numeric_limits<std::int64_t>::max() / 8);
  std::array<Axis, 3> axes = axes_of(deck, geometry);
  for (std::size_t d = 0; d < 3; ++d) {
    if (deck.given("cell_size"))
      fit_cell_size(axes[d], deck);
    else
      fit_counts(axes[d], deck);
    cells[d] = axes[d].cells;
    lo[d] = axes[d].lo;
    hi[d] = axes[d].hi;
    room /= static_cast<double>(cells[d]);
  }
  if (room < 1)
    throw Error(fmt::format("cell_size = {}: {} x {} x {} cells, more than can be numbered", deck.cell_size,
                            cells[0], cells[1], cells[2]));
  return box_grid(cells, lo, hi);
}

void tell_geometry_grid(const Deck& deck, const Grid& grid, const Log& log) {
  const std::array<Axis, 3> axes = axes_of(deck, {});
  const bool in_full =
      std::all_of(axes.begin(), axes.end(), [](const Axis& a) { return a.has_lo && a.has_hi; });
  if (in_full && !deck.given("cell_size")) return;
  const Vec3 h = grid.cell_size();
  log.line(
      "Overlay grid: {} x {} x {} cells of {:g} x {:g} x {:g} from ({:g}, {:g}, {:g}) to ({:g}, {:g}, {:g})",
      grid.cells[0], grid.cells[1], grid.cells[2], h.x, h.y, h.z, grid.planes[0].front(),
      grid.planes[1].front(), grid.planes[2].front(), grid.planes[0].back(), grid.planes[1].back(),
      grid.planes[2].back());
}

}  // namespace sculpt
