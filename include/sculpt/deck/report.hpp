#pragma once
// Deck and option table to text.
#include <string>
#include <string_view>

#include "sculpt/deck/deck.hpp"

namespace sculpt {

// "sculpt 0.1.0", for --version.
[[nodiscard]] std::string version_text();

// Every option as a deck: given ones as lines, defaults behind `$`. Reading it back gives the same Deck,
// apart from the options that belong to the command line.
[[nodiscard]] std::string echo(const Deck& deck);

// The options that were given or re-defaulted, one per line `  --long_name  -short  value`, in help order.
[[nodiscard]] std::string console_table(const Deck& deck);

// -h: usage and listing for an empty topic; else an option (bare, dashed or short), a group selector, "all"
// or "markdown". Error: unknown topic.
[[nodiscard]] std::string help_text(std::string_view topic);

// The contents of docs/options.md.
[[nodiscard]] std::string options_markdown();

}  // namespace sculpt
