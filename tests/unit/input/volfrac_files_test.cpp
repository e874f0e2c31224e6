#include "sculpt/input/volfrac_files.hpp"

#include <gtest/gtest.h>

namespace sculpt {
namespace {

using Names = std::vector<std::string>;

TEST(VolfracNames, TellIdsAndTheVoid) {
  const MaterialTable table{{0, 7, 3}, 1};
  EXPECT_EQ(volfrac_names(table), (Names{"vfrac_0", "vfrac_void_7", "vfrac_3"}));
  const auto read = volfrac_materials(volfrac_names(table));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->block_id, table.block_id);
  EXPECT_EQ(read->void_material, table.void_material);
  EXPECT_FALSE(volfrac_materials({"vfrac_1", "vfrac_2"})->void_material);
}

TEST(VolfracNames, OthersAreRefused) {
  for (const Names& names : {Names{"vf_1"}, Names{"vfrac_"}, Names{"vfrac_1x"}, Names{"vfrac_-1"},
                             Names{"vfrac_1", "vfrac_void_1"}, Names{"vfrac_void_1", "vfrac_void_2"}})
    EXPECT_FALSE(volfrac_materials(names)) << names[0];
}

}  // namespace
}  // namespace sculpt
