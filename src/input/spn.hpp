#pragma once
// `input_spn`: one material id per cell as text (Appendix I of the report). Unit cells, origin at 0.
#include <memory>

#include "sculpt/input/material_source.hpp"

namespace sculpt {

// Collective. Throws AgreedError.
[[nodiscard]] std::unique_ptr<MaterialSource> open_spn(const Comm& comm, const Deck& deck, const Log& log);

}  // namespace sculpt
