#pragma once
// The option table: one row per option of Sculpt 16.14. The deck parser, the command line, -h, --print_input,
// the console table, validation and docs/options.md are walks over it, in its order.
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sculpt/deck/deck.hpp"

namespace sculpt {

enum class Group {
  kProcess,
  kInput,
  kOutput,
  kOverlay,
  kType,
  kBoundaryCondition,
  kAdapt,
  kSmoothing,
  kImprove,
  kTransform,
  kBoundaryLayer,
};

struct GroupSpec {
  Group group;
  std::string_view title;
  std::string_view selector;    // long selector of -h, without dashes
  std::string_view flag;        // short selector, without dash
  std::string_view old_long{};  // selectors of older versions
  std::string_view old_flag{};
};
[[nodiscard]] std::span<const GroupSpec> option_groups();

// A named value of an enumeration. The first row of a number holds its preferred name, later rows are
// aliases.
struct EnumValue {
  std::string_view name;
  int number;
  bool supported = true;
};

// Where the value lives, hence its type and its default. monostate: the word only steers the parser.
using Slot =
    std::variant<std::monostate, bool Deck::*, int Deck::*, std::int64_t Deck::*, double Deck::*,
                 std::string Deck::*, std::vector<std::int64_t> Deck::*, std::vector<MaterialValue> Deck::*,
                 std::vector<IdName> Deck::*, std::vector<IdBox> Deck::*, std::vector<NumberRecord> Deck::*>;

enum class Where {
  kEverywhere,       // deck and command line
  kCommandLineOnly,  // refused in a deck
};

struct OptionSpec {
  std::string_view name;                 // deck keyword; the command line adds "--"
  std::string_view flag;                 // short form with its dash; empty: none
  Group group;                           // heading in -h and in the docs
  Slot slot;                             // see Slot
  std::string_view help;                 // one line
  std::string_view about;                // what it does, in whole sentences
  bool supported = false;                // false: refused when it is switched on
  std::span<const EnumValue> values{};   // enumerations only
  double lo = -HUGE_VAL, hi = HUGE_VAL;  // inclusive range of a number given by the user
  std::string_view unset{};              // words for a default that only means "not given"
  std::string_view argument{};           // what a text is, e.g. "file name"
  bool takes_argument = false;           // booleans that Sculpt lists with an argument
  Where where = Where::kEverywhere;
  bool hidden = false;  // accepted, but not listed
};
[[nodiscard]] std::span<const OptionSpec> option_table();

// The row of a long name (any case) or of a short flag with its dash (case matters); nullptr when there is
// none.
[[nodiscard]] const OptionSpec* find_option(std::string_view long_name);
[[nodiscard]] const OptionSpec* find_flag(std::string_view flag);

// "; did you mean 'nelx'?" with the nearest of the candidates, or nothing when none is near.
[[nodiscard]] std::string did_you_mean(std::string_view word, std::span<const std::string> candidates);
// The same against all long names, each with this prefix ("" or "--").
[[nodiscard]] std::string did_you_mean_option(std::string_view word, std::string_view prefix);

}  // namespace sculpt
