// The boundary representation and the side sets are the same whoever owns which cells.
#include "sculpt/brep/brep.hpp"

#include <gtest/gtest.h>

#include <map>
#include <tuple>

#include "sculpt/deck/deck.hpp"
#include "sculpt/par/components.hpp"
#include "sculpt/write/side_sets.hpp"
#include "support/cases.hpp"
#include "support/stages.hpp"

namespace sculpt::test {
namespace {

struct Traced {
  HexMesh cells;
  FaceNeighbours neighbours;
  Interfaces faces;
  Brep brep;
  BoxFaces box;
};

Traced traced(const Comm& comm, Overlay overlay) {
  Traced t;
  t.cells = std::move(overlay.cells);
  t.neighbours = face_neighbours(t.cells);
  t.faces = trace_interfaces(t.cells, t.neighbours);
  t.brep = build_brep(comm, t.cells, t.neighbours, t.faces);
  t.box = trace_box_faces(comm, t.cells, t.neighbours, t.brep.volume);
  return t;
}

void expect_same(const Traced& alone, const Traced& together) {
  EXPECT_EQ(together.brep.volumes, alone.brep.volumes);
  EXPECT_EQ(together.brep.surfaces, alone.brep.surfaces);
  EXPECT_EQ(together.brep.curves, alone.brep.curves);
  EXPECT_EQ(together.brep.vertices, alone.brep.vertices);
  EXPECT_EQ(together.box.surfaces, alone.box.surfaces);
  // Alone, the local index of a cell is its id.
  std::map<std::pair<GlobalId, int>, std::int32_t> surface, box;
  for (std::size_t q = 0; q < alone.faces.quads.size(); ++q)
    surface[{alone.faces.quads[q].cell[0], alone.faces.quads[q].face}] = alone.brep.surface[q];
  for (std::size_t f = 0; f < alone.box.faces.size(); ++f)
    box[{alone.box.faces[f].cell, alone.box.faces[f].face}] = alone.box.surface[f];
  int wrong = 0;
  for (std::size_t c = 0; c < together.cells.hexes.size(); ++c)
    wrong += together.brep.volume[c] != alone.brep.volume[static_cast<std::size_t>(together.cells.hex_id[c])];
  EXPECT_EQ(wrong, 0) << "volumes";
  for (std::size_t q = 0; q < together.faces.quads.size(); ++q) {
    const InterfaceQuad& quad = together.faces.quads[q];
    wrong += together.brep.surface[q] != surface.at({together.cells.hex_id[at(quad.cell[0])], quad.face});
  }
  EXPECT_EQ(wrong, 0) << "surfaces";
  for (std::size_t f = 0; f < together.box.faces.size(); ++f)
    wrong += together.box.surface[f] !=
             box.at({together.cells.hex_id[at(together.box.faces[f].cell)], together.box.faces[f].face});
  EXPECT_EQ(wrong, 0) << "box surfaces";
}

// A channel of material 1 that runs to and fro: many entries into every rank.
Case serpent() {
  return voxels("serpent", {15, 33, 3}, 2, [](const Index3& c) {
    if (c[2] != 1) return 0;
    if (c[1] % 2 == 0) return 1;
    return c[0] == (c[1] % 4 == 1 ? 14 : 0) ? 1 : 0;
  });
}
// A torus of square section: one closed surface; cut by the box in two closed curves when `open`.
Case tube() {
  return voxels("tube", {12, 12, 9}, 2, [](const Index3& c) {
    const auto inside = [](std::int64_t x, std::int64_t margin) { return x >= margin && x < 12 - margin; };
    const bool outer = inside(c[0], 1) && inside(c[1], 1), inner = inside(c[0], 4) && inside(c[1], 4);
    return outer && !inner ? 1 : 0;
  });
}

TEST(Brep, IsTheSameAloneAndTogether) {
  for (const Case& input :
       {serpent(), tube(), grains({14, 13, 12}, 40, 5, 2), noise({11, 9, 10}, 2, 4), noise({8, 8, 8}, 4, 9)})
    for (const int layers : {2, 3}) {
      SCOPED_TRACE(input.name + " with " + std::to_string(layers) + " ghost layers");
      expect_same(traced(Comm::self(), overlay(Comm::self(), input)),
                  traced(Comm::world(), overlay(Comm::world(), input, layers)));
    }
}

TEST(Brep, OfASerpentIsOneVolume) {
  const Traced t = traced(Comm::world(), overlay(Comm::world(), serpent()));
  EXPECT_EQ(t.brep.volumes, 2);
  EXPECT_EQ(t.brep.surfaces, 1);
}

TEST(Brep, OfATubeHasFourClosedCurves) {
  const Traced t = traced(Comm::world(), overlay(Comm::world(), tube()));
  EXPECT_EQ(t.brep.volumes, 3);
  EXPECT_EQ(t.brep.surfaces, 2);
  EXPECT_EQ(t.brep.curves, 4);
  EXPECT_EQ(t.brep.vertices, 0);
}

TEST(Brep, WorksWithMoreRanksThanCells) {
  const Case input = voxels({2, 1, 1}, {0, 1});
  const Traced t = traced(Comm::world(), overlay(Comm::world(), input));
  EXPECT_EQ(t.brep.volumes, 2);
  EXPECT_EQ(t.brep.surfaces, 1);
  EXPECT_EQ(t.brep.curves, 4);
  EXPECT_EQ(t.brep.vertices, 4);
  EXPECT_EQ(t.box.surfaces, 10);
}

// A block around the corner of the domain, in eight parts, is one volume with one closed surface.
TEST(Brep, GoesThroughPeriodicSides) {
  const Case block = periodic(voxels("block", {6, 5, 4}, 2, [](const Index3& c) {
    return static_cast<std::int32_t>((c[0] + 1) % 6 < 2 && (c[1] + 1) % 5 < 2 && (c[2] + 1) % 4 < 2);
  }));
  const Traced one = traced(Comm::world(), overlay(Comm::world(), block));
  EXPECT_EQ(one.brep.volumes, 2);
  EXPECT_EQ(one.brep.surfaces, 1);
  EXPECT_EQ(one.brep.curves, 0);
  EXPECT_EQ(one.brep.vertices, 0);
  EXPECT_EQ(one.box.surfaces, 6 + 6 * 4) << "the sides of the files, where they cut the volumes";
  // Layers without an end, and bars of which three meet along closed curves.
  const Case layers = periodic(
      voxels("layers", {6, 4, 3}, 2, [](const Index3& c) { return static_cast<std::int32_t>(c[0] < 3); }));
  const Traced two = traced(Comm::world(), overlay(Comm::world(), layers));
  EXPECT_EQ(two.brep.volumes, 2);
  EXPECT_EQ(two.brep.surfaces, 2);
  EXPECT_EQ(two.brep.curves, 0);
  const Case bars = periodic(voxels("bars", {6, 4, 3}, 3, [](const Index3& c) {
    return static_cast<std::int32_t>(c[0] < 3 ? 0 : 1 + c[1] / 2);
  }));
  const Traced three = traced(Comm::world(), overlay(Comm::world(), bars));
  EXPECT_EQ(three.brep.volumes, 3);
  EXPECT_EQ(three.brep.surfaces, 6);
  EXPECT_EQ(three.brep.curves, 4);
  EXPECT_EQ(three.brep.vertices, 0);
}

// Entities 0..n-1 in a row, dealt out to the ranks in turn; a join is known to one rank only, which has one
// end as a ghost.
TEST(Components, FollowJoinsThatOneRankKnows) {
  const Comm comm = Comm::world();
  const GlobalId n = 40, cut = 17;
  std::vector<GlobalId> ids;
  std::vector<std::int32_t> owner;
  const auto owner_of = [&](GlobalId id) { return static_cast<std::int32_t>(id % comm.size()); };
  for (GlobalId id = 0; id < n; ++id)
    if (owner_of(id) == comm.rank() || (id > 0 && owner_of(id - 1) == comm.rank())) {
      ids.push_back(id);
      owner.push_back(owner_of(id));
    }
  DisjointSets sets(ids.size());
  for (std::size_t i = 0; i + 1 < ids.size(); ++i)
    if (ids[i + 1] == ids[i] + 1 && owner[i] == comm.rank() && ids[i + 1] != cut)
      sets.join(static_cast<LocalId>(i), static_cast<LocalId>(i + 1));
  Components parts = connected_components(comm, std::move(sets), ids, GhostExchange(comm, ids, owner));
  for (std::size_t i = 0; i < ids.size(); ++i)
    EXPECT_EQ(parts.label[at(parts.of[i])], ids[i] < cut ? 0 : cut);
  // The group goes before the label.
  std::vector<std::int32_t> group;
  for (const GlobalId label : parts.label) group.push_back(label == 0 ? 7 : 3);
  EXPECT_EQ(number_components(comm, parts, ids, group), 2);
  for (std::size_t i = 0; i < ids.size(); ++i) EXPECT_EQ(parts.of[i], ids[i] < cut ? 1 : 0);
}

using Listed = std::tuple<std::int64_t, GlobalId, int>;

std::vector<Listed> side_sets(const Comm& comm, const Case& input, const LayerPlan& layers, int gen_sidesets,
                              std::int32_t left_out) {
  const Traced t = traced(comm, filtered(comm, input, layers.ghost_layers()));
  std::vector<std::uint8_t> drop(t.cells.hexes.size(), 0);
  for (std::size_t c = 0; c < drop.size(); ++c) drop[c] = t.cells.material[c] == left_out;
  const SidePlan plan =
      plan_side_sets(comm, t.cells, t.neighbours, t.faces, t.brep, drop, {gen_sidesets, input.grid.cells});
  LayeredMesh layered = add_layers(comm, t.cells, t.neighbours, drop, t.faces,
                                   deviation_weights(t.cells, t.faces), layers, Log());
  if (layers.curves) add_curve_layers(comm, layered, layers, {}, Log());
  const HexMesh& mesh = layered.mesh;
  std::vector<std::array<std::int64_t, 3>> own;
  for (const SideFace& f : side_faces(plan, mesh, layered.pillows)) {
    EXPECT_EQ(mesh.layer[at(f.hex)], 0);
    own.push_back({f.set, mesh.hex_id[at(f.hex)], f.face});
  }
  own = comm.concatenate(own);
  std::sort(own.begin(), own.end());
  std::vector<Listed> all;
  for (const auto& [set, hex, face] : own) all.emplace_back(set, hex, static_cast<int>(face));
  return all;
}

TEST(SideSets, AreTheSameAloneAndTogether) {
  const Case input = grains({12, 11, 10}, 25, 4, 6);
  LayerPlan none, surfaces, curves, boundary, all;
  surfaces.surfaces = all.surfaces = curves.curves = all.curves = true;
  curves.curve_threshold = all.curve_threshold = 0.2;
  curves.curve_layers = all.curve_layers = 1;
  boundary.boundary_layers = all.boundary_layers = 1;
  for (const LayerPlan& layers : {none, surfaces, curves, boundary, all})
    for (const int gen_sidesets : {kSidesetsFixed, kSidesetsVariable, kSidesetsRveVariable})
      for (const std::int32_t left_out : {-1, 0}) {
        SCOPED_TRACE("ghost layers " + std::to_string(layers.ghost_layers()) + ", gen_sidesets " +
                     std::to_string(gen_sidesets));
        const auto alone = side_sets(Comm::self(), input, layers, gen_sidesets, left_out);
        EXPECT_FALSE(alone.empty());
        EXPECT_TRUE(side_sets(Comm::world(), input, layers, gen_sidesets, left_out) == alone);
      }
}

}  // namespace
}  // namespace sculpt::test
