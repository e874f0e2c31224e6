#include "pipeline/idle_options.hpp"

#include <gtest/gtest.h>

#include "sculpt/deck/parse.hpp"

namespace sculpt {
namespace {

using Told = std::vector<std::string>;

Told told(const std::string& lines) {
  return idle_adapt_options(parse_deck("BEGIN SCULPT\n" + lines + "\nEND SCULPT\n", "deck.i"));
}
const std::string kAll =
    "adapt_threshold = 0.1\nadapt_levels = 1\nadapt_material = 3\nadapt_remainder = keep\n"
    "adapt_non_manifold = true\nadapt_load_balance = true\nadapt_export = true\nadapt_memory_stats = true\n";

TEST(IdleAdaptOptions, SayNothingOfADeckWithoutThem) {
  EXPECT_EQ(told(""), Told{});
  EXPECT_EQ(told("adapt_type = off\nadapt_non_manifold = false\nadapt_load_balance = false"), Told{});
}

TEST(IdleAdaptOptions, WithoutAType) {
  EXPECT_EQ(told(kAll), Told{"adapt_type is off; no effect: adapt_threshold, adapt_levels, adapt_material, "
                             "adapt_remainder, adapt_export, adapt_non_manifold, adapt_load_balance, "
                             "adapt_memory_stats"});
  EXPECT_EQ(told("adapt_levels = 2"), Told{"adapt_type is off; no effect: adapt_levels"});
}

TEST(IdleAdaptOptions, OfEachType) {
  const auto of = [](const char* type) { return told(kAll + "adapt_type = " + type); };
  for (const char* type : {"facet_to_surface", "surface_to_facet", "surface_to_surface", "vfrac_average"})
    EXPECT_EQ(of(type),
              Told{std::string("adapt_type is ") + type + "; no effect: adapt_material, adapt_remainder"});
  EXPECT_EQ(of("coarsen"), Told{"adapt_type is coarsen; no effect: adapt_material"});
  EXPECT_EQ(of("resample"), Told{"adapt_type is resample; no effect: adapt_threshold, adapt_material, "
                                 "adapt_non_manifold, adapt_load_balance, adapt_memory_stats"});
  EXPECT_EQ(of("material"), Told{"adapt_type is material; no effect: adapt_threshold, adapt_remainder"});
  EXPECT_EQ(told("adapt_type = coarsen\nadapt_levels = 3\nadapt_threshold = 0\nadapt_remainder = drop"),
            Told{});
}

TEST(IdleAdaptOptions, WithoutLevels) {
  EXPECT_EQ(told("adapt_type = coarsen\nadapt_levels = 0\nadapt_threshold = 0.2\nadapt_export = true"),
            Told{"adapt_levels = 0 leaves the grid as it is; no effect: adapt_type, adapt_threshold"});
  EXPECT_EQ(told("adapt_levels = 0"), Told{"adapt_type is off; no effect: adapt_levels"});
}

TEST(IdleGridOptions, OfMeshesAndGrids) {
  const auto idle = [](const std::string& lines) {
    return idle_grid_options(parse_deck("BEGIN SCULPT\n" + lines + "\nEND SCULPT\n", "deck.i"));
  };
  const std::string grid = "nelx = 2\nnely = 2\nxmin = 0\nzmax = 1\n",
                    mesh =
                        "feature_angle = 100\nexterior_sliding = surface\ninput_mesh_partition = rib\n"
                        "input_mesh_material = automatic\n";
  EXPECT_EQ(idle(grid), Told{});
  EXPECT_EQ(idle(grid + mesh), Told{"there is no input mesh; no effect: feature_angle, exterior_sliding, "
                                    "input_mesh_partition, input_mesh_material"});
  const std::string place = "the input mesh has a place and cells of its own; no effect: xmin, zmax";
  EXPECT_EQ(idle(grid + mesh + "input_mesh = a.g\n"),
            (Told{"the materials are element variables, which leave no void to the blocks; no effect: "
                  "input_mesh_material",
                  "the input mesh is the grid; no effect: nelx, nely", place}));
  EXPECT_EQ(idle(grid + mesh + "input_mesh_pamgen = a.p\ninput_spn = a.spn"), Told{place});
}

TEST(IdleWithoutGrid, TellsOfRefinementAndOfSegments) {
  const auto idle = [](const std::string& lines) {
    return idle_without_grid(parse_deck("BEGIN SCULPT\n" + lines + "\nEND SCULPT\n", "deck.i"));
  };
  EXPECT_EQ(idle("input_mesh = a.g"), Told{});
  EXPECT_EQ(idle("adapt_levels = 2\njproc = 1\ncheck_periodic = false"),
            (Told{"adapt_type is off; no effect: adapt_levels",
                  "the input mesh is no Cartesian grid; no effect: jproc, check_periodic"}));
}

}  // namespace
}  // namespace sculpt
