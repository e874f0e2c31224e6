#pragma once
// Options that were given although nothing asks for them: they are taken, and the user is told.
#include <string>
#include <vector>

#include "sculpt/deck/deck.hpp"

namespace sculpt {

// The adapt_... options that were given without effect, in sentences for the console.
[[nodiscard]] std::vector<std::string> idle_adapt_options(const Deck& deck);

}  // namespace sculpt
