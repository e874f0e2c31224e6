#pragma once
// Volume fractions from voxels, and the .tec file of them (Appendix G of the report).
#include <string>

#include "voxels.hpp"

namespace microstructure {

// Takes 2 x 2 x 2 voxels of `fine` (ids 1 .. materials) as one cell and spreads the fractions with the
// weights 1 2 4 2 1 (tenths) per axis, so that interfaces are a few cells wide. Cells outside the box count
// as the nearest one inside. Fractions are multiples of 1/8000 and sum to 1 exactly, in the file too. Cell
// centres at 0, 1, 2, ...; x fastest.
void write_fractions(const std::string& path, const Voxels& fine, std::int32_t materials);

}  // namespace microstructure
