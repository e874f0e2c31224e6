// Ids of sets that meet, options of sets without effect, regions of the void.
#include "pipeline/mesh_sets.hpp"

#include <gtest/gtest.h>

#include "pipeline/void_regions.hpp"
#include "sculpt/deck/parse.hpp"
#include "support/stages.hpp"

namespace sculpt::test {
namespace {

Deck deck(const std::string& lines) {
  return parse_deck("BEGIN SCULPT\n" + lines + "\nEND SCULPT\n", "deck.i");
}

std::string collision(const std::string& lines, const std::vector<std::int64_t>& generated = {},
                      const InputSets& carried = {}) {
  try {
    check_set_ids(deck(lines), generated, carried);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(SetIds, MayBeUsedOnce) {
  const std::string box = "sideset = 7 0 0 0 1 1 1\nnodeset = 7 0 0 0 1 1 1\nsideset = 7 0 0 0 2 2 2";
  EXPECT_EQ(collision(box, {1, 2, 3}), "") << "lines with one id unite; sidesets and nodesets are apart";
  EXPECT_EQ(
      collision("gen_sidesets = rve\n" + box, {6, 7}),
      "side set 7 is made by gen_sidesets = rve and by sideset (line 5 of deck.i); expected another id in "
      "one of them");
  EXPECT_EQ(collision("periodic_nodesets = 7 8\nnodeset = 8 0 0 0 1 1 1"),
            "node set 8 is made by periodic_nodesets (line 2 of deck.i) and by nodeset (line 3 of deck.i); "
            "expected another id in one of them");
  InputSets carried;
  carried.side_sets = {{4, "wall"}};
  carried.node_sets = {{5, ""}};
  EXPECT_EQ(collision("gen_sidesets = input_mesh", {}, carried), "");
  EXPECT_NE(collision("gen_sidesets = input_mesh\nsideset = 4 0 0 0 1 1 1", {}, carried), "");
  EXPECT_NE(collision("gen_sidesets = input_mesh\nnodeset = 5 0 0 0 1 1 1", {}, carried), "");
}

TEST(IdleSetOptions, AreTold) {
  using Told = std::vector<std::string>;
  const MaterialTable no_void{{1, 2, 5}, {}}, with_void{{1, 2, 5}, 2};
  EXPECT_EQ(idle_set_options(deck(""), no_void), Told{});
  const std::string separate = "mesh_void = true\nseparate_void_blocks = true\n";
  EXPECT_EQ(idle_set_options(deck(separate), with_void), Told{});
  EXPECT_EQ(idle_set_options(deck(separate + "void_mat = 5"), no_void), Told{});
  EXPECT_EQ(idle_set_options(deck(separate + "void_mat = 6"), no_void).size(), 1U);
  EXPECT_EQ(idle_set_options(deck("separate_void_blocks = true"), with_void),
            Told{"the void is not meshed; no effect: separate_void_blocks"});
  EXPECT_EQ(idle_set_options(deck("compute_ss_stats = true"), no_void),
            Told{"the mesh has no sidesets; no effect: compute_ss_stats"});
  EXPECT_EQ(idle_set_options(deck("compute_ss_stats = true\nrve_sets = true"), no_void), Told{});
}

// Void in two corners and in the middle, touching nowhere in faces.
TEST(VoidRegions, AreNumberedByTheirFirstHexes) {
  HexMesh mesh = lattice({5, 5, 5});
  std::fill(mesh.material.begin(), mesh.material.end(), 2);
  const auto cell = [](LocalId i, LocalId j, LocalId k) { return at(i + 5 * j + 25 * k); };
  mesh.material[cell(2, 2, 2)] = mesh.material[cell(3, 2, 2)] = 1;
  mesh.material[cell(1, 1, 2)] = 1;  // an edge away
  mesh.material[cell(4, 4, 0)] = 1;
  MaterialTable materials{{3, 4, 9}, 1};
  const VoidRegions regions = separate_void(Comm::self(), mesh, materials, 1);
  EXPECT_EQ(regions.count, 3);
  EXPECT_EQ(materials.block_id, (std::vector<std::int64_t>{3, 4, 9, 10, 11}));
  EXPECT_EQ(mesh.material[cell(4, 4, 0)], 1);
  EXPECT_EQ(mesh.material[cell(1, 1, 2)], 3);
  EXPECT_EQ(mesh.material[cell(2, 2, 2)], 4);
  EXPECT_EQ(mesh.material[cell(3, 2, 2)], 4);
  EXPECT_EQ(mesh.material[cell(0, 0, 0)], 2);

  std::vector<double> input{0, 8, 100};
  share_void_volume(summarise(Comm::self(), mesh), regions, input);
  EXPECT_EQ(input, (std::vector<double>{0, 2, 100, 2, 4}));
}

TEST(VoidRegions, AreTheMaterialOfTheTableOrVoidMat) {
  EXPECT_EQ(void_block(deck("void_mat = 5"), {{1, 2, 5}, 1}), 1);
  EXPECT_EQ(void_block(deck("void_mat = 5"), {{1, 2, 5}, {}}), 2);
  EXPECT_EQ(void_block(deck("void_mat = 6"), {{1, 2, 5}, {}}), std::nullopt);
  EXPECT_EQ(void_block(deck(""), {{0, 2, 5}, {}}), std::nullopt);
}

}  // namespace
}  // namespace sculpt::test
