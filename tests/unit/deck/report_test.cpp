#include "sculpt/deck/report.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "message.hpp"
#include "sculpt/deck/options.hpp"
#include "sculpt/deck/parse.hpp"

namespace sculpt {
namespace {

Deck deck_of(const std::string& lines) {
  return parse_deck("BEGIN SCULPT\n" + lines + "\nEND SCULPT\n", "deck.i");
}

bool has(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

bool at_default(const Deck& deck, const OptionSpec& option) {
  const auto same = [&](auto slot) {
    if constexpr (std::is_same_v<decltype(slot), std::monostate>) {
      return true;
    } else {
      return deck.*slot == Deck{}.*slot;
    }
  };
  return std::visit(same, option.slot);
}

// A legal value of the option that is not its default.
std::string other_value(const OptionSpec& option) {
  if (!option.values.empty()) return std::string(option.values.back().name);
  if (const auto* slot = std::get_if<bool Deck::*>(&option.slot)) return Deck{}.**slot ? "false" : "true";
  if (std::holds_alternative<std::string Deck::*>(option.slot)) return "'a \"b\" $#= c'";
  if (std::holds_alternative<std::vector<IdName> Deck::*>(option.slot))
    return fmt::format("3 'a name'\n{} = 1 b", option.name);
  if (std::holds_alternative<std::vector<IdBox> Deck::*>(option.slot)) return "3 -1 0 0.1 1 2e-9 3";
  if (std::holds_alternative<std::vector<NumberRecord> Deck::*>(option.slot)) return "10 0.1 1e-4";
  if (std::holds_alternative<std::vector<MaterialValue> Deck::*>(option.slot)) return "3 0.1";
  if (std::holds_alternative<double Deck::*>(option.slot)) return "0.1234567890123456";
  return "4";
}

TEST(Echo, IsReadBackAsTheSameDeckForEveryOption) {
  for (const OptionSpec& option : option_table()) {
    if (option.hidden || option.where == Where::kCommandLineOnly || option.name == "print_input") continue;
    if (std::holds_alternative<std::monostate>(option.slot)) continue;
    const Deck deck = deck_of(fmt::format("{} = {}", option.name, other_value(option)));
    EXPECT_FALSE(at_default(deck, option)) << option.name;
    EXPECT_EQ(parse_deck(echo(deck), "echo"), deck) << option.name;
  }
}

TEST(Echo, IsReadBackAsTheSameDeckAltogether) {
  Deck deck =
      deck_of("input_spn = a.spn\nnelx = 3\nmaterial_name = 1 'b c'\nmaterial_name = 2 d\nexodus_file = e");
  apply_input_defaults(deck);
  Deck again = parse_deck(echo(deck), "echo");
  apply_input_defaults(again);
  EXPECT_EQ(again, deck);
  EXPECT_EQ(parse_deck(echo(Deck{}), "echo"), Deck{});
}

TEST(Echo, ShowsDefaultsBehindCommentSigns) {
  Deck deck = deck_of("input_spn = a.spn\nsmooth = 2");
  apply_input_defaults(deck);
  const std::string text = echo(deck);
  EXPECT_TRUE(has(text, "\n  input_spn = a.spn\n"));
  EXPECT_TRUE(has(text, "\n  smooth = fixed_bbox\n"));
  EXPECT_TRUE(has(text, "\n  $ csmooth = hermite  (set for this input)\n"));
  EXPECT_TRUE(has(text, "\n  $ opt_threshold = 0.6\n"));
  EXPECT_TRUE(has(text, "\n  $ void_mat = (largest material id + 1)\n"));
  EXPECT_TRUE(has(text, "\n  $ Mesh Improvement\n"));
  EXPECT_FALSE(has(text, "cubit_launch"));
  EXPECT_FALSE(has(text, "input_file"));
}

TEST(ConsoleTable, ListsWhatWasSetInHelpOrder) {
  Deck deck = deck_of(
      "pillow_surfaces = on\nmesh_void = false\nnelx = 26\nxmin = 0.5\ninput_spn = 'a b.spn'\n"
      "stair = full\nmaterial_name = 1 iron\nmaterial_name = 2 tin\nscale = 2");
  apply_input_defaults(deck);
  EXPECT_EQ(console_table(deck),
            "  --input_spn                -isp  a b.spn\n"
            "  --exodus_file              -e    a b\n"
            "  --nelx                     -x    26\n"
            "  --xmin                     -t    0.500000\n"
            "  --stair                    -str  1\n"
            "  --mesh_void                -V    OFF (0)\n"
            "  --material_name            -mn   1 iron\n"
            "  --material_name            -mn   2 tin\n"
            "  --smooth                   -S    3\n"
            "  --csmooth                  -CS   2\n"
            "  --laplacian_iters          -LI   10\n"
            "  --pillow_surfaces          -ps   ON (1)\n"
            "  --scale                          2.000000\n");
}

TEST(Help, ListsEveryOptionAndGroup) {
  const std::string text = help_text("");
  EXPECT_EQ(text.find("Usage: sculpt"), 0u);
  for (const OptionSpec& option : option_table())
    EXPECT_EQ(has(text, fmt::format("  --{} ", option.name)), !option.hidden) << option.name;
  for (const GroupSpec& group : option_groups()) EXPECT_TRUE(has(text, group.title)) << group.title;
}

TEST(Help, ExplainsAnOptionHoweverItIsNamed) {
  const std::string expected =
      "================================== SCULPT HELP ==================================\n"
      "Order of the cells in the spn file\n"
      "Command: spn_xyz_order  Order of the cells in the spn file\n"
      "\n"
      "Input file command:   spn_xyz_order <arg>\n"
      "Command line options: -spo <arg>, --spn_xyz_order <arg>\n"
      "Argument Type:        name or integer\n"
      "Default:              xyz\n"
      "Input arguments:      xyz (0)\n"
      "                      xzy (1)\n"
      "                      yxz (2)\n"
      "                      yzx (3)\n"
      "                      zxy (4)\n"
      "                      zyx (5)\n"
      "Command Description:\n"
      "    Loop nest of the file, outermost first: xyz means that z varies fastest, zyx\n"
      "    that x varies fastest.\n"
      "\n";
  for (const char* topic :
       {"spn_xyz_order", "--spn_xyz_order", "-spn_xyz_order", "-spo", "spo", "SPN_xyz_order"})
    EXPECT_EQ(help_text(topic), expected) << topic;
}

TEST(Help, KeepsTheCaseOfShortForms) {
  EXPECT_TRUE(has(help_text("-S"), "Command: smooth "));
  EXPECT_TRUE(has(help_text("-s"), "Command: zmax "));
}

TEST(Help, ExplainsGroupsByAllTheirSelectors) {
  for (const char* topic : {"--overlay", "-ovr", "overlay", "--bbox", "-box"}) {
    const std::string text = help_text(topic);
    EXPECT_TRUE(has(text, "Command: nelx ")) << topic;
    EXPECT_FALSE(has(text, "Command: stair ")) << topic;
  }
  for (const GroupSpec& group : option_groups()) {
    EXPECT_TRUE(has(help_text(fmt::format("--{}", group.selector)), group.title));
    EXPECT_TRUE(has(help_text(fmt::format("-{}", group.flag)), group.title));
  }
}

TEST(Help, ShowsTheOptionAndTheGroupThatShareAName) {
  const std::string text = help_text("-imp");
  EXPECT_TRUE(has(text, "Command: input_mesh_pamgen "));
  EXPECT_TRUE(has(text, "Command: defeature "));
  EXPECT_FALSE(has(help_text("imp"), "Command: input_mesh_pamgen "));
}

TEST(Help, ExplainsEverythingOrSaysThatItCannot) {
  const std::string all = help_text("all");
  for (const OptionSpec& option : option_table())
    EXPECT_EQ(has(all, fmt::format("Command: {} ", option.name)), !option.hidden) << option.name;
  EXPECT_EQ(help_text("markdown"), options_markdown());
  EXPECT_EQ(message_of([] { (void)help_text("--nelxx"); }),
            "command line: no help on '--nelxx'; did you mean 'nelx'?");
  EXPECT_EQ(message_of([] { (void)help_text("-"); }).find("command line: no help on '-'"), 0u);
}

TEST(Version, NamesTheProgram) { EXPECT_EQ(version_text(), "sculpt " SCULPT_VERSION); }

}  // namespace
}  // namespace sculpt
