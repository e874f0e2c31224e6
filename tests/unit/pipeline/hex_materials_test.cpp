#include "pipeline/hex_materials.hpp"

#include <gtest/gtest.h>

#include "sculpt/deck/parse.hpp"

namespace sculpt {
namespace {

using Ids = std::vector<std::int64_t>;
using Indices = std::vector<std::int32_t>;

Deck deck(const std::string& lines = "") {
  return parse_deck("BEGIN SCULPT\n" + lines + "\nEND SCULPT\n", "deck.i");
}

// Materials with these ids; per hex its entries (index, fraction).
HexMaterials materials(Ids ids, const std::vector<std::vector<std::pair<std::int32_t, double>>>& hexes,
                       std::optional<std::int32_t> void_material = {}, bool void_added = false) {
  HexMaterials m;
  m.table.block_id = std::move(ids);
  m.table.void_material = void_material;
  m.void_added = void_added;
  for (const auto& hex : hexes) {
    for (const auto& [material, part] : hex) m.owned.add(material, part);
    m.owned.end_cell();
  }
  return m;
}

Indices add(HexMaterials& m, const BlockMaterials& blocks, const std::string& lines = "") {
  return add_blocks(Comm::self(), deck(lines), m, blocks, Log(false));
}

TEST(AddBlocks, WithoutBlocksChangesNothing) {
  HexMaterials m = materials({3, 7}, {{{0, 0.25}, {1, 0.75}}, {{1, 1}}});
  EXPECT_EQ(add(m, {}), Indices{});
  EXPECT_EQ(m.table.block_id, (Ids{3, 7}));
  EXPECT_EQ(m.owned.material, (Indices{0, 1, 1}));
  EXPECT_EQ(m.owned.value, (std::vector<double>{0.25, 0.75, 1}));
  EXPECT_FALSE(m.table.void_material.has_value());
}

TEST(AddBlocks, BlocksThatStayKeepTheirIds) {
  HexMaterials m = materials({1, 2, 5}, {{{0, 0.5}, {1, 0.25}, {2, 0.25}}});
  // Blocks 2 and 3 stay: material 2 becomes the next free id, which is 6.
  EXPECT_EQ(add(m, {{2, 3, 9}, {1, 1, 0}, {}}), (Indices{1, 2, kNone}));
  EXPECT_EQ(m.table.block_id, (Ids{1, 2, 3, 5, 6}));
  EXPECT_EQ(m.owned.material, (Indices{0, 3, 4})) << "ascending";
  EXPECT_EQ(m.owned.value, (std::vector<double>{0.5, 0.25, 0.25}));
}

TEST(AddBlocks, AnAddedVoidThatNoHexHoldsGoes) {
  HexMaterials m = materials({1, 2, 3}, {{{0, 1}}, {{0, 0.5}, {1, 0.5}}}, 2, true);
  EXPECT_EQ(add(m, {{4}, {1}, {}}), Indices{2});
  EXPECT_EQ(m.table.block_id, (Ids{1, 2, 4}));
  EXPECT_FALSE(m.table.void_material.has_value());
}

TEST(AddBlocks, AVoidThatWasThereStays) {
  HexMaterials m = materials({1, 2, 3}, {{{0, 1}}}, 2, false);
  EXPECT_EQ(add(m, {{9}, {1}, {}}), Indices{3});
  EXPECT_EQ(m.table.block_id, (Ids{1, 2, 3, 9}));
  EXPECT_EQ(m.table.void_material, 2);
}

TEST(AddBlocks, AnAddedVoidGetsTheIdAfterAllOthers) {
  HexMaterials m = materials({1, 2, 3}, {{{0, 0.5}, {2, 0.5}}}, 2, true);
  EXPECT_EQ(add(m, {{8}, {1}, {}}), Indices{2});
  EXPECT_EQ(m.table.block_id, (Ids{1, 2, 8, 9}));
  EXPECT_EQ(m.table.void_material, 3);
  EXPECT_EQ(m.owned.material, (Indices{0, 3}));
}

TEST(AddBlocks, AVoidOfTheUsersIdGivesWayToABlockUnlessItIsMeshed) {
  HexMaterials m = materials({1, 8}, {{{0, 0.5}, {1, 0.5}}}, 1, true);
  EXPECT_EQ(add(m, {{8}, {1}, {}}, "void_mat = 8"), Indices{1});
  EXPECT_EQ(m.table.block_id, (Ids{1, 8, 9}));
  EXPECT_EQ(m.table.void_material, 2);
  m = materials({1, 8}, {{{0, 0.5}, {1, 0.5}}}, 1, true);
  EXPECT_EQ(add(m, {{8}, {1}, {}}, "void_mat = 8\nmesh_void = true"), Indices{1});
  EXPECT_EQ(m.table.block_id, (Ids{1, 8})) << "one with the block";
  EXPECT_EQ(m.table.void_material, 1);
}

// input_mesh_material = geometry_and_blocks: what is void belongs to the block of its hex.
TEST(AddBlocks, VoidBelongsToTheBlocks) {
  HexMaterials m = materials({1, 2}, {{{0, 0.25}, {1, 0.75}}, {{1, 1}}, {{0, 1}}}, 1, true);
  EXPECT_EQ(add(m, {{10, 20, 30}, {0, 0, 1}, {0, 1, 1}}), (Indices{1, 2, 3}));
  EXPECT_EQ(m.table.block_id, (Ids{1, 10, 20, 30}));
  EXPECT_EQ(m.owned.material, (Indices{0, 1, 2, 0}));
  EXPECT_EQ(m.owned.value, (std::vector<double>{0.25, 0.75, 1, 1}));
  EXPECT_FALSE(m.table.void_material.has_value());
}

TEST(AddBlocks, WithTheIdsOfMaterialsWhenVoidBelongsToThem) {
  HexMaterials m = materials({1, 2}, {{{0, 0.25}, {1, 0.75}}}, 1, true);
  EXPECT_EQ(add(m, {{1}, {0}, {0}}), Indices{0}) << "block 1 keeps its id";
  EXPECT_EQ(m.table.block_id, (Ids{1, 2})) << "material 1 has become 2";
  EXPECT_EQ(m.owned.material, (Indices{0, 1}));
  EXPECT_EQ(m.owned.value, (std::vector<double>{0.75, 0.25}));
}

TEST(AddBlocks, SurfacesAreAskedForByTheOldIndices) {
  HexMaterials m = materials({1, 2}, {{{0, 0.5}, {1, 0.5}}});
  m.exact = [](const Vec3&, std::int32_t a, std::int32_t b) {
    return Vec3{static_cast<double>(a), static_cast<double>(b), 0};
  };
  EXPECT_EQ(add(m, {{1}, {1}, {}}), Indices{0});
  EXPECT_EQ(m.table.block_id, (Ids{1, 2, 3}));  // material 1 is 3 now
  EXPECT_EQ(m.exact({}, 1, 2), (Vec3{1, 0, 0}));
  EXPECT_EQ(m.exact({}, 0, 1), (Vec3{kNone, 1, 0})) << "the block has no surface";
}

TEST(MaterialsOfVariables, NeedVariables) {
  EXPECT_THROW((void)materials_of_variables(Comm::self(), "m.g", {}, {}, {}), AgreedError);
  const std::vector<std::string> names{"vf_1", "vf_2"};
  const std::vector<GlobalId> element{0, 1};
  const HexMaterials mixed =
      materials_of_variables(Comm::self(), "m.g", names, element, std::vector<double>{1, 0, 0.5, 0.5});
  EXPECT_EQ(mixed.owned.cells(), 2);
  EXPECT_FALSE(mixed.pure);
  EXPECT_TRUE(
      materials_of_variables(Comm::self(), "m.g", names, element, std::vector<double>{1, 0, 0, 1}).pure);
}

}  // namespace
}  // namespace sculpt
