#include "sculpt/mesh/colour.hpp"

#include <gtest/gtest.h>

#include "sculpt/mesh/edit.hpp"
#include "support/cases.hpp"
#include "support/stages.hpp"

namespace sculpt::test {
namespace {

// The parity of a lattice node where `share` of the nodes lose theirs; some cells get a hole, so that the
// valence varies.
struct Coloured {
  HexMesh mesh;
  std::vector<std::uint8_t> preset;
};
Coloured coloured(const Comm& comm, const Index3& cells, double share) {
  Coloured c{overlay(comm, voxels("cells", cells, 1, [](const Index3&) { return 0; }), 2).cells, {}};
  std::vector<std::uint8_t> holes;
  for (const GlobalId id : c.mesh.hex_id)
    holes.push_back(scatter_unit(5, static_cast<std::uint64_t>(id)) < 0.1);
  (void)remove_hexes(comm, c.mesh, holes);
  for (LocalId n = 0; n < c.mesh.nodes(); ++n)
    c.preset.push_back(scatter_unit(7, static_cast<std::uint64_t>(c.mesh.node_id[at(n)])) < share
                           ? kNoColour
                           : c.mesh.colour[at(n)]);
  colour_nodes(c.mesh, c.preset);
  return c;
}

std::int64_t colour_sum(const Comm& comm, const HexMesh& mesh) {
  std::int64_t sum = 0;
  for (LocalId n = 0; n < mesh.nodes(); ++n)
    if (mesh.node_owner[at(n)] == comm.rank())
      sum += static_cast<std::int64_t>(
          scatter(mesh.colour[at(n)], static_cast<std::uint64_t>(mesh.node_id[at(n)])) >> 24);
  return comm.sum(sum);
}

const Index3 kGrids[] = {{9, 8, 7}, {12, 5, 1}, {3, 1, 1}};

TEST(ColourNodes, AreProperAndKeepWhatIsPreset) {
  const Comm comm = Comm::world();
  for (const Index3& cells : kGrids)
    for (const double share : {0.0, 0.3, 1.0}) {
      const auto [mesh, preset] = coloured(comm, cells, share);
      std::int64_t wrong = 0, free = 0;
      for (LocalId n = 0; n < mesh.nodes(); ++n) {
        const std::uint8_t c = mesh.colour[at(n)];
        wrong += preset[at(n)] == kNoColour ? c < kFirstFreeColour || c >= mesh.colours : c != preset[at(n)];
        free += preset[at(n)] == kNoColour;
      }
      for (const Hex& hex : mesh.hexes)
        for (std::size_t a = 0; a < 8; ++a)
          for (std::size_t b = 0; b < a; ++b) wrong += mesh.colour[at(hex[a])] == mesh.colour[at(hex[b])];
      EXPECT_EQ(wrong, 0);
      EXPECT_EQ(mesh.colours == kFirstFreeColour, comm.sum(free) == 0);
      EXPECT_LE(mesh.colours, kFirstFreeColour + 16);
      std::vector<std::uint8_t> of_owners = mesh.colour;
      mesh.node_exchange.copy_to_ghosts(of_owners);
      EXPECT_EQ(of_owners, mesh.colour);
    }
}

TEST(ColourNodes, AreTheSameAloneAndTogether) {
  for (const Index3& cells : kGrids) {
    const Coloured alone = coloured(Comm::self(), cells, 0.6), together = coloured(Comm::world(), cells, 0.6);
    EXPECT_EQ(colour_sum(Comm::self(), alone.mesh), colour_sum(Comm::world(), together.mesh));
    EXPECT_EQ(alone.mesh.colours, together.mesh.colours);
  }
}

}  // namespace
}  // namespace sculpt::test
