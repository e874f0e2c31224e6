#include <gtest/gtest.h>

#include <algorithm>

#include "filter/ring.hpp"
#include "sculpt/filter/filter.hpp"
#include "support/fields.hpp"
#include "support/input_meshes.hpp"
#include "support/stages.hpp"

namespace sculpt {
namespace {

bool manifold(const HexMesh& mesh) {
  return interfaces_are_manifold(mesh, face_neighbours(mesh), NodeHexes(mesh));
}

FilterReport resolve(test::Overlay& o) {
  return filter_materials(o.cells, o.fractions, face_neighbours(o.cells), NodeHexes(o.cells));
}

// A block of 2x2x2 cells with material 1 where the mask says so, inside a grid of material 0 or of 4x4x4
// cells that repeat the block's cells outwards, so that only the middle node can be non-manifold.
test::Case block_of_octants(unsigned mask) {
  return test::voxels("octants", {4, 4, 4}, 2, [mask](const Index3& c) {
    const auto octant = static_cast<unsigned>((c[0] / 2) | (c[1] / 2) << 1 | (c[2] / 2) << 2);
    return static_cast<std::int32_t>(mask >> octant & 1);
  });
}

// Of the 254 ways to fill the eight cells at a node with two materials, 126 are manifold: both materials
// connected through faces.
TEST(InterfacesAreManifold, For126Of254MixedNodes) {
  int mixed = 0;
  for (unsigned mask = 1; mask < 255; ++mask) mixed += manifold(test::overlay(block_of_octants(mask)).cells);
  EXPECT_EQ(mixed, 126);
  EXPECT_TRUE(manifold(test::overlay(block_of_octants(0)).cells));
  EXPECT_TRUE(manifold(test::overlay(block_of_octants(255)).cells));
}

TEST(InterfacesAreManifold, ByHand) {
  EXPECT_TRUE(manifold(test::overlay(block_of_octants(0b00000001)).cells)) << "one octant";
  EXPECT_FALSE(manifold(test::overlay(block_of_octants(0b10000001)).cells)) << "two at a corner";
  EXPECT_FALSE(manifold(test::overlay(block_of_octants(0b00001001)).cells)) << "two at an edge";
  EXPECT_TRUE(manifold(test::overlay(block_of_octants(0b00001011)).cells)) << "an L";
  EXPECT_FALSE(manifold(test::overlay(block_of_octants(0b01111110)).cells)) << "all but two opposite ones";
}

TEST(InterfacesAreManifold, OnTheBoxByTheCellsThatExist) {
  EXPECT_FALSE(manifold(test::overlay(test::voxels({2, 2, 1}, {0, 1, 1, 0})).cells));
  EXPECT_TRUE(manifold(test::overlay(test::voxels({2, 2, 1}, {0, 1, 0, 1})).cells));
  EXPECT_TRUE(manifold(test::overlay(test::voxels({2, 2, 1}, {0, 1, 2, 0})).cells) ==
              manifold(test::overlay(test::voxels({2, 2, 1}, {1, 0, 0, 2})).cells));
  EXPECT_TRUE(manifold(test::overlay(test::voxels({5, 1, 1}, {0, 1, 0, 2, 0})).cells));
}

TEST(ResolveNonManifold, MendsEveryNodeOfTwoMaterials) {
  for (unsigned mask = 1; mask < 255; ++mask) {
    test::Overlay o = test::overlay(block_of_octants(mask));
    const bool before = manifold(o.cells);
    const std::vector<std::int32_t> material = o.cells.material;
    const FilterReport report = resolve(o);
    EXPECT_TRUE(manifold(o.cells)) << "mask " << mask;
    EXPECT_EQ(report.bad_nodes == 0, before) << "mask " << mask;
    EXPECT_EQ(o.cells.material == material, before) << "mask " << mask;
    EXPECT_EQ(report.forced_nodes, 0) << "mask " << mask;
    EXPECT_LE(report.manifold_cells, 8) << "mask " << mask;
  }
}

// The same block alone in a sea of material 0.
TEST(ResolveNonManifold, MendsSmallParticles) {
  for (unsigned mask = 1; mask < 256; ++mask) {
    test::Overlay o =
        test::overlay(test::voxels("particle", {6, 6, 6}, 2, [mask](const Index3& c) -> std::int32_t {
          for (const std::int64_t x : c)
            if (x != 2 && x != 3) return 0;
          return static_cast<std::int32_t>(mask >> ((c[0] - 2) | (c[1] - 2) << 1 | (c[2] - 2) << 2) & 1);
        }));
    resolve(o);
    EXPECT_TRUE(manifold(o.cells)) << "mask " << mask;
  }
}

void expect_settled(const test::Case& input) {
  test::Overlay o = test::overlay(input);
  resolve(o);
  EXPECT_TRUE(manifold(o.cells)) << input.name;
  const std::vector<std::int32_t> material = o.cells.material;
  const FilterReport again = resolve(o);
  EXPECT_EQ(again.bad_nodes, 0) << input.name;
  EXPECT_EQ(again.manifold_cells, 0) << input.name;
  EXPECT_EQ(o.cells.material, material) << input.name << ": a second run changes something";
  for (const std::int32_t m : material) ASSERT_TRUE(m >= 0 && m < input.materials);
}

TEST(ResolveNonManifold, SettlesRandomVoxels) {
  for (std::int32_t materials = 2; materials <= 8; ++materials)
    expect_settled(test::noise({9, 8, 7}, materials, static_cast<std::uint64_t>(materials)));
  expect_settled(test::noise({8, 8, 8}, 50, 1));
}

TEST(ResolveNonManifold, SettlesRandomFractions) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) expect_settled(test::two_phase_fractions({10, 9, 8}, seed));
}

