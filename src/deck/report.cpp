#include "sculpt/deck/report.hpp"

#include <fmt/core.h>

#include "deck/value.hpp"
#include "sculpt/deck/options.hpp"

namespace sculpt {

namespace {

// Options that make a line of a deck; print_input would stop the run that reads the echo.
bool echoed(const OptionSpec& option) {
  return !option.hidden && option.where == Where::kEverywhere && option.name != "print_input" &&
         !std::holds_alternative<std::monostate>(option.slot);
}

// The default behind `$`: its value, or in words what it means that there is none.
std::string echo_default(const Deck& deck, const OptionSpec& option) {
  if (!option.unset.empty() && equals_default(deck, option))
    return fmt::format("  $ {} = ({})\n", option.name, option.unset);
  std::string text;
  for (const std::string& value : deck_texts(deck, option))
    text += fmt::format("  $ {} = {}{}\n", option.name, value,
                        deck.redefaulted.contains(option.name) ? "  (set for this input)" : "");
  return text;
}

std::string echo_option(const Deck& deck, const OptionSpec& option) {
  if (!deck.given(option.name)) return echo_default(deck, option);
  std::string text;
  for (const std::string& value : deck_texts(deck, option))
    text += fmt::format("  {} = {}\n", option.name, value);
  return text;
}

}  // namespace

std::string version_text() { return "sculpt " SCULPT_VERSION; }

std::string echo(const Deck& deck) {
  std::string text =
      fmt::format("$ {}, options of this run; defaults stand behind $\nBEGIN SCULPT\n", version_text());
  for (const GroupSpec& group : option_groups()) {
    std::string lines;
    for (const OptionSpec& option : option_table())
      if (option.group == group.group && echoed(option)) lines += echo_option(deck, option);
    if (!lines.empty()) text += fmt::format("\n  $ {}\n", group.title) + lines;
  }
  return text + "\nEND SCULPT\n";
}

std::string console_table(const Deck& deck) {
  std::string text;
  for (const OptionSpec& option : option_table()) {
    if (option.hidden || !(deck.given(option.name) || deck.redefaulted.contains(option.name))) continue;
    for (const std::string& value : console_texts(deck, option))
      text += fmt::format("  --{:<24} {:<5} {}\n", option.name, option.flag, value);
  }
  return text;
}

}  // namespace sculpt
