#pragma once
// What the readers take from the deck about the overlay grid. Local; Error names the option that is missing
// or wrong.
#include <string>

#include "sculpt/deck/deck.hpp"
#include "sculpt/grid/grid.hpp"

namespace sculpt {

// nelx, nely, nelz; `option` is the option that needs them.
[[nodiscard]] Index3 deck_intervals(const Deck& deck, const std::string& option);
// The cells of the grid whose centres lie in the box of those of xmin..zmax that the deck gives.
[[nodiscard]] IndexBox deck_clip(const Deck& deck, const Grid& grid, const std::string& path);
// The part of a grid: the same planes, to the last bit.
[[nodiscard]] Grid part_of(const Grid& grid, const IndexBox& box);

}  // namespace sculpt