TEST(ResolveNonManifold, SettlesCheckerboards) {
  for (const Index3 cells :
       {Index3{8, 8, 8}, Index3{9, 7, 5}, Index3{10, 10, 1}, Index3{2, 2, 2}, Index3{12, 2, 1}})
    for (std::int32_t materials = 2; materials <= 3; ++materials)
      expect_settled(test::voxels("checkerboard", cells, materials, [materials](const Index3& c) {
        return static_cast<std::int32_t>((c[0] + c[1] + c[2]) % materials);
      }));
}

TEST(ResolveNonManifold, LeavesThinGridsAlone) {
  test::Overlay row = test::overlay(test::noise({30, 1, 1}, 5, 2));
  const std::vector<std::int32_t> before = row.cells.material;
  EXPECT_EQ(resolve(row).manifold_cells, 0) << "nodes of a row of cells are always manifold";
  EXPECT_EQ(row.cells.material, before);
}

// Where fractions differ the cheapest change wins: of two cells touching at an edge, the one closest to a tie
// goes.
TEST(ResolveNonManifold, ChangesTheCellThatIsClosestToATie) {
  test::Case input = block_of_octants(0);
  input.fill = [](const Index3& c, Fractions& f) {
    const bool first = c[0] < 2 && c[1] < 2, second = c[0] >= 2 && c[1] >= 2;
    if (!first && !second) return f.add(0, 1);
    const double one = first ? 0.55 : 0.95;
    f.add(0, 1 - one);
    f.add(1, one);
  };
  test::Overlay o = test::overlay(input);
  EXPECT_FALSE(manifold(o.cells));
  resolve(o);
  for (std::int64_t p = 0; p < 64; ++p) {
    const Index3 c = whole({4, 4, 4}).cell(p);
    if (c[0] >= 2 && c[1] >= 2)
      EXPECT_EQ(o.cells.material[static_cast<std::size_t>(p)], 1) << "a firm cell changed";
  }
  EXPECT_TRUE(manifold(o.cells));
}

