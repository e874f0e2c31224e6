// -h and docs/options.md.
#include <fmt/core.h>

#include <utility>

#include "deck/text.hpp"
#include "deck/value.hpp"
#include "sculpt/base/error.hpp"
#include "sculpt/deck/options.hpp"
#include "sculpt/deck/report.hpp"

namespace sculpt {

namespace {

constexpr std::size_t kTextWidth = 80;

// Breaks the text at blanks so that each line, behind its indentation, stays within the width.
std::string wrap(std::string_view text, std::size_t indent) {
  std::string result;
  std::size_t column = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    if (column == 0 || column + 1 + end > kTextWidth) {
      if (column != 0) result += '\n';
      result.append(indent, ' ');
      column = indent;
    } else {
      result += ' ';
      ++column;
    }
    result += text.substr(0, end);
    column += end;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return result + "\n";
}

std::string default_text(const OptionSpec& option) {
  if (!option.unset.empty()) return std::string(option.unset);
  const std::vector<std::string> texts = deck_texts(Deck{}, option);
  return texts.empty() ? "none" : texts[0];
}

bool has_default(const OptionSpec& option) { return !std::holds_alternative<std::monostate>(option.slot); }

std::string usage() {
  return "Usage: sculpt [-j <processes>] [-mpi <mpiexec>] [-i <deck>] [options]\n"
         "       mpiexec -n <processes> psculpt [-i <deck>] [options]\n\n"
         "Options have a short form (one dash) and a long form (two dashes); in a deck the long name is "
         "written\n"
         "without dashes. Options of the command line win over those of the deck.\n";
}

std::string group_heading(const GroupSpec& group) {
  return fmt::format("\n{:<30} --{} -{}\n", group.title, group.selector, group.flag);
}

std::string listing() {
  std::string text = usage();
  for (const GroupSpec& group : option_groups()) {
    text += group_heading(group);
    for (const OptionSpec& option : option_table()) {
      if (option.group != group.group || option.hidden) continue;
      text += fmt::format("  --{:<24} {:<5} {:<5} {}{}\n", option.name, option.flag,
                          shows_argument(option) ? "<arg>" : "", option.help, option.supported ? "" : " *");
    }
  }
  return text +
         "\n* not supported yet\n\n"
         "-h <option> or -h <group selector> shows details, -h all those of every option.\n";
}

std::string details(const OptionSpec& option) {
  std::string text = std::string(34, '=') + " SCULPT HELP " + std::string(34, '=') + "\n";
  text += fmt::format("{}\nCommand: {}  {}\n\n", option.help, option.name, option.help);
  if (option.where == Where::kEverywhere)
    text += fmt::format("Input file command:   {} <arg>\n", option.name);
  const std::string argument = shows_argument(option) ? " <arg>" : "";
  text += fmt::format("Command line options: {}{}--{}{}\n", option.flag,
                      option.flag.empty() ? "" : argument + ", ", option.name, argument);
  text += fmt::format("Argument Type:        {}\n", argument_type(option));
  if (has_default(option)) text += fmt::format("Default:              {}\n", default_text(option));
  std::string_view label = "Input arguments:";
  for (const std::string& value : value_names(option))
    text += fmt::format("{:<21} {}\n", std::exchange(label, ""), value);
  text += "Command Description:\n" + wrap(option.about, 4);
  if (!option.supported) text += wrap("This option is not supported yet; switching it on is an error.", 4);
  return text + "\n";
}

std::string group_details(const GroupSpec& group) {
  std::string text = group_heading(group) + "\n";
  for (const OptionSpec& option : option_table())
    if (option.group == group.group && !option.hidden) text += details(option);
  return text;
}

std::string all_details() {
  std::string text = usage();
  for (const GroupSpec& group : option_groups()) text += group_details(group);
  return text;
}

bool selects(const GroupSpec& group, std::string_view word) {
  return word == group.selector || word == group.flag ||
         (!word.empty() && (word == group.old_long || word == group.old_flag));
}

// '|' separates the columns of a table.
std::string cell(std::string_view text) {
  std::string result;
  for (const char c : text) result += c == '|' ? std::string("\\|") : std::string(1, c);
  return result;
}

std::string markdown_option(const OptionSpec& option) {
  std::string text = fmt::format("### {}\n\n", option.name);
  text += fmt::format("{}. {}", option.help, option.about);
  if (!option.supported) text += " **Not supported yet.**";
  text += fmt::format("\n\n- Command line: {}`--{}`\n",
                      option.flag.empty() ? "" : fmt::format("`{}`, ", option.flag), option.name);
  if (option.where == Where::kCommandLineOnly) text += "- Not in a deck\n";
  text += fmt::format("- Argument: {}\n", argument_type(option));
  if (is_repeatable(option)) text += "- May be repeated; the order of the lines is kept\n";
  if (has_default(option)) text += fmt::format("- Default: {}\n", default_text(option));
  for (const std::string& value : value_names(option)) text += fmt::format("  - {}\n", value);
  return text + "\n";
}

std::string markdown_group(const GroupSpec& group) {
  std::string text = fmt::format("## {}\n\n", group.title);
  text += "| option | short | purpose | default | supported |\n|---|---|---|---|---|\n";
  std::string options;
  for (const OptionSpec& option : option_table()) {
    if (option.group != group.group || option.hidden) continue;
    text +=
        fmt::format("| [{0}](#{0}) | {1} | {2} | {3} | {4} |\n", option.name,
                    option.flag.empty() ? "" : fmt::format("`{}`", option.flag), cell(option.help),
                    has_default(option) ? cell(default_text(option)) : "", option.supported ? "yes" : "no");
    options += markdown_option(option);
  }
  return text + "\n" + options;
}

}  // namespace

std::string help_text(std::string_view topic) {
  if (topic.empty()) return listing();
  const std::string_view bare = topic.substr(std::min(topic.find_first_not_of('-'), topic.size()));
  if (lower(bare) == "all") return all_details();
  if (lower(bare) == "markdown") return options_markdown();
  const GroupSpec* selected = nullptr;
  for (const GroupSpec& group : option_groups())
    if (selects(group, lower(bare))) selected = &group;
  // The dashed short form first, as its case matters; then long names; then short forms without their dash.
  // -imp is both an option and a group: it shows both.
  if (const OptionSpec* option = find_flag(topic))
    return details(*option) + (selected != nullptr ? group_details(*selected) : "");
  if (const OptionSpec* option = find_option(bare)) return details(*option);
  if (selected != nullptr) return group_details(*selected);
  if (const OptionSpec* option = find_flag(fmt::format("-{}", bare))) return details(*option);
  std::vector<std::string> topics{"all"};
  for (const OptionSpec& option : option_table()) topics.emplace_back(option.name);
  for (const GroupSpec& group : option_groups()) topics.emplace_back(group.selector);
  throw Error(fmt::format("command line: no help on '{}'{}", topic, did_you_mean(bare, topics)));
}

std::string options_markdown() {
  std::string text =
      "# Options\n\n"
      "Generated from the option table with `sculpt -h markdown > docs/options.md`.\n\n"
      "An option is given on the command line, in its short or long form, or in a deck (`-i <file>`) by its "
      "long\n"
      "name. The command line wins over the deck.\n\n"
      "```\n"
      "$ grains.i: everything behind $ or # is a comment\n"
      "BEGIN SCULPT\n"
      "  input_spn = grains.spn\n"
      "  nelx = 64\n"
      "  nely = 64\n"
      "  nelz = 64\n"
      "  smooth = fixed_bbox       $ names and numbers both work\n"
      "  pillow_surfaces = true\n"
      "  exodus_file = \"my mesh\"   $ quotes keep blanks\n"
      "END SCULPT\n"
      "```\n\n"
      "Keywords and names of values are understood in any case; the `=` may be missing. If an option is "
      "repeated\n"
      "the last line wins, except for options that are marked as repeatable. File names are relative to the\n"
      "current folder. A switch is written `name = true` or `name = false` in a deck and is a bare word on "
      "the\n"
      "command line. Options that are not supported yet are refused, unless they are set to their "
      "default.\n\n"
      "Exactly one input geometry is needed; `input_spn` and `diatom_file` also need nelx, nely and nelz, "
      "and\n"
      "`diatom_file` the box from xmin to zmax.\n\n";
  for (const GroupSpec& group : option_groups()) text += markdown_group(group);
  text.pop_back();  // the blank line behind the last option
  return text;
}

}  // namespace sculpt
