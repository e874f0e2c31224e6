#include "pipeline/idle_options.hpp"

#include <fmt/core.h>

#include <initializer_list>
#include <string_view>

#include "sculpt/deck/options.hpp"

namespace sculpt {
namespace {

// Which options have an effect with a type of refinement.
struct Use {
  std::string_view option;
  bool (*has_effect)(int adapt_type);
};

bool refines(int type) { return type != kAdaptOff && type != kAdaptResample; }

constexpr Use kUses[] = {
    {"adapt_threshold", [](int type) { return refines(type) && type != kAdaptMaterial; }},
    {"adapt_levels", [](int type) { return type != kAdaptOff; }},
    {"adapt_material", [](int type) { return type == kAdaptMaterial; }},
    {"adapt_remainder", [](int type) { return type == kAdaptCoarsen || type == kAdaptResample; }},
    {"adapt_export", [](int type) { return type != kAdaptOff; }},
    {"adapt_non_manifold", refines},
    {"adapt_load_balance", refines},
    {"adapt_memory_stats", refines},
};

// A flag that is off asks for nothing.
bool asks(const Deck& deck, std::string_view option) {
  if (option == "adapt_export") return deck.adapt_export;
  if (option == "adapt_non_manifold") return deck.adapt_non_manifold;
  if (option == "adapt_load_balance") return deck.adapt_load_balance;
  if (option == "adapt_memory_stats") return deck.adapt_memory_stats;
  return deck.given(option);
}

// The names of those that were given, with commas.
std::string given_of(const Deck& deck, std::initializer_list<std::string_view> options) {
  std::string names;
  for (const std::string_view option : options)
    if (deck.given(option)) names += fmt::format("{}{}", names.empty() ? "" : ", ", option);
  return names;
}

}  // namespace

std::string_view adapt_type_name(const Deck& deck) {
  for (const EnumValue& value : find_option("adapt_type")->values)
    if (value.number == deck.adapt_type) return value.name;
  return "";
}

std::vector<std::string> idle_adapt_options(const Deck& deck) {
  std::vector<std::string> told;
  const bool off = deck.adapt_type != kAdaptOff && deck.adapt_levels == 0;
  if (off) told.push_back("adapt_levels = 0 leaves the grid as it is; no effect: adapt_type");
  std::string idle;
  for (const Use& use : kUses) {
    // Without levels: told already; the grid is written all the same.
    const bool apart = off && (use.option == "adapt_levels" || use.option == "adapt_export");
    if (!asks(deck, use.option) || apart || (!off && use.has_effect(deck.adapt_type))) continue;
    if (off)
      told.back() += fmt::format(", {}", use.option);
    else
      idle += fmt::format("{}{}", idle.empty() ? "" : ", ", use.option);
  }
  if (!idle.empty())
    told.push_back(fmt::format("adapt_type is {}; no effect: {}", adapt_type_name(deck), idle));
  return told;
}

std::vector<std::string> idle_grid_options(const Deck& deck) {
  std::vector<std::string> told;
  const auto tell = [&](const char* why, std::initializer_list<std::string_view> options) {
    if (const std::string idle = given_of(deck, options); !idle.empty())
      told.push_back(fmt::format("{}; no effect: {}", why, idle));
  };
  if (!has_shapes(deck))
    tell("the input has no shapes to be measured",
         {"vfrac_method", "threads_process", "cell_size", "bbox_expand", "align"});
  else if (deck.given("cell_size"))
    tell("cell_size makes the grid", {"nelx", "nely", "nelz"});
  if (deck.capture != kCaptureCurves) tell("capture is not 5", {"capture_side"});
  if (deck.capture != kCaptureCurves &&
      !(deck.gen_sidesets == kSidesetsGeometricSurfaces || deck.gen_sidesets == kSidesetsGeometricSidesets ||
        deck.gen_sidesets == kSidesetsInputMeshAndStl))
    tell("no smooth surfaces of facets are asked for", {"capture_angle"});
  if (!deck.input_vfrac.empty())
    tell("the volume fractions have a grid of their own",
         {"nelx", "nely", "nelz", "xmin", "xmax", "ymin", "ymax", "zmin", "zmax"});
  if (!deck.input_vfrac.empty() && !deck.mesh_void && !deck.given("thicken_void"))
    tell("the volume fractions tell which material is void", {"void_mat"});
  if (deck.input_mesh.empty() && deck.input_mesh_pamgen.empty()) {
    tell("there is no input mesh",
         {"feature_angle", "exterior_sliding", "input_mesh_partition", "input_mesh_material"});
    return told;
  }
  if (deck.input_spn.empty() && !has_shapes(deck))
    tell("the materials are element variables, which leave no void to the blocks", {"input_mesh_material"});
  if (deck.input_spn.empty()) tell("the input mesh is the grid", {"nelx", "nely", "nelz"});
  tell("the input mesh has a place and cells of its own",
       {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax", "cell_size", "bbox_expand", "align"});
  return told;
}

std::vector<std::string> idle_without_grid(const Deck& deck) {
  std::vector<std::string> told = idle_adapt_options(deck);
  const std::string idle =
      given_of(deck, {"iproc", "jproc", "kproc", "check_periodic", "check_periodic_tol"});
  if (!idle.empty()) told.push_back(fmt::format("the input mesh is no Cartesian grid; no effect: {}", idle));
  return told;
}

}  // namespace sculpt
