#include <gtest/gtest.h>

#include <set>

#include "sculpt/distribute/cartesian.hpp"
#include "support/mesh_checks.hpp"
#include "support/stages.hpp"

namespace sculpt::test {
namespace {

HexMesh lattice(const Comm& comm, const Index3& cells, int layers) {
  return overlay(comm,
                 voxels("lattice", cells, 5,
                        [](const Index3& c) { return static_cast<std::int32_t>((c[0] + c[1] + c[2]) % 5); }),
                 layers)
      .cells;
}

const Index3 kGrids[] = {{6, 5, 7}, {9, 4, 1}, {1, 2, 1}, {5, 1, 1}, {4, 4, 4}};

TEST(LatticeMesh, EveryCellHasOneOwnerAndEveryNodeAnOwnerThatKnowsIt) {
  const Comm comm = Comm::world();
  for (const Index3& cells : kGrids)
    for (const int layers : {1, 2, 3}) {
      const HexMesh mesh = lattice(comm, cells, layers);
      EXPECT_EQ(comm.sum(owned_hexes(mesh)), whole(cells).size());
      std::int64_t owned = 0;
      for (const std::int32_t owner : mesh.node_owner) owned += owner == comm.rank();
      EXPECT_EQ(comm.sum(owned), (cells[0] + 1) * (cells[1] + 1) * (cells[2] + 1));
      EXPECT_EQ(ghost_problem(mesh), "");
    }
}

TEST(LatticeMesh, OwnersOfNodesHaveAHexThere) {
  const Comm comm = Comm::world();
  for (const Index3& cells : kGrids) {
    const HexMesh mesh = lattice(comm, cells, 2);
    std::set<LocalId> of_owned_hexes;
    for (std::size_t h = 0; h < mesh.hexes.size(); ++h)
      if (mesh.layer[h] == 0) of_owned_hexes.insert(mesh.hexes[h].begin(), mesh.hexes[h].end());
    for (LocalId n = 0; n < mesh.nodes(); ++n)
      if (mesh.node_owner[static_cast<std::size_t>(n)] == comm.rank())
        EXPECT_TRUE(of_owned_hexes.contains(n));
  }
}

TEST(LatticeMesh, LayersAreTheDistanceFromTheOwnedCells) {
  const Comm comm = Comm::world();
  const Index3 cells{6, 5, 7};
  const HexMesh mesh = lattice(comm, cells, 2);
  const IndexBox owned = cut_grid(cells, comm.size(), {0, 0, 0}).owned(comm.rank());
  std::int64_t expected = 0;
  for (std::int64_t id = 0; id < whole(cells).size(); ++id) {
    const Index3 c = whole(cells).cell(id);
    std::int64_t away = 0;
    for (std::size_t d = 0; d < 3; ++d) away = std::max({away, owned.lo[d] - c[d], c[d] - owned.hi[d] + 1});
    const auto at = std::lower_bound(mesh.hex_id.begin(), mesh.hex_id.end(), id);
    const bool here = at != mesh.hex_id.end() && *at == id;
    EXPECT_EQ(here, away <= 2 && !owned.empty());
    if (here) EXPECT_EQ(mesh.layer[static_cast<std::size_t>(at - mesh.hex_id.begin())], away);
    expected += here;
  }
  EXPECT_EQ(mesh.size(), expected);
}

}  // namespace
}  // namespace sculpt::test
