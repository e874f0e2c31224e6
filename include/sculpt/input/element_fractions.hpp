#pragma once
// Volume fractions that the variables of the elements of an overlay mesh give.
#include <span>
#include <string>

#include "sculpt/base/types.hpp"
#include "sculpt/input/material_source.hpp"
#include "sculpt/par/comm.hpp"

namespace sculpt {

struct ElementFractions {
  MaterialTable table;  // no void
  Fractions fractions;  // of the elements, in their order
};

// Collective. One material per variable: its id is the number at the end of the name where all names end with
// different positive numbers, otherwise its place from 1. `element`: numbers of this rank's elements in the
// file, from 0; `value`: those of the first element by variable, then those of the second.
// checked_fractions() looks at them.
[[nodiscard]] ElementFractions element_fractions(const Comm& comm, const std::string& path,
                                                 std::span<const std::string> variables,
                                                 std::span<const GlobalId> element,
                                                 std::span<const double> value);

// Collective. `found`: entries that are not 0; its materials are the places of variables. Every value must
// lie between 0 and 1 and those of an element must sum to 1, up to 1e-6 and the rounding of single precision.
// Fractions that sum to 1 in double precision stay as they are; of others those below 1e-12 are dropped and
// the rest is normalised. `path` is for messages, which name the first element that is wrong. Throws
// AgreedError.
[[nodiscard]] Fractions checked_fractions(const Comm& comm, const std::string& path,
                                          std::span<const std::string> variables,
                                          std::span<const GlobalId> element, Fractions found);

}  // namespace sculpt
