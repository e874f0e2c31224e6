#pragma once
// `input_micro`: volume fractions per cell as a Tecplot point file (Appendix G of the report). Unit cells
// around the centroids that the file gives; xmin..zmax of the deck clip the grid.
#include <memory>

#include "sculpt/input/material_source.hpp"

namespace sculpt {

// Collective. Throws AgreedError.
[[nodiscard]] std::unique_ptr<MaterialSource> open_micro(const Comm& comm, const Deck& deck, const Log& log);

}  // namespace sculpt
