// Walks over the option table: what must hold for every row.
#include "sculpt/deck/options.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>

#include "message.hpp"
#include "sculpt/deck/parse.hpp"
#include "sculpt/deck/report.hpp"

namespace sculpt {
namespace {

TEST(OptionTable, NamesAndFlagsAreUnique) {
  std::set<std::string_view> names, flags;
  for (const OptionSpec& option : option_table()) {
    EXPECT_TRUE(names.insert(option.name).second) << option.name;
    if (!option.flag.empty()) {
      EXPECT_TRUE(flags.insert(option.flag).second) << option.flag;
    }
  }
}

TEST(OptionTable, EveryRowIsComplete) {
  for (const OptionSpec& option : option_table()) {
    EXPECT_FALSE(option.help.empty()) << option.name;
    EXPECT_FALSE(option.about.empty()) << option.name;
    EXPECT_TRUE(option.flag.empty() || option.flag[0] == '-') << option.name;
    EXPECT_EQ(option.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_"), std::string_view::npos);
    if (std::holds_alternative<std::string Deck::*>(option.slot)) {
      EXPECT_FALSE(option.argument.empty()) << option.name;
    }
  }
}

TEST(OptionTable, FieldsBelongToOneOption) {
  for (const OptionSpec& a : option_table())
    for (const OptionSpec& b : option_table())
      if (a.slot.index() != 0 && a.name != b.name) {
        EXPECT_FALSE(a.slot == b.slot) << a.name << " and " << b.name;
      }
}

TEST(OptionTable, EveryGroupHasOptionsInOneRun) {
  std::vector<Group> order;
  for (const OptionSpec& option : option_table())
    if (order.empty() || order.back() != option.group) order.push_back(option.group);
  ASSERT_EQ(order.size(), option_groups().size());
  for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(order[i], option_groups()[i].group);
}

// A default is a legal value, unless it is said to mean that there is none.
TEST(OptionTable, DefaultsAreInRange) {
  const Deck deck;
  for (const OptionSpec& option : option_table()) {
    if (!option.unset.empty()) continue;
    double value = option.lo;
    if (const auto* slot = std::get_if<int Deck::*>(&option.slot)) value = deck.**slot;
    if (const auto* slot = std::get_if<double Deck::*>(&option.slot)) value = deck.**slot;
    if (const auto* slot = std::get_if<std::int64_t Deck::*>(&option.slot))
      value = static_cast<double>(deck.**slot);
    EXPECT_GE(value, option.lo) << option.name;
    EXPECT_LE(value, option.hi) << option.name;
  }
}

TEST(OptionTable, DefaultsOfEnumerationsAreSupportedValues) {
  const Deck deck;
  for (const OptionSpec& option : option_table()) {
    if (option.values.empty()) continue;
    const int number = deck.*std::get<int Deck::*>(option.slot);
    bool known = false;
    for (const EnumValue& value : option.values) known = known || (value.number == number && value.supported);
    EXPECT_TRUE(known) << option.name;
  }
}

TEST(OptionTable, AliasesOfAValueAgreeOnItsSupport) {
  for (const OptionSpec& option : option_table())
    for (const EnumValue& a : option.values)
      for (const EnumValue& b : option.values)
        if (a.number == b.number) {
          EXPECT_EQ(a.supported, b.supported) << option.name << ' ' << a.name;
        }
}

TEST(OptionTable, HoldsEveryOptionOfSculpt) {
  EXPECT_EQ(find_flag("-jp")->name, "jproc");
  EXPECT_EQ(find_flag("-S")->name, "smooth");
  EXPECT_EQ(find_flag("-s")->name, "zmax");
  EXPECT_EQ(find_flag("-V")->name, "mesh_void");
  EXPECT_EQ(find_flag("-v")->name, "zmin");
  EXPECT_EQ(find_flag("-D")->name, "debug_processor");
  EXPECT_EQ(find_flag("-d")->name, "diatom_file");
  EXPECT_EQ(find_flag("-Q")->name, "quality");
  EXPECT_EQ(find_flag("-q")->name, "xmax");
  EXPECT_EQ(find_flag("-C")->name, "export_comm_maps");
  EXPECT_EQ(find_flag("-c")->name, "capture");
  EXPECT_EQ(find_flag(""), nullptr);
  EXPECT_EQ(find_option("NelX")->name, "nelx");
  EXPECT_EQ(find_option("nelxx"), nullptr);
  // 135 options of 16.14, the older scale, help, mpi and cubit_launch, and our own: quality_variable,
  // require_quality, resolve_reversals, keep_materials, pillow_boundary_layers, surface_projection,
  // opt_method, opt_damping, opt_metric, adapt_remainder, periodic_directions, input_mesh_partition,
  EXPECT_EQ(option_table().size(), 155u);
}

TEST(OptionTable, DefaultsAreSculptsExceptTheQualityFloor) {
  const Deck deck;
  EXPECT_EQ(deck.smooth, 1);
  EXPECT_EQ(deck.csmooth, 5);
  EXPECT_EQ(deck.laplacian_iters, 2);
  EXPECT_EQ(deck.max_opt_iters, 5);
  EXPECT_EQ(deck.opt_threshold, 0.6);
  EXPECT_EQ(deck.curve_opt_thresh, 0.1);
  EXPECT_EQ(deck.max_pcol_iters, 100);
  EXPECT_EQ(deck.pcol_threshold, 0.3);
}

TEST(DidYouMean, FindsTheNearestOption) {
  EXPECT_EQ(did_you_mean_option("nelxx", ""), "; did you mean 'nelx'?");
  EXPECT_EQ(did_you_mean_option("--laplacian_iter", "--"), "; did you mean '--laplacian_iters'?");
  EXPECT_EQ(did_you_mean_option("PILLOW_SURFACE", ""), "; did you mean 'pillow_surfaces'?");
  EXPECT_EQ(did_you_mean_option("qwertyuiop", ""), "");
}

TEST(OptionsPage, IsUpToDate) {
  std::ifstream file(SCULPT_SOURCE_DIR "/docs/options.md", std::ios::binary);
  ASSERT_TRUE(file) << "docs/options.md is missing";
  const std::string page{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  EXPECT_TRUE(page == options_markdown()) << "refresh it with: sculpt -h markdown > docs/options.md";
}

}  // namespace
}  // namespace sculpt
