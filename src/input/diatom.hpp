#pragma once
// `diatom_file`: materials given by analytic shapes, sampled on the overlay grid (geometry_grid.hpp). What
// no shape covers is the void.
// On an overlay mesh within the bounds `overlay` they are asked for in its hexes, and the deck gives no grid.
#include <memory>

#include "sculpt/input/material_source.hpp"

namespace sculpt {

// Collective. Throws AgreedError.
[[nodiscard]] std::unique_ptr<MaterialSource> open_diatom(const Comm& comm, const Deck& deck, const Log& log,
                                                          const std::optional<Box>& overlay);

}  // namespace sculpt
