#pragma once
// `input_cart_exo`: an Exodus hex mesh that is a regular Cartesian grid; the block of a hex is its material.
// Hexes and their nodes may come in any order, the origin is anywhere, the cells of an axis are equally long.
#include <memory>

#include "sculpt/input/material_source.hpp"

namespace sculpt {

// Collective. Rank 0 reads the whole file and recognises the grid. Throws AgreedError.
[[nodiscard]] std::unique_ptr<MaterialSource> open_cart_exo(const Comm& comm, const Deck& deck,
                                                            const Log& log);

}  // namespace sculpt
