#pragma once
// The periodic directions of a run, and whether its input is periodic (docs/periodic.md).
#include <array>

#include "sculpt/base/log.hpp"
#include "sculpt/deck/deck.hpp"
#include "sculpt/grid/grid.hpp"
#include "sculpt/input/material_source.hpp"

namespace sculpt {

// Local. Per axis; none without the option periodic. Throws Error when an axis has too few cells.
[[nodiscard]] std::array<bool, 3> periodic_axes(const Deck& deck, const Index3& cells);

// Local. The ids of the node sets on the low and the high side of each axis; 0 = none.
[[nodiscard]] std::array<std::array<std::int64_t, 2>, 3> periodic_node_sets(const Deck& deck);

// Collective. Compares what the input has in the cells just outside each periodic side with the cells inside
// the opposite side; cells: those of the grid that this rank looks at. Throws Error where the difference of a
// volume fraction is larger than check_periodic_tol. For input that goes on beyond its grid.
void check_period(const Comm& comm, const Deck& deck, const Grid& grid, const std::array<bool, 3>& periodic,
                  const IndexBox& cells, MaterialField& field, const MaterialTable& materials,
                  const Log& log);

}  // namespace sculpt
