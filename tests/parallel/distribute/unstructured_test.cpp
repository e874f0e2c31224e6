// The mesh of unstructured elements is the same whoever has which of them: all ranks together against the
// whole mesh.
#include "sculpt/distribute/unstructured.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "sculpt/distribute/repartition.hpp"
#include "support/cases.hpp"
#include "support/mesh_checks.hpp"
#include "support/shares.hpp"

namespace sculpt::test {
namespace {

std::vector<WholeMesh> meshes() {
  std::vector<WholeMesh> all;
  all.push_back(permuted(whole_grid(uniform_grid({7, 5, 6}, {-1, 0.3, 2}, {0.7, 1.1, 0.9})), 3));
  all.push_back(permuted(cylinder(3, 4), 5));
  all.push_back(whole_grid(uniform_grid({1, 1, 1}, {0, 0, 0}, {2, 2, 2})));
  all.push_back(permuted(whole_grid(uniform_grid({3, 1, 1}, {0, 0, 0}, {1, 1, 1})), 9));  // fewer than ranks
  return all;
}

// Elements around each element by layers, by force.
class Layers {
 public:
  explicit Layers(const WholeMesh& mesh) : mesh_(mesh), at_(mesh.position.size()) {
    for (std::size_t e = 0; e < mesh.corner.size(); ++e)
      for (const GlobalId n : mesh.corner[e]) at_[static_cast<std::size_t>(n)].push_back(e);
  }
  // From the elements of layer 0 on; absent: beyond `layers`.
  [[nodiscard]] std::map<GlobalId, int> around(const std::vector<GlobalId>& owned, int layers) const {
    std::map<GlobalId, int> layer;
    for (const GlobalId e : owned) layer[e] = 0;
    for (int l = 1; l <= layers; ++l) {
      const std::map<GlobalId, int> before = layer;
      for (const auto& [e, its] : before)
        for (const GlobalId n : mesh_.corner[static_cast<std::size_t>(e)])
          for (const std::size_t other : at_[static_cast<std::size_t>(n)])
            layer.try_emplace(static_cast<GlobalId>(other), l);
    }
    return layer;
  }
  [[nodiscard]] const std::vector<std::size_t>& at_node(GlobalId n) const {
    return at_[static_cast<std::size_t>(n)];
  }

