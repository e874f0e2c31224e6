#pragma once
// Volume fractions that an earlier run has left, as a source of materials (input_vfrac), and their files
// (volfrac_file).
#include <memory>

#include "pipeline/overlay.hpp"

namespace sculpt {

// Collective. The deck with the defaults of smoothing of the input that the files of input_vfrac come from.
// The same deck without input_vfrac. Throws AgreedError.
[[nodiscard]] Deck with_defaults_of_fractions(const Comm& comm, const Deck& deck, const Log& log);

// Collective. Opens the files of input_vfrac and reads them. Throws AgreedError: also when their cells are no
// Cartesian grid.
[[nodiscard]] std::unique_ptr<MaterialSource> open_vfrac(const Comm& comm, const Deck& deck, const Log& log);

// Collective. Writes the cells of the overlay with their fractions (volfrac_file). Leaves the materials of
// cells at 0.
void write_fractions(const Comm& comm, const Deck& deck, Overlay& overlay, const Log& log, Stages& stages);

}  // namespace sculpt
