// Side sets of meshes with an exterior: the parts of each face are those that the exterior knows.
#include <gtest/gtest.h>

#include <algorithm>

#include "sculpt/write/side_sets.hpp"
#include "support/input_meshes.hpp"

namespace sculpt::test {
namespace {

using Entry = std::array<std::int64_t, 3>;  // set, hex, face

void expect_all_parts(const InputMeshCase& input, const StageOptions& options) {
  const HexMesh cells = input_overlay(Comm::self(), input, options.layers.ghost_layers()).cells;
  SidePlan plan;
  for (const ExteriorFace& f : cells.exterior.faces)
    plan.inner.push_back({cells.hex_id[at(f.hex)], f.face, f.facet});
  const StagesResult result = run_stages(Comm::self(), input, options);
  std::vector<Entry> wanted, found;
  for (const ExteriorFace& f : result.mesh.exterior.faces) wanted.push_back({f.facet, f.hex, f.face});
  for (const SideFace& f : side_faces(plan, result.mesh, result.pillows, exterior_parts(result.mesh)))
    found.push_back({f.set, f.hex, f.face});
  std::sort(wanted.begin(), wanted.end());
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found.size(), wanted.size()) << input.name;
  EXPECT_TRUE(found == wanted) << input.name;
}

TEST(SideSetsOfInputMeshes, HoldEveryPartOfTheirFaces) {
  std::vector<InputMeshCase> cases(3);
  cases[0].mesh = generated("cylinder", {"--n", "4", "--layers", "5"});
  cases[1].mesh = generated("sphere-in-cube", {"--n", "3", "--inside", "2", "--outside", "2"});
  cases[2].mesh = generated("nested", {"--n", "1"});
  for (InputMeshCase& input : cases)
    for (const bool surfaces : {false, true})
      for (const int layers : {0, 1})
        for (const std::uint64_t seed :
             {1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U, 9U, 10U, 11U, 12U, 13U, 14U, 15U, 16U, 17U, 18U, 19U, 20U}) {
          input.name = input.mesh.name + ", seed " + std::to_string(seed);
          input.seed = seed;
          StageOptions options;
          options.layers.surfaces = surfaces;
          options.layers.boundary_layers = layers;
          options.smoothing.improve_sweeps = options.smoothing.target_rounds = 0;
          expect_all_parts(input, options);
        }
}

}  // namespace
}  // namespace sculpt::test
