// Inputs through the whole program: what is in the file is what is in the mesh.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cases.hpp"
#include "scratch.hpp"

namespace sculpt::cli {
namespace {

using Counts = std::map<std::int64_t, std::int64_t>;

constexpr const char* kRaw = "stair = fast\n";  // one hex per cell

// Material of the cell at each place of a mesh of unit cells.
std::map<std::array<int, 3>, std::int64_t> cells_of(const RankMesh& mesh) {
  std::map<std::array<int, 3>, std::int64_t> cells;
  for (const RankMesh::Block& block : mesh.blocks)
    for (std::size_t first = 0; first < block.nodes.size(); first += 8) {
      std::array<double, 3> low{1e300, 1e300, 1e300};
      for (std::size_t c = first; c < first + 8; ++c) {
        const auto node = static_cast<std::size_t>(block.nodes[c]) - 1;
        low = {std::min(low[0], mesh.x[node]), std::min(low[1], mesh.y[node]),
               std::min(low[2], mesh.z[node])};
      }
      cells[{static_cast<int>(std::lround(low[0])), static_cast<int>(std::lround(low[1])),
             static_cast<int>(std::lround(low[2]))}] = block.id;
    }
  return cells;
}

class Input : public Scratch {
 protected:
  void expect_cells(const RankMesh& mesh, const Voxels& voxels) const {
    const auto cells = cells_of(mesh);
    EXPECT_EQ(cells.size(),
              static_cast<std::size_t>(voxels.nx) * static_cast<std::size_t>(voxels.ny * voxels.nz));
    for (const auto& [cell, id] : cells)
      EXPECT_EQ(id, voxels.id(cell[0], cell[1], cell[2]))
          << fmt::format("cell {} {} {}", cell[0], cell[1], cell[2]);
  }
};

// A 2 x 3 x 4 grid in which every cell has its own id.
Voxels all_different() {
  return {2, 3, 4, [](int i, int j, int k) { return 1 + i + 2 * (j + 3 * k); }};
}

TEST_F(Input, SpnOrders) {
  const std::vector<std::vector<int>> orders{{0, 1, 2}, {0, 2, 1}, {1, 0, 2},
                                             {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  const char* const names[] = {"xyz", "xzy", "yxz", "yzx", "zxy", "zyx"};
  for (std::size_t order = 0; order < orders.size(); ++order) {
    SCOPED_TRACE(names[order]);
    write("v.spn", spn_text(all_different(), orders[order]));
    const std::string deck = spn_deck(all_different(), "v.spn") + kRaw;
    expect_cells(mesh(deck + fmt::format("spn_xyz_order = {}\n", order), 1), all_different());
    expect_cells(mesh(deck + fmt::format("spn_xyz_order = {}\n", names[order]), 2), all_different());
  }
}

TEST_F(Input, SpnOrderIsXOutermostUnlessSaid) {
  write("v.spn", spn_text(all_different(), {0, 1, 2}));
  expect_cells(mesh(spn_deck(all_different(), "v.spn") + kRaw, 1), all_different());
}

TEST_F(Input, SpnIdsStayAsTheyAre) {
  const Voxels voxels{4, 3, 2, [](int i, int, int) { return i == 0 ? 0 : i == 1 ? 7 : 2000000000; }};
  write("v.spn", spn_text(voxels));
  const std::string deck = spn_deck(voxels, "v.spn") + kRaw;
  for (const int ranks : {1, 3}) {
    EXPECT_EQ(hexes_by_block(mesh(deck, ranks)), (Counts{{0, 6}, {7, 6}, {2000000000, 12}}));
    EXPECT_EQ(hexes_by_block(mesh(deck + "compress_spn_ids = true\n", ranks)),
              (Counts{{1, 6}, {2, 6}, {3, 12}}));
  }
}

TEST_F(Input, SpnVoidIsNotMeshed) {
  const Voxels voxels{4, 3, 2, [](int i, int, int) { return i == 0 ? 0 : i == 1 ? 7 : 9; }};
  write("v.spn", spn_text(voxels));
  const std::string deck = spn_deck(voxels, "v.spn") + kRaw;
  for (const int ranks : {1, 3}) {
    EXPECT_EQ(hexes_by_block(mesh(deck + "void_mat = 7\n", ranks)), (Counts{{0, 6}, {9, 12}}));
    EXPECT_EQ(hexes_by_block(mesh(deck + "void_mat = 5\n", ranks)), (Counts{{0, 6}, {7, 6}, {9, 12}}))
        << "no cell has it";
  }
}

// One buffer hex on each meshed side of every interface quad.
TEST_F(Input, BufferHexesOfAPlane) {
  const Voxels voxels{4, 3, 2, [](int i, int, int) { return i < 2 ? 1 : 2; }};
  write("v.spn", spn_text(voxels));
  const std::string deck = spn_deck(voxels, "v.spn");
  EXPECT_EQ(hexes_by_block(mesh(deck, 2)), (Counts{{1, 12 + 6}, {2, 12 + 6}}));
  EXPECT_EQ(hexes_by_block(mesh(deck + "void_mat = 2\n", 2)), (Counts{{1, 12 + 6}}));
}

TEST_F(Input, MicroExpandAddsLayers) {
  write("v.spn", spn_text(letter_f()));
  EXPECT_EQ(hexes_of(mesh(spn_deck(letter_f(), "v.spn") + kRaw + "micro_expand = 2\n", 2)), 7 * 9 * 8);
}

TEST_F(Input, FractionsDecideByTheLargest) {
  write("f.tec",
        "VARIABLES = x y z a b\nZONE I=3 J=1 K=1\n"
        "0 0 0 1 0\n1 0 0 0.625 0.375\n2 0 0 0.125 0.875\n");
  const RankMesh found = mesh("input_micro = f.tec\nstair = full\n", 1);
  EXPECT_EQ(hexes_by_block(found), (Counts{{1, 2}, {2, 1}}));
  EXPECT_EQ(*std::min_element(found.x.begin(), found.x.end()), -0.5);
  EXPECT_EQ(*std::max_element(found.x.begin(), found.x.end()), 2.5);
  EXPECT_EQ(hexes_by_block(mesh("input_micro = f.tec\nstair = full\nxmin = 0.6\n", 2)),
            (Counts{{1, 1}, {2, 1}}))
      << "clipped";
}

TEST_F(Input, SpheresLeaveTheVoidOut) {
  write("s.diatom", two_spheres());
  const std::string deck = two_spheres_deck("s.diatom") + "stair = full\n";
  const Counts alone = hexes_by_block(mesh(deck, 1));
  EXPECT_EQ(alone.size(), 2U);
  Counts all = hexes_by_block(mesh(deck + "mesh_void = true\n", 2));
  EXPECT_EQ(all[3], 16 * 16 * 16 - 552) << "the void's block follows the largest material";
  all.erase(3);
  EXPECT_EQ(all, alone);
}

// A mesh of cells is an input as well; eighths keep the coordinates exact.
TEST_F(Input, CellsAsExodusFileGoRound) {
  const Voxels layer = one_layer();
  write("v.spn", spn_text(layer));
  const RankMesh first = mesh(spn_deck(layer, "v.spn") + kRaw + "scale = 0.125\nztranslate = 2\n", 1);
  for (const int ranks : {2, 3}) {
    const RankMesh again = mesh(fmt::format("input_cart_exo = mesh1.e\n{}", kRaw), ranks);
    EXPECT_EQ(hexes_by_block(again), hexes_by_block(first));
    EXPECT_EQ(again.x, first.x);
    EXPECT_EQ(again.z, first.z);
    EXPECT_TRUE(again == first);
  }
}

TEST_F(Input, CellsAsExodusFileGiveTheSameMesh) {
  const Voxels voxels = grains(8, 6, 5);
  write("v.spn", spn_text(voxels));
  const std::string options = "smooth = 3\ncsmooth = 2\nlaplacian_iters = 10\n";
  const RankMesh direct = mesh(spn_deck(voxels, "v.spn") + options, 2);
  (void)mesh(spn_deck(voxels, "v.spn") + kRaw, 1);
  EXPECT_TRUE(mesh("input_cart_exo = mesh1.e\n" + options, 3) == direct);
}

}  // namespace
}  // namespace sculpt::cli
