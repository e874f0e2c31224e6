// Node sets of the sides, edges and corners of boxes and of periodic meshes.
#include "sculpt/write/node_sets.hpp"

#include <gtest/gtest.h>

#include <set>

#include "support/stages.hpp"

namespace sculpt::test {
namespace {

TEST(BoxPlaces, AreNamedByTheirSides) {
  std::vector<std::string> names;
  for (const BoxPlace& place : box_places()) names.push_back(place_name(place));
  const std::vector<std::string> wanted{
      "xmin",           "xmax",           "ymin",           "ymax",           "zmin",
      "zmax",           "xmin_ymin",      "xmin_ymax",      "xmax_ymin",      "xmax_ymax",
      "xmin_zmin",      "xmin_zmax",      "xmax_zmin",      "xmax_zmax",      "ymin_zmin",
      "ymin_zmax",      "ymax_zmin",      "ymax_zmax",      "xmin_ymin_zmin", "xmin_ymin_zmax",
      "xmin_ymax_zmin", "xmin_ymax_zmax", "xmax_ymin_zmin", "xmax_ymin_zmax", "xmax_ymax_zmin",
      "xmax_ymax_zmax"};
  EXPECT_EQ(names, wanted);
}

// In a lattice of 5 x 4 x 3 cells a place has as many nodes as the axes that it leaves free.
TEST(NodesOfBoxes, LieOnTheirSides) {
  const HexMesh mesh = lattice({5, 4, 3});
  const NodesOfBox nodes(mesh);
  constexpr std::array<std::size_t, 3> kCount{6, 5, 4};
  for (const BoxPlace& place : box_places()) {
    std::size_t wanted = 1;
    for (std::size_t d = 0; d < 3; ++d) wanted *= place[d] == 0 ? kCount[d] : 1;
    const std::vector<LocalId> found = nodes.at_place(place);
    EXPECT_EQ(found.size(), wanted) << place_name(place);
    for (const LocalId n : found)
      for (std::size_t d = 0; d < 3; ++d)
        if (place[d] != 0)
          EXPECT_EQ(mesh.position[at(n)][d], place[d] < 0 ? 0 : static_cast<double>(kCount[d] - 1));
  }
}

// In a periodic mesh the nodes of opposite places are partners, in the same order, to the last bit.
TEST(NodesOfBoxes, ArePartnersWhereTheMeshIsPeriodic) {
  for (const std::array<bool, 3>& axes :
       {std::array{true, true, true}, std::array{true, false, true}, std::array{false, true, false}}) {
    HexMesh mesh = run_stages(Comm::self(), periodic(grains({6, 7, 5}, 8, 3, 4), axes)).mesh;
    const NodesOfBox nodes(mesh);
    std::set<LocalId> in_domain;
    for (LocalId h = 0; h < mesh.size(); ++h)
      if (mesh.image_of(h) == Image{0, 0, 0})
        in_domain.insert(mesh.hexes[at(h)].begin(), mesh.hexes[at(h)].end());
    const auto at_place = [&](const BoxPlace& place) {
      std::vector<LocalId> found;
      for (const LocalId n : nodes.at_place(place))
        if (in_domain.contains(n)) found.push_back(n);
      return found;
    };
    for (const BoxPlace& place : box_places()) {
      const std::vector<LocalId> low = at_place(place);
      EXPECT_GT(low.size(), 0U) << place_name(place);
      for (std::size_t d = 0; d < 3; ++d) {
        if (place[d] >= 0 || !axes[d]) continue;
        BoxPlace opposite = place;
        opposite[d] = 1;
        const std::vector<LocalId> high = at_place(opposite);
        ASSERT_EQ(high.size(), low.size()) << place_name(place);
        for (std::size_t i = 0; i < low.size(); ++i) {
          Vec3 p = mesh.position[at(low[i])];
          p[d] += mesh.period[d];
          ASSERT_EQ(p, mesh.position[at(high[i])]) << place_name(place);
        }
      }
    }
  }
}

}  // namespace
}  // namespace sculpt::test
