// Meshes with an exterior: the same after every stage, to the last bit, whoever owns which cells.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "support/input_meshes.hpp"
#include "support/mesh_checks.hpp"

namespace sculpt::test {
namespace {

// A number made from the facets of owned faces and from the holds of owned nodes.
std::int64_t exterior_checksum(const Comm& comm, const HexMesh& mesh) {
  std::int64_t sum = 0;
  std::uint64_t mix = 0;
  const auto start = [&](GlobalId id) { mix = static_cast<std::uint64_t>(id); };
  const auto add = [&](std::int64_t word) { mix = scatter(mix, static_cast<std::uint64_t>(word)); };
  const auto add_point = [&](const Vec3& p) {
    for (std::size_t d = 0; d < 3; ++d) add(std::bit_cast<std::int64_t>(p[d]));
  };
  const auto add_facet = [&](const Facet& f) {
    for (std::size_t v = 0; v < 4; ++v) add(f.node[v]);
    for (const Vec3& p : f.corner) add_point(p);
    for (const std::int64_t word : {f.cell, GlobalId{f.face}, GlobalId{f.surface}, GlobalId{f.kept},
                                    GlobalId{f.whole}, GlobalId{mesh.exterior.curved[at(f.surface)]}})
      add(word);
  };
  for (const ExteriorFace& f : mesh.exterior.faces) {
    if (mesh.layer[at(f.hex)] != 0) continue;
    start(8 * mesh.hex_id[at(f.hex)] + f.face);
    add_facet(mesh.exterior.facets[at(f.facet)]);
    sum += static_cast<std::int64_t>(mix >> 24);
  }
  for (LocalId n = 0; n < mesh.nodes(); ++n) {
    if (mesh.node_owner[at(n)] != comm.rank()) continue;
    start(mesh.node_id[at(n)]);
    const LocalId hold = mesh.exterior.hold_of[at(n)];
    if (hold != kNone) {
      const Hold& h = mesh.exterior.holds[at(hold)];
      add(static_cast<std::int64_t>(h.kind));
      for (const Vec3& p : h.line) add_point(p);
      std::vector<std::array<GlobalId, 2>> patch;
      for (auto i = h.first; i < h.last; ++i) {
        const Facet& f = mesh.exterior.facets[at(mesh.exterior.patch[static_cast<std::size_t>(i)])];
        patch.push_back({f.cell, f.face});
      }
      std::sort(patch.begin(), patch.end());
      for (const auto& [cell, face] : patch) add(8 * cell + face);
    }
    sum += static_cast<std::int64_t>(mix >> 24);
  }
  return comm.sum(sum);
}

void expect_same(const InputMeshCase& input, const StageOptions& options = {}) {
  const Comm world = Comm::world(), self = Comm::self();
  const Overlay mine = input_overlay(world, input), whole = input_overlay(self, input);
  EXPECT_EQ(checksum(world, mine.cells), checksum(self, whole.cells)) << input.name << ", distribute";
  EXPECT_EQ(exterior_checksum(world, mine.cells), exterior_checksum(self, whole.cells))
      << input.name << ", exterior";
  EXPECT_EQ(ghost_problem(mine.cells), "") << input.name;
  const StagesResult together = run_stages(world, input, options), alone = run_stages(self, input, options);
  EXPECT_EQ(together.checksums.size(), alone.checksums.size());
  for (std::size_t i = 0; i < std::min(alone.checksums.size(), together.checksums.size()); ++i)
    EXPECT_EQ(together.checksums[i].checksum, alone.checksums[i].checksum)
        << input.name << ", after " << alone.checksums[i].stage;
  EXPECT_EQ(together.ghosts, "") << input.name;
  EXPECT_EQ(exterior_checksum(world, together.mesh), exterior_checksum(self, alone.mesh))
      << input.name << ", exterior of the result";
}

InputMeshCase cylinder_with_grains() {
  InputMeshCase input{"cylinder", generated("cylinder", {"--n", "4", "--layers", "6", "--permute", "3"})};
  input.grains = 5;
  return input;
}
InputMeshCase sphere_with_grains() {
  InputMeshCase input{"sphere", generated("sphere-in-cube",
                                          {"--n", "3", "--inside", "2", "--outside", "2", "--permute", "5"})};
  input.grains = 4;
  input.seed = 11;  // an interface runs along an edge of the cube
  return input;
}
InputMeshCase nested_blocks() {
  InputMeshCase input{"nested", generated("nested", {"--n", "2", "--permute", "7"})};
  input.grains = 4;
  input.seed = 4;
  return input;
}

TEST(SameMeshOfAnInputMesh, OfGrains) {
  for (InputMeshCase input : {cylinder_with_grains(), sphere_with_grains(), nested_blocks()})
    for (const std::uint64_t partition : {7U, 8U}) {
      input.dealt = partition;
      input.slides = partition == 8;
      expect_same(input);
    }
}

TEST(SameMeshOfAnInputMesh, OfBlocksThatStay) {
  InputMeshCase input = nested_blocks();
  for (const std::vector<std::int32_t>& keep :
       {std::vector<std::int32_t>{0}, std::vector<std::int32_t>{1, 3}, std::vector<std::int32_t>{0, 1, 3}}) {
    input.keep = keep;
    expect_same(input);
  }
}

TEST(SameMeshOfAnInputMesh, OfItsBlocksAndAGrain) {
  for (InputMeshCase input : {sphere_with_grains(), nested_blocks()}) {
    input.blocks = true;
    expect_same(input);
  }
}

TEST(SameMeshOfAnInputMesh, WithLayersAndWithoutAMaterial) {
  StageOptions options;
  options.void_material = 0;
  expect_same(cylinder_with_grains(), options);
  options = {};
  options.layers.surfaces = true;
  options.layers.boundary_layers = 1;
  expect_same(sphere_with_grains(), options);
  options.layers.boundary_layers = 0;
  options.layers.curves = true;
  options.layers.curve_threshold = 0.5;
  options.layers.curve_layers = 1;
  InputMeshCase input = nested_blocks();
  input.keep = {0};
  expect_same(input, options);
}

}  // namespace
}  // namespace sculpt::test