TEST(Ring, ConnectsThroughFacesOnly) {
  const test::Overlay o = test::overlay(block_of_octants(0));
  const FaceNeighbours neighbours = face_neighbours(o.cells);
  const LocalId middle = 2 + 5 * (2 + 5 * 2);
  Ring ring = ring_of(o.cells, neighbours, NodeHexes(o.cells), middle);
  ASSERT_EQ(ring.size, 8);
  EXPECT_TRUE(ring.connected(0));
  EXPECT_TRUE(ring.connected(0b11));
  EXPECT_FALSE(ring.connected(0b1001));
  EXPECT_TRUE(ring.connected(0b1011));
  EXPECT_TRUE(ring.connected(0xff));
  HexMesh loose = o.cells;
  loose.lattice = {0, 0, 0};
  const Ring same = ring_of(loose, neighbours, NodeHexes(loose), middle);
  for (std::size_t c = 0; c < 8; ++c) {
    EXPECT_EQ(same.cell[c], ring.cell[c]);
    EXPECT_EQ(same.touching[c], ring.touching[c]);
  }
}

TEST(Ring, ThreeMaterialsNeedConnectedPartsAndRests) {
  const test::Overlay o = test::overlay(block_of_octants(0));
  const Ring ring = ring_of(o.cells, face_neighbours(o.cells), NodeHexes(o.cells), 2 + 5 * (2 + 5 * 2));
  EXPECT_TRUE(ring.manifold(std::vector<std::int32_t>{0, 0, 1, 1, 2, 2, 2, 2})) << "two quarters on a half";
  EXPECT_TRUE(ring.manifold(std::vector<std::int32_t>{0, 1, 0, 1, 2, 2, 2, 2}));
  EXPECT_FALSE(ring.manifold(std::vector<std::int32_t>{0, 1, 2, 0, 3, 3, 3, 3}))
      << "0 touches itself at an edge";
  EXPECT_TRUE(ring.manifold(std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_FALSE(ring.manifold(std::vector<std::int32_t>{0, 1, 1, 1, 1, 1, 1, 0}));
}

// An L of three columns: where they meet three cells are around an edge of the boundary.
test::WholeMesh bent(std::int64_t height) {
  test::WholeMesh mesh = test::whole_grid(test::unit_grid({2, 2, height}));
  std::vector<std::array<GlobalId, 8>> corner;
  for (std::size_t e = 0; e < mesh.corner.size(); ++e)
    if (e % 4 != 3) corner.push_back(mesh.corner[e]);
  mesh.corner = corner;
  mesh.block.assign(corner.size(), 0);
  mesh.value.assign(2 * corner.size(), 0);
  return mesh;
}

// The middle column: cells of 0 beside it are connected below, but not at the edge where all three meet.
TEST(ResolveNonManifold, AtEdgesWhereTheBoundaryBendsInwards) {
  test::WholeMesh mesh = bent(3);
  std::vector<GlobalId> used;  // nodes of no element go
  for (const auto& c : mesh.corner) used.insert(used.end(), c.begin(), c.end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  std::vector<Vec3> position;
  for (const GlobalId n : used) position.push_back(mesh.position[static_cast<std::size_t>(n)]);
  mesh.position = position;
  for (auto& c : mesh.corner)
    for (GlobalId& n : c) n = std::lower_bound(used.begin(), used.end(), n) - used.begin();
  test::Overlay o;
  o.cells = test::input_cells(Comm::self(), mesh).cells;
  const FaceNeighbours neighbours = face_neighbours(o.cells);
  for (LocalId c = 0; c < o.cells.size(); ++c) {
    const Vec3 low = o.cells.corners(c)[0];
    o.fractions.add(low.x == 0 && low.y == 0 && low.z > 0 ? 1 : 0, 1);
    o.fractions.end_cell();
  }
  assign_materials(o.cells, o.fractions, neighbours);
  EXPECT_FALSE(manifold(o.cells));
  const NodeHexes around(o.cells);
  for (LocalId n = 0; n < o.cells.nodes(); ++n) {
    const Ring ring = ring_of(o.cells, neighbours, around, n);
    const Vec3& p = o.cells.position[at(n)];
    EXPECT_EQ(ring.edges, p.x == 1 && p.y == 1 ? (p.z == 0 || p.z == 3 ? 1 : 2) : 0);
  }
  EXPECT_GT(resolve(o).manifold_cells, 0);
  EXPECT_TRUE(manifold(o.cells));
}

}  // namespace
}  // namespace sculpt
