#pragma once
// The periodic directions of a run, and whether its input is periodic (docs/periodic.md).
#include <array>

#include "sculpt/base/log.hpp"
#include "sculpt/deck/deck.hpp"
#include "sculpt/distribute/cartesian.hpp"
#include "sculpt/input/material_source.hpp"

namespace sculpt {

// Local. Per axis; none without the option periodic. Throws Error when an axis has too few cells.
[[nodiscard]] std::array<bool, 3> periodic_axes(const Deck& deck, const Index3& cells);

// Local. The ids of the node sets on the low and the high side of each axis; 0 = none.
[[nodiscard]] std::array<std::array<std::int64_t, 2>, 3> periodic_node_sets(const Deck& deck);

// Collective. Compares what the input has in the cells just outside each periodic side with `owned`, the
// fractions of this rank's cells inside the opposite side. Throws Error where the difference is larger than
// check_periodic_tol. Input that ends with its grid passes.
void check_period(const Comm& comm, const Deck& deck, const MaterialSource& source,
                  const CartesianParts& parts, const MaterialTable& materials, const Fractions& owned,
                  const Log& log);

}  // namespace sculpt
