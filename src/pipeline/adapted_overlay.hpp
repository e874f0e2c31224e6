#pragma once
// Overlay meshes that are not the grid of the input: refined, coarsened and resampled ones (adapt_type).
#include "pipeline/overlay.hpp"

namespace sculpt {

[[nodiscard]] inline bool is_adapted(const Deck& deck) {
  return deck.adapt_type != kAdaptOff && deck.adapt_levels > 0;
}

// Collective. `grid`: that of the source with the expansion layers around it.
[[nodiscard]] Overlay read_adapted(const Comm& comm, const Deck& deck, MaterialSource& source,
                                   const Grid& grid, const Log& log, Stages& stages);

}  // namespace sculpt
