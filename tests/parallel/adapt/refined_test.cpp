// Refined grids are the same, to the last bit, whoever owns which blocks: all ranks together against each
// rank on its own.
#include <gtest/gtest.h>

#include <algorithm>

#include "sculpt/adapt/leaf_fractions.hpp"
#include "sculpt/adapt/leaf_mesh.hpp"
#include "sculpt/distribute/cartesian.hpp"
#include "sculpt/vfrac/fractions.hpp"
#include "support/fields.hpp"
#include "support/mesh_checks.hpp"

namespace sculpt::test {
namespace {

BlockParts cut_parts(const Comm& comm, const Forest& forest) {
  return block_parts(cut_grid(forest.blocks(0), comm.size(), {0, 0, 0}), comm.size());
}
BlockParts parts_by_weight(const Comm& comm, const Forest& forest) {
  const IndexBox blocks = whole(forest.blocks(0));
  std::vector<std::int64_t> weight;
  for (std::int64_t b = 0; b < blocks.size(); ++b) weight.push_back(hexes_in(forest, blocks.cell(b)));
  return balanced_parts(forest.blocks(0), weight, comm.size());
}
using Parts = BlockParts (*)(const Comm&, const Forest&);
constexpr Parts kParts[] = {cut_parts, parts_by_weight};

// Of the colours and levels of the nodes, whichever rank owns which.
std::int64_t node_checksum(const Comm& comm, const HexMesh& mesh) {
  std::int64_t sum = 0;
  for (std::size_t n = 0; n < mesh.node_id.size(); ++n)
    if (mesh.node_owner[n] == comm.rank())
      sum += static_cast<std::int64_t>(
          scatter(scatter(mesh.colour[n], static_cast<std::uint64_t>(1024 * mesh.node_unit[n])),
                  static_cast<std::uint64_t>(mesh.node_id[n])) >>
          24);
  return comm.sum(sum);
}

void expect_same_mesh(const Forest& forest, int layers, const std::string& name) {
  const Comm world = Comm::world(), self = Comm::self();
  const Grid grid = uniform_grid(forest.cells(0), {-1, 0.3, 2}, {0.7, 1.1, 0.9});
  const Vec3 high = grid_point(grid, forest.levels(), forest.cells(forest.levels()));
  const LeafMesh one = leaf_mesh(self, grid, forest, alone(forest), layers, high);
  for (const Parts parts : kParts) {
    const LeafMesh many = leaf_mesh(world, grid, forest, parts(world, forest), layers, high);
    EXPECT_EQ(checksum(world, many.cells), checksum(self, one.cells)) << name;
    EXPECT_EQ(node_checksum(world, many.cells), node_checksum(self, one.cells)) << name;
    EXPECT_EQ(many.cells.colours, one.cells.colours) << name;
    EXPECT_EQ(ghost_problem(many.cells), "") << name;
    EXPECT_EQ(many.cells.ghost_layers, layers);
    // The leaves are those of the owned hexes.
    std::int64_t hexes = 0;
    for (const Leaf& leaf : many.leaves)
      for (LocalId h = leaf.first; h < leaf.end; ++h) hexes += many.cells.layer[at(h)] == 0;
    EXPECT_EQ(hexes, owned_hexes(many.cells)) << name;
    EXPECT_EQ(world.sum(hexes), one.cells.size()) << name;
  }
}

TEST(LeafMesh, IsTheSameAloneAndTogether) {
  const Index3 grids[] = {{8, 9, 7}, {12, 1, 6}, {3, 2, 11}, {1, 1, 1}};
  for (std::uint64_t seed = 0; seed < 8; ++seed)
    expect_same_mesh(random_forest(grids[seed % 4], 1 + static_cast<int>(seed % 3), 0.02, seed),
                     2 + static_cast<int>(seed % 2), "seed " + std::to_string(seed));
  expect_same_mesh(Forest({6, 5, 4}, 2, kNotPeriodic), 2, "nothing refined");
  Forest cut_short({6, 5, 4}, 2, kNotPeriodic, {1, 2, 3});  // ends inside cells
  cut_short.close();
  expect_same_mesh(cut_short, 2, "cut short");
}

// Ghosts are everything within so many hexes of the owned ones.
TEST(LeafMesh, GhostLayersAreComplete) {
  const Comm world = Comm::world();
  const Forest forest = random_forest({8, 7, 6}, 2, 0.01, 3);
  const Grid grid = unit_grid(forest.cells(0));
  const HexMesh all = leaf_mesh(Comm::self(), grid, forest, alone(forest), 2).cells;
  for (const Parts parts : kParts) {
    const HexMesh mine = leaf_mesh(world, grid, forest, parts(world, forest), 2).cells;
    std::vector<std::uint8_t> reached(all.position.size(), 0), taken(all.hexes.size(), 0);
    const auto index = [&](GlobalId id) {
      return static_cast<std::size_t>(std::ranges::lower_bound(all.hex_id, id) - all.hex_id.begin());
    };
    for (std::size_t h = 0; h < mine.hexes.size(); ++h)
      if (mine.layer[h] == 0) taken[index(mine.hex_id[h])] = 1;
    std::vector<std::uint8_t> layer(all.hexes.size(), 255);
    for (std::size_t h = 0; h < taken.size(); ++h)
      if (taken[h]) layer[h] = 0;
    for (std::uint8_t l = 0; l < 2; ++l) {
      for (std::size_t h = 0; h < layer.size(); ++h)
        if (layer[h] <= l)
          for (const LocalId n : all.hexes[h]) reached[at(n)] = 1;
      for (std::size_t h = 0; h < layer.size(); ++h)
        for (const LocalId n : all.hexes[h])
          if (reached[at(n)] && layer[h] == 255) layer[h] = static_cast<std::uint8_t>(l + 1);
    }
    std::size_t expected = 0;
    for (const std::uint8_t l : layer) expected += l != 255;
    EXPECT_EQ(mine.hexes.size(), mine.hexes.empty() ? 0 : expected);
    for (std::size_t h = 0; h < mine.hexes.size(); ++h)
      EXPECT_EQ(mine.layer[h], layer[index(mine.hex_id[h])]) << "hex " << mine.hex_id[h];
  }
}

TEST(LeafFractions, OfGhostsAreThoseOfTheirOwners) {
  const Comm world = Comm::world(), self = Comm::self();
  const Grid grid = unit_grid({9, 8, 7});
  const auto field = balls_field(grid, {{{4.3, 3.9, 3.6}, 2.7, 1}, {{7, 6, 5}, 2, 2}});
  const Forest forest = random_forest(grid.cells, 2, 0.01, 7);
  const Overlay one = refined_overlay(self, grid, forest, alone(forest), *field);
  for (const Parts parts : kParts) {
    const Overlay many = refined_overlay(world, grid, forest, parts(world, forest), *field);
    ASSERT_EQ(many.fractions.cells(), many.cells.size());
    std::int64_t wrong = 0;
    for (LocalId h = 0; h < many.cells.size(); ++h) {
      const auto same = static_cast<LocalId>(
          std::ranges::lower_bound(one.cells.hex_id, many.cells.hex_id[at(h)]) - one.cells.hex_id.begin());
      for (std::int32_t m = 0; m < 3; ++m)
        wrong += fraction_of(many.fractions, h, m) != fraction_of(one.fractions, same, m);
    }
    EXPECT_EQ(wrong, 0);
  }
}

// Each rank marks what it owns; together they have the forest of one rank.
TEST(MarkCells, TogetherAskForWhatOneRankAsksFor) {
  const Comm world = Comm::world();
  const Grid grid = unit_grid({9, 8, 7});
  const auto field = balls_field(grid, {{{4.3, 3.9, 3.6}, 2.7, 1}, {{7, 6, 5}, 2, 2}});
  AdaptCriterion criterion;
  criterion.threshold = 1e-4;
  criterion.non_manifold = true;
  Forest together(grid.cells, 2, kNotPeriodic);
  const IndexBox mine = cut_grid(grid.cells, world.size(), {0, 0, 0}).owned(world.rank());
  mark_cells(grid, mine, *field, criterion, together);
  world.bit_or(together.words());
  together.close();
  const Forest one = marked(grid, 2, *field, criterion);
  Forest copy = one;
  EXPECT_TRUE(std::ranges::equal(together.words(), copy.words()));
}

void expect_same_stages(const Grid& grid, const Forest& forest, MaterialField& field,
                        const StageOptions& options, const std::string& name) {
  const Comm world = Comm::world(), self = Comm::self();
  const int layers = options.layers.ghost_layers();
  const StagesResult one =
      run_stages(self, refined_overlay(self, grid, forest, alone(forest), field, layers), false, options);
  for (const Parts parts : kParts) {
    const StagesResult many = run_stages(
        world, refined_overlay(world, grid, forest, parts(world, forest), field, layers), false, options);
    ASSERT_EQ(many.checksums.size(), one.checksums.size());
    for (std::size_t i = 0; i < one.checksums.size(); ++i)
      EXPECT_EQ(many.checksums[i].checksum, one.checksums[i].checksum)
          << name << ", after " << one.checksums[i].stage;
    EXPECT_EQ(many.ghosts, "") << name;
  }
}

// The balls cross the transitions: cells are refined in one half of the grid only.
TEST(SameMesh, WhereInterfacesCrossTransitions) {
  const Grid grid = unit_grid({8, 8, 8});
  const auto field = balls_field(grid, {{{4.1, 3.9, 4}, 2.6, 1}, {{6.5, 6, 4.4}, 1.6, 2}});
  Forest forest(grid.cells, 1, kNotPeriodic);
  for (std::int64_t k = 0; k < 4; ++k)
    for (std::int64_t j = 0; j < 4; ++j)
      for (std::int64_t i = 0; i < 2; ++i) forest.refine_block(0, {i, j, k});
  forest.close();
  StageOptions options;
  expect_same_stages(grid, forest, *field, options, "half refined");
  options.layers.surfaces = true;
  expect_same_stages(grid, forest, *field, options, "half refined, pillowed");
}

TEST(SameMesh, OfGridsRefinedAtInterfaces) {
  const Grid grid = unit_grid({7, 6, 6});
  const auto field = balls_field(grid, {{{3.1, 2.9, 3}, 1.8, 1}, {{5, 4, 3.4}, 1.6, 2}});
  AdaptCriterion criterion;
  criterion.threshold = 0.3;  // leaves some of the interface coarse
  StageOptions options;
  options.layers.boundaries = options.layers.refined = true;
  expect_same_stages(grid, marked(grid, 2, *field, criterion), *field, options, "two levels");
}

}  // namespace
}  // namespace sculpt::test
