// Side sets of meshes with an exterior, whoever owns the cells: parts of a face may belong to hexes of other
// ranks than its cell.
#include <gtest/gtest.h>

#include "sculpt/write/side_sets.hpp"
#include "support/cases.hpp"
#include "support/input_meshes.hpp"

namespace sculpt::test {
namespace {

struct Found {
  std::int64_t faces = 0, checksum = 0;
  auto operator<=>(const Found&) const = default;
};

// The sets are the surfaces. wanted: what the exterior knows of them.
Found found(const Comm& comm, const InputMeshCase& input, Found& wanted) {
  StageOptions options;
  options.layers.boundary_layers = 1;
  options.smoothing.improve_sweeps = options.smoothing.target_rounds = 0;
  const HexMesh cells = input_overlay(comm, input, options.layers.ghost_layers()).cells;
  SidePlan plan;
  for (const ExteriorFace& f : cells.exterior.faces)
    if (cells.layer[at(f.hex)] == 0)
      plan.inner.push_back({cells.hex_id[at(f.hex)], f.face, cells.exterior.facets[at(f.facet)].surface});
  share_exterior_faces(cells, plan);
  const StagesResult result = run_stages(comm, input, options);
  const HexMesh& mesh = result.mesh;
  const auto mix = [&](std::int64_t set, LocalId hex, int face) {
    const auto id = static_cast<std::uint64_t>(8 * mesh.hex_id[at(hex)] + face);
    return static_cast<std::int64_t>(scatter(id, static_cast<std::uint64_t>(set)) >> 24);
  };
  Found sum;
  for (const SideFace& f : side_faces(plan, mesh, result.pillows, exterior_parts(mesh))) {
    EXPECT_EQ(mesh.layer[at(f.hex)], 0);
    ++sum.faces;
    sum.checksum += mix(f.set, f.hex, f.face);
  }
  for (const ExteriorFace& f : mesh.exterior.faces) {
    if (mesh.layer[at(f.hex)] != 0) continue;
    ++wanted.faces;
    wanted.checksum += mix(mesh.exterior.facets[at(f.facet)].surface, f.hex, f.face);
  }
  wanted = {comm.sum(wanted.faces), comm.sum(wanted.checksum)};
  return {comm.sum(sum.faces), comm.sum(sum.checksum)};
}

TEST(SideSetsOfInputMeshes, AreTheSameAloneAndTogether) {
  InputMeshCase input;
  input.mesh = generated("sphere-in-cube", {"--n", "3", "--inside", "2", "--outside", "2"});
  for (const std::uint64_t seed : {6U, 7U, 11U, 12U}) {  // layers end where hexes have no face
    input.seed = input.dealt = seed;
    Found wanted, alone_wanted;
    const Found together = found(Comm::world(), input, wanted),
                alone = found(Comm::self(), input, alone_wanted);
    EXPECT_TRUE(together == wanted) << "seed " << seed;
    EXPECT_TRUE(alone == alone_wanted) << "seed " << seed;
    EXPECT_TRUE(together == alone) << "seed " << seed;
  }
}

}  // namespace
}  // namespace sculpt::test
