// Sets by places and blocks, statistics of side sets and regions of the void are the same for any number of
// ranks.
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "pipeline/void_regions.hpp"
#include "sculpt/write/boundary_faces.hpp"
#include "sculpt/write/node_sets.hpp"
#include "sculpt/write/side_set_stats.hpp"
#include "support/stages.hpp"

namespace sculpt::test {
namespace {

using Entry = std::array<GlobalId, 3>;

struct Sets {
  std::vector<Entry> faces, nodes;  // (set, hex, face), (set, node, 0), of all ranks, ascending
  std::vector<BlockPair> pairs;
  std::vector<std::array<double, 5>> stats;
  std::vector<std::int64_t> blocks;
  bool operator==(const Sets&) const = default;
};

std::vector<Entry> of_all_ranks(const Comm& comm, const std::vector<Entry>& mine) {
  std::vector<Entry> all = comm.concatenate(mine);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

Sets sets_of(const Comm& comm, const Case& input, std::int32_t left_out) {
  StageOptions options;
  options.void_material = left_out;
  HexMesh mesh = run_stages(comm, input, options).mesh;
  Sets sets;
  MaterialTable materials{{1, 2, 3, 4}, {}};
  (void)separate_void(comm, mesh, materials, 1);
  sets.blocks = materials.block_id;
  const FaceNeighbours neighbours = face_neighbours_of_any(mesh);
  const auto boundary = boundary_faces(mesh, neighbours);
  const Contacts contacts = find_contacts(comm, mesh, neighbours, boundary);
  sets.pairs = contacts.pairs;
  std::vector<SideFace> faces = contacts.faces;
  const auto boxed = static_cast<std::int64_t>(contacts.pairs.size());
  const Box box = widened({0, 0, 0, 4, 9, 3}, mesh.cell_size);
  for (const SideFace& f : faces_in(mesh, boundary, box, boxed)) faces.push_back(f);
  std::vector<Entry> mine;
  for (const SideFace& f : faces) mine.push_back({f.set, mesh.hex_id[at(f.hex)], f.face});
  EXPECT_EQ(static_cast<std::size_t>(comm.sum(static_cast<std::int64_t>(mine.size()))),
            of_all_ranks(comm, mine).size())
      << "a face is listed twice";
  sets.faces = of_all_ranks(comm, mine);

  // Every rank lists all the nodes of a set that its hexes use.
  std::vector<std::uint8_t> own(mesh.position.size(), 0);
  for (LocalId h = 0; h < mesh.size(); ++h)
    if (mesh.layer[at(h)] == 0)
      for (const LocalId n : mesh.hexes[at(h)]) own[at(n)] = 1;
  std::vector<Entry> members;
  std::vector<GlobalId> lists;  // ids of this rank's nodes
  const NodesOfBox places(mesh);
  std::int64_t set = 0;
  const auto add = [&](const std::vector<LocalId>& nodes) {
    for (const LocalId n : nodes)
      if (own[at(n)]) members.push_back({set, mesh.node_id[at(n)], 0});
    ++set;
  };
  for (const BoxPlace& place : box_places()) add(places.at_place(place));
  add(nodes_in(mesh, boundary, box));
  sets.nodes = of_all_ranks(comm, members);
  for (LocalId n = 0; n < mesh.nodes(); ++n)
    if (own[at(n)]) lists.push_back(mesh.node_id[at(n)]);
  std::size_t wanted = 0;
  for (const Entry& e : sets.nodes) wanted += std::binary_search(lists.begin(), lists.end(), e[1]);
  EXPECT_EQ(members.size(), wanted);

  std::vector<std::int64_t> ids;
  for (std::int64_t i = 0; i <= boxed; ++i) ids.push_back(i);
  for (const SideSetStats& s : side_set_stats(comm, mesh, ids, faces))
    sets.stats.push_back({s.area, s.least, s.mean, s.most, s.bounds.hi.x});
  return sets;
}

TEST(MeshSets, AreTheSameAloneAndTogether) {
  // Two rooms of material 1 that do not touch, in a box of the three others.
  const Case input = voxels("rooms", {9, 8, 7}, 4, [](const Index3& c) {
    const auto within = [&](const Index3& lo, const Index3& hi) {
      for (std::size_t d = 0; d < 3; ++d)
        if (c[d] < lo[d] || c[d] > hi[d]) return false;
      return true;
    };
    if (within({1, 1, 1}, {2, 3, 2}) || within({5, 4, 3}, {7, 6, 5})) return 1;
    return c[0] < 4 ? (c[1] < 4 ? 0 : 2) : (c[2] < 3 ? 3 : 0);
  });
  for (const bool is_periodic : {false, true})
    for (const std::int32_t left_out : {-1, 0}) {
      const Case with = is_periodic ? periodic(input) : input;
      const Sets alone = sets_of(Comm::self(), with, left_out),
                 together = sets_of(Comm::world(), with, left_out);
      EXPECT_GT(alone.blocks.size(), 4U) << "one region of the void only";
      EXPECT_GT(alone.nodes.size(), 200U);
      EXPECT_EQ(together.blocks, alone.blocks);
      EXPECT_TRUE(together.pairs == alone.pairs);
      EXPECT_TRUE(together.faces == alone.faces);
      EXPECT_TRUE(together.nodes == alone.nodes);
      EXPECT_TRUE(together.stats == alone.stats);
    }
}

}  // namespace
}  // namespace sculpt::test
