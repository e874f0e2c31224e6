#include "input/cart_exo.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <numeric>

#include "sculpt/exo/rank_mesh.hpp"
#include "sculpt/exo/write_rank_file.hpp"

namespace sculpt {
namespace {

using MaterialOf = std::function<std::int64_t(const Index3&)>;

// A box of bricks as an Exodus file whose hexes and corners come in a disorderly sequence.
RankMesh bricks(const Index3& n, const Vec3& origin, const Vec3& size, const MaterialOf& material_of) {
  RankMesh mesh;
  const Index3 nodes{n[0] + 1, n[1] + 1, n[2] + 1};
  const IndexBox node_box = whole(nodes), cell_box = whole(n);
  for (std::int64_t p = 0; p < node_box.size(); ++p) {
    const Index3 c = node_box.cell(p);
    mesh.x.push_back(origin.x + static_cast<double>(c[0]) * size.x);
    mesh.y.push_back(origin.y + static_cast<double>(c[1]) * size.y);
    mesh.z.push_back(origin.z + static_cast<double>(c[2]) * size.z);
    mesh.node_id.push_back(p + 1);
  }
  mesh.global_nodes = node_box.size();
  std::map<std::int64_t, std::vector<std::int32_t>, std::greater<>>
      blocks;                                   // the file has them in falling order
  std::int64_t step = cell_box.size() / 2 + 1;  // made coprime to the number of cells: a permutation
  while (std::gcd(step, cell_box.size()) != 1) ++step;
  for (std::int64_t q = 0; q < cell_box.size(); ++q) {
    const Index3 c = cell_box.cell(q * step % cell_box.size());
    const auto node = [&](std::int64_t i, std::int64_t j, std::int64_t k) {
      return static_cast<std::int32_t>(node_box.position({c[0] + i, c[1] + j, c[2] + k}) + 1);
    };
    const std::int32_t corners[8] = {node(0, 0, 0), node(1, 0, 0), node(1, 1, 0), node(0, 1, 0),
                                     node(0, 0, 1), node(1, 0, 1), node(1, 1, 1), node(0, 1, 1)};
    static constexpr int kTurns[4][8] = {{0, 1, 2, 3, 4, 5, 6, 7},
                                         {1, 2, 3, 0, 5, 6, 7, 4},
                                         {0, 4, 5, 1, 3, 7, 6, 2},
                                         {6, 5, 4, 7, 2, 1, 0, 3}};
    for (const int corner : kTurns[q % 4]) blocks[material_of(c)].push_back(corners[corner]);
    mesh.hex_id.push_back(q + 1);
  }
  mesh.global_hexes = cell_box.size();
  for (const auto& [id, list] : blocks) {
    auto& block = mesh.blocks.emplace_back();
    block.id = id;
    block.global_count = static_cast<std::int64_t>(list.size()) / 8;
    block.nodes = list;
  }
  return mesh;
}

class CartExo : public testing::Test {
 protected:
  CartExo() {
    std::string name = (std::filesystem::temp_directory_path() / "sculpt-cart-exo-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    deck_.input_cart_exo = (folder_ / "grid.e").string();
  }
  ~CartExo() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  std::unique_ptr<MaterialSource> open(const RankMesh& mesh) {
    write_rank_file(deck_.input_cart_exo, mesh);
    return open_cart_exo(comm_, deck_, Log());
  }
  std::string refusal(const RankMesh& mesh) {
    try {
      (void)open(mesh);
    } catch (const AgreedError& e) {
      return e.what();
    }
    return "no error";
  }
  // Opens the bricks, wants other boxes on every rank, and compares cell by cell.
  void expect_cells(const Index3& n, const MaterialOf& material_of) {
    const auto source = open(bricks(n, {1, -2, 0.5}, {0.1, 0.25, 1. / 3}, material_of));
    ASSERT_EQ(source->grid().cells, n);
    std::vector<IndexBox> wanted;
    for (int r = 0; r < comm_.size(); ++r) {
      IndexBox box = whole(n);
      if (r % 3 == 1) box.lo = {n[0] / 2, n[1] / 2, n[2] / 2};
      if (r % 3 == 2) box.hi = {n[0], 0, n[2]};  // a rank that wants nothing
      wanted.push_back(box);
    }
    const MaterialData data = source->read(comm_, wanted);
    const IndexBox& mine = wanted[static_cast<std::size_t>(comm_.rank())];
    ASSERT_EQ(data.fractions.cells(), mine.size());
    for (std::int64_t p = 0; p < mine.size(); ++p) {
      const auto at = static_cast<std::size_t>(p);
      ASSERT_EQ(data.fractions.offset[at], p);
      EXPECT_EQ(data.fractions.value[at], 1.0);
      EXPECT_EQ(data.table.block_id[static_cast<std::size_t>(data.fractions.material[at])],
                material_of(mine.cell(p)));
    }
  }

  std::filesystem::path folder_;
  Comm comm_ = Comm::world();
  Deck deck_;
};

std::int64_t checkered(const Index3& c) { return 5 + 7 * ((c[0] + 2 * c[1] + 3 * c[2]) % 4); }
std::int64_t same(const Index3&) { return 3; }

TEST_F(CartExo, GivesEveryCellItsBlock) { expect_cells({4, 3, 5}, checkered); }
TEST_F(CartExo, TakesOneLayerInX) { expect_cells({1, 6, 5}, checkered); }
TEST_F(CartExo, TakesOneLayerInY) { expect_cells({6, 1, 5}, checkered); }
TEST_F(CartExo, TakesOneLayerInZ) { expect_cells({6, 5, 1}, checkered); }
TEST_F(CartExo, TakesASingleCell) { expect_cells({1, 1, 1}, same); }

TEST_F(CartExo, HasThePlanesOfTheFile) {
  const auto source = open(bricks({10, 2, 3}, {-0.3, 1000, 0}, {0.1, 2, 1. / 3}, checkered));
  const auto& planes = source->grid().planes;
  EXPECT_EQ(planes[0].front(), -0.3);
  EXPECT_EQ(planes[0].back(), -0.3 + 10 * 0.1);
  EXPECT_NEAR(planes[0][7], 0.4, 1e-15);
  EXPECT_EQ(planes[1], (std::vector<double>{1000, 1002, 1004}));
  EXPECT_EQ(planes[2].back(), 1.0);
}

TEST_F(CartExo, SortsTheMaterialsAndKnowsTheVoid) {
  deck_.void_mat = 12;
  deck_.given_options.add("void_mat", "test");
  RankMesh mesh = bricks({4, 4, 4}, {0, 0, 0}, {1, 1, 1}, checkered);
  mesh.blocks.emplace_back().id = 1;  // empty: not a material of the data
  const auto source = open(mesh);
  const MaterialTable table =
      source->read(comm_, std::vector<IndexBox>(static_cast<std::size_t>(comm_.size()))).table;
  EXPECT_EQ(table.block_id, (std::vector<std::int64_t>{5, 12, 19, 26}));
  ASSERT_TRUE(table.void_material.has_value());
  EXPECT_EQ(*table.void_material, 1);
}

TEST_F(CartExo, ForgivesSinglePrecision) {
  RankMesh mesh = bricks({50, 2, 2}, {100, 0, 0}, {0.1, 0.1, 0.1}, checkered);
  for (auto* axis : {&mesh.x, &mesh.y, &mesh.z})
    for (double& value : *axis) value = static_cast<double>(static_cast<float>(value));
  EXPECT_EQ(open(mesh)->grid().cells, (Index3{50, 2, 2}));
}

TEST_F(CartExo, NamesTheElementThatIsOffTheGrid) {
  RankMesh mesh = bricks({3, 3, 3}, {0, 0, 0}, {1, 1, 1}, same);
  mesh.x[5] += 1e-3;  // node (1,1,0)
  const std::string text = refusal(mesh);
  EXPECT_NE(text.find("is not a regular Cartesian grid: element"), std::string::npos) << text;
  EXPECT_NE(text.find("has a corner at (1.001, 1, 0), off the planes"), std::string::npos) << text;
}

TEST_F(CartExo, NamesTheElementWithAWrongShape) {
  RankMesh mesh = bricks({3, 3, 3}, {0, 0, 0}, {1, 1, 1}, same);
  mesh.blocks[0].nodes[8 * 13 + 2] = mesh.blocks[0].nodes[8 * 13 + 1];
  EXPECT_NE(refusal(mesh).find("element 14 (block 3) does not have eight different corners"),
            std::string::npos)
      << refusal(mesh);
}

TEST_F(CartExo, NamesAMissingCell) {
  RankMesh mesh = bricks({3, 3, 3}, {0, 0, 0}, {2, 2, 2}, same);
  auto& nodes = mesh.blocks[0].nodes;  // the third hex of the sequence is that of cell 2*14 % 27 = 1
  nodes.erase(nodes.begin() + 16, nodes.begin() + 24);
  mesh.hex_id.pop_back();
  const std::string text = refusal(mesh);
  EXPECT_NE(
      text.find(
          "no element fills cell (1, 0, 0) around (3, 1, 1); found 26 elements, expected 3 x 3 x 3 = 27"),
      std::string::npos)
      << text;
}

TEST_F(CartExo, NamesACellThatIsThereTwice) {
  RankMesh mesh = bricks({3, 3, 3}, {0, 0, 0}, {1, 1, 1}, same);
  auto& nodes = mesh.blocks[0].nodes;
  std::copy(nodes.begin(), nodes.begin() + 8, nodes.end() - 8);
  EXPECT_NE(refusal(mesh).find("element 27 (block 3) fills cell (0, 0, 0), as another element does"),
            std::string::npos)
      << refusal(mesh);
}

TEST_F(CartExo, RefusesCellsOfDifferentSizes) {
  RankMesh mesh = bricks({3, 3, 3}, {0, 0, 0}, {1, 1, 1}, same);
  for (double& x : mesh.x)
    if (x > 2.5) x = 4;
  EXPECT_NE(refusal(mesh).find("is not a regular Cartesian grid"), std::string::npos) << refusal(mesh);
}

TEST_F(CartExo, RefusesAMeshThatFillsLittleOfItsBox) {
  RankMesh mesh = bricks({2, 1, 1}, {0, 0, 0}, {1, 1, 1}, same);
  for (double& x : mesh.x)
    if (x > 1.5) x = 1e6;
  EXPECT_NE(refusal(mesh).find("has room for 1000000 cells, but there are 2 hexes"), std::string::npos)
      << refusal(mesh);
}

TEST_F(CartExo, RefusesOtherElements) {
  RankMesh mesh = bricks({1, 1, 1}, {0, 0, 0}, {1, 1, 1}, same);
  mesh.blocks[0].type = "TETRA";
  mesh.blocks[0].nodes_per_element = 4;
  mesh.hex_id.push_back(2);
  EXPECT_NE(refusal(mesh).find("block 3: elements of type TETRA with 4 nodes, expected HEX8"),
            std::string::npos)
      << refusal(mesh);
}

TEST_F(CartExo, RefusesFilesThatAreMissingForeignOrCut) {
  const auto text = [this] {
    try {
      (void)open_cart_exo(comm_, deck_, Log());
    } catch (const AgreedError& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  EXPECT_NE(text().find("No such file"), std::string::npos) << text();
  std::ofstream(deck_.input_cart_exo) << "1 2 3\n";
  EXPECT_NE(text().find("is not an Exodus file"), std::string::npos) << text();
  write_rank_file(deck_.input_cart_exo, bricks({2, 2, 2}, {0, 0, 0}, {1, 1, 1}, same));
  std::filesystem::resize_file(deck_.input_cart_exo, std::filesystem::file_size(deck_.input_cart_exo) - 16);
  EXPECT_NE(text().find("is cut short"), std::string::npos) << text();
}

}  // namespace
}  // namespace sculpt
