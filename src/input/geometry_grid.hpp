#pragma once
// The overlay grid of geometry: from the counts or the cell size of the deck, its bounds where it gives some,
// and the bounds of the geometry elsewhere. Local; Error names the option that is missing or wrong.
#include <string>

#include "sculpt/base/log.hpp"
#include "sculpt/deck/deck.hpp"
#include "sculpt/geom/shape.hpp"
#include "sculpt/grid/grid.hpp"

namespace sculpt {

// What can be told before the geometry is known; `option` is the option that names it.
void check_geometry_grid(const Deck& deck, const std::string& option);

// `geometry`: the bounds of the geometry. A bound of the deck is kept to the last bit.
//
// Counts: an end without a bound lies 2.5 cells beyond the geometry (a tenth of its size where the axis has
// too few cells), or by the share bbox_expand of its size. cell_size: with both bounds the nearest number of
// cells fits between them, which then are a little larger or smaller; else cells have this size exactly, and
// there are round(size / cell_size) of them and 5 more, 2.5 at each end (with bbox_expand: as many as cover
// the grown size); with one bound 2.5 more, rounded up, beyond the other end.
[[nodiscard]] Grid geometry_grid(const Deck& deck, const std::string& option, const Box& geometry);

// Tells a grid that the deck does not give in full.
void tell_geometry_grid(const Deck& deck, const Grid& grid, const Log& log);

}  // namespace sculpt
