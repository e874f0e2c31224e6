#pragma once
// Options that were given although nothing asks for them: they are taken, and the user is told.
#include <string>
#include <string_view>
#include <vector>

#include "sculpt/deck/deck.hpp"

namespace sculpt {

// Local. The name of the type of refinement, as the user would write it.
[[nodiscard]] std::string_view adapt_type_name(const Deck& deck);

// The adapt_... options that were given without effect, in sentences for the console.
[[nodiscard]] std::vector<std::string> idle_adapt_options(const Deck& deck);
// Likewise: those of input meshes without one, those of the Cartesian grid with one.
[[nodiscard]] std::vector<std::string> idle_grid_options(const Deck& deck);
// Likewise: those of Cartesian grids, with an input mesh that is none.
[[nodiscard]] std::vector<std::string> idle_without_grid(const Deck& deck);

}  // namespace sculpt