 private:
  const WholeMesh& mesh_;
  std::vector<std::vector<std::size_t>> at_;
};

// Local: all that this rank has is what the whole mesh says, and all that it should have is there.
void expect_part_of(const WholeMesh& whole, const ElementShare& share, const UnstructuredMesh& mesh,
                    int layers, const std::vector<std::int32_t>& owner) {
  const HexMesh& cells = mesh.cells;
  const Layers around(whole);
  const std::map<GlobalId, int> expected = around.around(share.element, layers);
  ASSERT_EQ(cells.hex_id.size(), expected.size());
  ASSERT_TRUE(std::is_sorted(cells.node_id.begin(), cells.node_id.end()));
  std::vector<double> value;
  std::size_t h = 0;
  for (const auto& [id, layer] : expected) {
    const auto e = static_cast<std::size_t>(id);
    ASSERT_EQ(cells.hex_id[h], id);
    EXPECT_EQ(int{cells.layer[h]}, layer);
    EXPECT_EQ(cells.hex_owner[h], owner[e]);
    EXPECT_EQ(mesh.block[h], whole.block[e]);
    for (std::size_t c = 0; c < 8; ++c)
      ASSERT_EQ(cells.node_id[at(cells.hexes[h][c])], whole.corner[e][c]) << "hex " << id;
    if (layer == 0) value.insert(value.end(), whole.value.begin() + 2 * id, whole.value.begin() + 2 * id + 2);
    ++h;
  }
  EXPECT_EQ(mesh.value, value);
  for (std::size_t n = 0; n < cells.node_id.size(); ++n) {
    EXPECT_EQ(cells.position[n], whole.position[static_cast<std::size_t>(cells.node_id[n])]);
    EXPECT_EQ(cells.node_owner[n], owner[around.at_node(cells.node_id[n]).front()]);
  }
  EXPECT_EQ(cells.ghost_layers, layers);
  EXPECT_EQ(cells.lattice, (std::array<LocalId, 3>{0, 0, 0}));
  EXPECT_TRUE(cells.node_unit.empty());
}

std::vector<std::int32_t> owners(const Comm& comm, const ElementShare& share) {
  std::vector<std::int64_t> owner(static_cast<std::size_t>(share.elements), 0);
  for (const GlobalId e : share.element) owner[static_cast<std::size_t>(e)] = comm.rank() + 1;
  comm.sum(owner);
  std::vector<std::int32_t> result;
  for (const std::int64_t o : owner) result.push_back(static_cast<std::int32_t>(o - 1));
  return result;
}

void expect_exchanges_work(const HexMesh& cells) {
  std::vector<GlobalId> node(cells.node_id.size(), -1), hex(cells.hex_id.size(), -1);
  const int rank = cells.node_exchange.comm().rank();
  for (std::size_t n = 0; n < node.size(); ++n)
    if (cells.node_owner[n] == rank) node[n] = cells.node_id[n];
  for (std::size_t h = 0; h < hex.size(); ++h)
    if (cells.hex_owner[h] == rank) hex[h] = cells.hex_id[h];
  cells.node_exchange.copy_to_ghosts(node);
  cells.hex_exchange.copy_to_ghosts(hex);
  EXPECT_EQ(node, cells.node_id);
  EXPECT_EQ(hex, cells.hex_id);
}

// Colours of the nodes that a rank has, against those of the whole mesh.
void expect_colours_of(const HexMesh& all, const HexMesh& cells) {
  EXPECT_EQ(cells.colours, all.colours);
  for (std::size_t n = 0; n < cells.node_id.size(); ++n)
    EXPECT_EQ(cells.colour[n], all.colour[static_cast<std::size_t>(cells.node_id[n])]);
}

void expect_same_mesh(const WholeMesh& whole, const ElementShare& share, int layers) {
  const Comm world = Comm::world(), self = Comm::self();
  UnstructuredMesh one = unstructured_mesh(self, in_pieces(self, whole), layers);
  UnstructuredMesh many = unstructured_mesh(world, share, layers);
  expect_part_of(whole, share, many, layers, owners(world, share));
  expect_exchanges_work(many.cells);
  expect_colours_of(one.cells, many.cells);
  EXPECT_EQ(many.cells.cell_size, one.cells.cell_size);
  one.cells.material = one.block;
  many.cells.material = many.block;
  EXPECT_EQ(conformity_problem(one.cells), "");
  EXPECT_EQ(ghost_problem(many.cells), "");
  EXPECT_EQ(checksum(world, many.cells), checksum(self, one.cells));
}

TEST(UnstructuredMesh, IsTheSameWhoeverHasWhat) {
  const Comm world = Comm::world();
  for (const WholeMesh& whole : meshes())
    for (const int layers : {1, 2, 3}) {
      SCOPED_TRACE(whole.name);
      expect_same_mesh(whole, in_pieces(world, whole), layers);
      for (std::uint64_t seed = 0; seed < 3; ++seed)
        expect_same_mesh(whole, dealt(world, whole, 10 * seed), layers);
    }
}

TEST(UnstructuredMesh, TakesPartitions) {
  const Comm world = Comm::world();
  for (const WholeMesh& whole : meshes())
    for (const PartitionMethod method :
         {PartitionMethod::kRcb, PartitionMethod::kRib, PartitionMethod::kHsfc, PartitionMethod::kGraph}) {
      SCOPED_TRACE(whole.name);
      ElementShare share = dealt(world, whole, 4);
      repartition(world, share, method);
      expect_same_mesh(whole, share, 2);
    }
}

TEST(UnstructuredMesh, TakesElementsThatOneRankHas) {
  const Comm world = Comm::world(), self = Comm::self();
  const WholeMesh whole = permuted(cylinder(2, 2), 1);
  ElementShare share = in_pieces(self, whole);
  if (world.rank() != world.size() - 1) {
    const ElementShare nothing{share.elements, share.nodes, {}, {}, {}, 2, {}, {}, {}};
    share = nothing;
  }
  expect_same_mesh(whole, share, 2);
}

// Few elements on all ranks but the first, with numbers so far apart that their nodes are not kept as bits.
TEST(UnstructuredMesh, TakesFewElementsOfALongGrid) {
  const Comm world = Comm::world();
  const WholeMesh whole = permuted(whole_grid(uniform_grid({900, 1, 1}, {0, 0, 0}, {1, 1, 1})), 2);
  ElementShare share = dealt(world, whole, 8);
  std::vector<std::int32_t> to;
  for (const GlobalId e : share.element) to.push_back(e % 300 < world.size() ? static_cast<int>(e % 300) : 0);
  move_elements(world, share, to);
  expect_same_mesh(whole, share, 2);
}

TEST(UnstructuredMesh, HasCellsOfTheMeanVolume) {
  const Comm world = Comm::world();
  const WholeMesh cubes = whole_grid(uniform_grid({3, 4, 2}, {0, 0, 0}, {0.5, 0.5, 0.5}));
  EXPECT_NEAR(unstructured_mesh(world, dealt(world, cubes, 1), 1).cells.cell_size.y, 0.5, 1e-15);
  // One cell of 1e6 and many of 1.
  Grid grid = uniform_grid({10, 1, 1}, {0, 0, 0}, {1, 1, 1});
  for (std::size_t i = 1; i < 11; ++i) grid.planes[0][i] += 999999;
  const Vec3 size = unstructured_mesh(world, dealt(world, whole_grid(grid), 1), 1).cells.cell_size;
  EXPECT_NEAR(size.x, std::cbrt(100000.9), 1e-6);
}

TEST(UnstructuredMesh, RefusesNodesWithoutCoordinates) {
  const Comm world = Comm::world();
  const WholeMesh whole = whole_grid(uniform_grid({4, 1, 1}, {0, 0, 0}, {1, 1, 1}));
  ElementShare share = in_pieces(world, whole);
  for (const GlobalId missing : {GlobalId{13}, GlobalId{16}}) {
    const auto found = std::find(share.node.begin(), share.node.end(), missing);
    if (found == share.node.end()) continue;
    share.position.erase(share.position.begin() + (found - share.node.begin()));
    share.node.erase(found);
  }
  const auto message = [&](const auto& call) -> std::string {
    try {
      call();
    } catch (const AgreedError& error) {
      return error.what();
    }
    return {};
  };
  const auto expect_node = [](const std::string& said) {
    EXPECT_NE(said.find("node 14 "), std::string::npos) << said;
  };
  expect_node(message([&] { (void)unstructured_mesh(world, share, 2); }));
  if (world.size() > 1)  // there is nothing to do for one rank
    expect_node(message([&] { repartition(world, share, PartitionMethod::kRcb); }));
}

}  // namespace
}  // namespace sculpt::test
