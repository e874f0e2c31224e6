#pragma once
// One option's value between text and Deck, whatever its type.
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sculpt/deck/deck.hpp"
#include "sculpt/deck/options.hpp"

namespace sculpt {

// Sets the option from its words (no words: a boolean becomes true). Records are appended.
// `where` opens the message of an Error ("deck.i:7" or "command line"); `shown` is the option as the user
// wrote it.
void set_value(Deck& deck, const OptionSpec& option, std::span<const std::string> words,
               std::string_view where, std::string_view shown);

void reset_value(Deck& deck, const OptionSpec& option);

// How many words its value has: 0 for an optional boolean, kManyWords for a list.
inline constexpr std::size_t kManyWords = static_cast<std::size_t>(-1);
[[nodiscard]] std::size_t words_of_value(const OptionSpec& option);

// The value as a deck writes it; a repeatable option has one text per record, none when it is empty.
[[nodiscard]] std::vector<std::string> deck_texts(const Deck& deck, const OptionSpec& option);
// The same as the console table writes it: %f, enumerations as integers, ON (1).
[[nodiscard]] std::vector<std::string> console_texts(const Deck& deck, const OptionSpec& option);

// "integer (1 to 100)", "file name", ...
[[nodiscard]] std::string argument_type(const OptionSpec& option);
// Does the option take an argument on the command line (listed with <arg>)?
[[nodiscard]] bool shows_argument(const OptionSpec& option);
[[nodiscard]] bool is_boolean(const OptionSpec& option);
[[nodiscard]] bool is_repeatable(const OptionSpec& option);
[[nodiscard]] bool equals_default(const Deck& deck, const OptionSpec& option);
// Each number of an enumeration once, with all its names: "full, on, true (1)". Aliases that are numbers
// themselves stay unlisted.
[[nodiscard]] std::vector<std::string> value_names(const OptionSpec& option);
// The row of a number, or nullptr.
[[nodiscard]] const EnumValue* find_value(const OptionSpec& option, int number);

}  // namespace sculpt
