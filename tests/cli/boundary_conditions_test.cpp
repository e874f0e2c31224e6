// Sets and blocks as the files have them.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "bad_input.hpp"
#include "same_bits.hpp"

namespace sculpt::cli {
namespace {

template <class Set>
std::map<std::int64_t, std::string> names_of(const std::vector<Set>& sets) {
  std::map<std::int64_t, std::string> names;
  for (const Set& s : sets) names[s.id] = s.name;
  return names;
}
template <class Set>
const Set& set_named(const std::vector<Set>& sets, const std::string& name) {
  const auto found = std::find_if(sets.begin(), sets.end(), [&](const Set& s) { return s.name == name; });
  EXPECT_NE(found, sets.end()) << name;
  return *found;
}

class BoundaryConditions : public SameBits {
 protected:
  std::string spheres() {
    write("s.diatom", two_spheres());
    return two_spheres_deck("s.diatom");
  }
};

TEST_F(BoundaryConditions, EverythingAtOnce) {
  const RankMesh m = expect_same(
      spheres() +
          "mesh_void = true\ngen_sidesets = rve_variable\nrve_sets = true\ncompute_ss_stats = true\n"
          "scale = 0.5\nxtranslate = 3\nsideset = 50 -5 -8 -8 -5 8 8\nsideset = 50 11 -8 -8 11 8 8\n"
          "sideset = 52 -1 -1 -1 1 1 1\nnodeset = 60 -5 -8 -8 -5 -8 -8\nnodeset_name = 60 corner\n"
          "sideset_name = 50 ends\nsideset_name = 77 nothing\nmaterial_name = 1 ball\n",
      {3, 8});
  EXPECT_EQ(names_of(m.side_sets), (std::map<std::int64_t, std::string>{{1, ""},
                                                                        {2, ""},
                                                                        {3, ""},
                                                                        {4, ""},
                                                                        {5, ""},
                                                                        {6, ""},
                                                                        {7, ""},
                                                                        {8, ""},
                                                                        {50, "ends"},
                                                                        {52, ""},
                                                                        {53, "ball_2"},
                                                                        {54, "2_3"}}));
  std::map<std::int64_t, std::size_t> size;
  for (const auto& s : m.side_sets) size[s.id] = s.element.size();
  EXPECT_EQ(size[50], 512U);
  EXPECT_EQ(size[52], 0U);
  EXPECT_EQ(size[53], size[8]);
  EXPECT_EQ(size[54], size[7]);
  EXPECT_EQ(m.node_sets.size(), 27U);
  EXPECT_EQ(m.node_sets.front().id, 60);
  EXPECT_EQ(set_named(m.node_sets, "corner").node, set_named(m.node_sets, "xmin_ymin_zmin").node);
  EXPECT_EQ(set_named(m.node_sets, "xmax_zmin").node.size(), 17U);
  const std::string& out = first_console();
  EXPECT_NE(out.find("WARNING: sideset 52: no face on the boundary"), std::string::npos);
  EXPECT_NE(out.find("WARNING: sideset_name = 77 nothing"), std::string::npos);
  EXPECT_EQ(out.find("WARNING: sideset_name = 50"), std::string::npos);
  EXPECT_NE(out.find("separate"), 0U);
  // The table: the ends have the area of two sides of the box.
  EXPECT_NE(out.find("      50       512            512    1.0000    1.0000    1.0000"), std::string::npos);
}

TEST_F(BoundaryConditions, SetsOfTheGeometry) {
  const RankMesh m = expect_same(spheres() + "gen_sidesets = geometric_surfaces\n", {4});
  const RankMesh parts = mesh(spheres() + "gen_sidesets = geometric_sidesets\n", 1);
  ASSERT_EQ(m.side_sets.size(), 2U);
  ASSERT_EQ(parts.side_sets.size(), 2U);
  for (const std::size_t s : {0U, 1U}) {
    EXPECT_EQ(m.side_sets[s].id, static_cast<std::int64_t>(s) + 1);
    EXPECT_EQ(m.side_sets[s].name, parts.side_sets[s].name + " 1");
    EXPECT_EQ(m.side_sets[s].element, parts.side_sets[s].element);
  }
  EXPECT_LT(m.side_sets[0].element.size(), m.side_sets[1].element.size()) << "the inner sphere is the first";
}

// The mesh is the same but for the ids of blocks.
TEST_F(BoundaryConditions, RegionsOfTheVoidAreBlocks) {
  const Voxels holes{8, 7, 6, [](int i, int j, int k) {
                       return (i < 3 && j > 3 && k > 2) || (i > 4 && j < 3 && k < 3) ? 1 : 4;
                     }};
  const std::string deck = "mesh_void = true\nvoid_mat = 1\ncompare_volume = true\n";
  const RankMesh whole = expect_same(holes, deck, {2});
  const RankMesh apart = expect_same(holes, deck + "separate_void_blocks = true\n", {2, 5});
  EXPECT_TRUE(same_bits(apart.x, whole.x) && same_bits(apart.y, whole.y) && same_bits(apart.z, whole.z));
  auto blocks = hexes_by_block(apart), before = hexes_by_block(whole);
  ASSERT_EQ(blocks.size(), 3U);
  EXPECT_EQ(blocks.at(4), before.at(4));
  EXPECT_EQ(blocks.at(1) + blocks.at(5), before.at(1));
  EXPECT_NE(first_console().find("separate_void_blocks: block 1 has 2 regions"), std::string::npos);
}

const auto in_deck = [](const std::string& more) { return [more](BadInput& t) { t.write_deck(more); }; };

using RefusedSets = Refused;
TEST_P(RefusedSets, WithOneMessage) { expect_refused_once(); }
const Mistake kMistakes[] = {
    {"IdOfAGeneratedSet",
     in_deck("gen_sidesets = rve\nsideset = 6 0 0 0 1 1 1\n"),
     {"side set 6 is made by gen_sidesets = rve and by sideset (line 7 of deck.i)"}},
    {"SurfacesOfVoxels",
     in_deck("gen_sidesets = geometric_surfaces\n"),
     {"need a geometry that has surfaces", "line 6 of deck.i"}},
    {"TurnedBox",
     in_deck("nodeset = 6 0 2 0 1 1 1\n"),
     {"deck.i:6: option 'nodeset' needs an id and a box", "found '6 0 2 0 1 1 1'"}},
    {"SetZero", in_deck("sideset = 0 0 0 0 1 1 1\n"), {"deck.i:6", "an integer from 1"}},
    {"LongName",
     in_deck("rve_sets = true\nnodeset_name = 3 " + std::string(256, 'n') + "\n"),
     {"the name of id 3 has 256 characters"}},
};
INSTANTIATE_TEST_SUITE_P(Mistakes, RefusedSets,
                         ::testing::Combine(::testing::ValuesIn(kMistakes), ::testing::Values(2)),
                         mistake_name);

}  // namespace
}  // namespace sculpt::cli
