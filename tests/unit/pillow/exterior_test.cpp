// Pillows of meshes with an exterior: they stay on it, and it follows them.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "sculpt/brep/exterior.hpp"
#include "sculpt/mesh/edge_walk.hpp"
#include "sculpt/pillow/pillow.hpp"
#include "support/input_meshes.hpp"
#include "support/mesh_checks.hpp"

namespace sculpt::test {
namespace {

InputMeshCase case_of(WholeMesh mesh, std::uint64_t seed) {
  InputMeshCase input;
  input.name = mesh.name + ", seed " + std::to_string(seed);
  input.mesh = std::move(mesh);
  input.seed = seed;
  input.grains = 4;
  input.pure = true;
  return input;
}
std::vector<InputMeshCase> all_cases() {
  std::vector<InputMeshCase> cases;
  for (const std::uint64_t seed : {1U, 2U, 6U, 11U}) {
    cases.push_back(case_of(generated("cylinder", {"--n", "4", "--layers", "5"}), seed));
    cases.push_back(
        case_of(generated("sphere-in-cube", {"--n", "3", "--inside", "2", "--outside", "2"}), seed));
    cases.push_back(case_of(generated("nested", {"--n", "1"}), seed));
    cases.push_back(cases.back());
    cases.back().keep = {0, 3};
    cases.back().name += ", blocks kept";
  }
  return cases;
}

struct Cells {
  HexMesh mesh;
  FaceNeighbours neighbours;
};
Cells cells_of(const InputMeshCase& input) {
  Overlay o = input_overlay(Comm::self(), input);
  Cells cells{std::move(o.cells), {}};
  cells.neighbours = face_neighbours(cells.mesh);
  (void)filter_materials(cells.mesh, o.fractions, cells.neighbours, NodeHexes(cells.mesh));
  keep_whole(Comm::self(), cells.mesh.exterior, cells.mesh, trace_interfaces(cells.mesh, cells.neighbours));
  return cells;
}
Pillowed pillowed(const Cells& cells) {
  return pillow(Comm::self(), cells.mesh, cells.neighbours, cells.mesh.material, {},
                {.offset = 0.3, .with_neighbours = true});
}

// Faces per facet; the facets that must not be cut have one.
void expect_facets(const HexMesh& before, const HexMesh& after, const std::string& name) {
  std::vector<int> parts(after.exterior.facets.size(), 0);
  for (const ExteriorFace& f : after.exterior.faces) ++parts[at(f.facet)];
  ASSERT_EQ(before.exterior.faces.size(), after.exterior.facets.size());
  for (std::size_t f = 0; f < parts.size(); ++f) {
    EXPECT_GE(parts[f], 1) << name;
    if (after.exterior.facets[f].whole != 0) EXPECT_EQ(parts[f], 1) << name;
  }
  for (const ExteriorFace& f : after.exterior.faces) {
    const Facet& facet = after.exterior.facets[at(f.facet)];
    if (facet.whole == 0) continue;
    for (const LocalId n : face_nodes(after, {f.hex, f.face}))
      EXPECT_TRUE(std::find(facet.corner.begin(), facet.corner.end(), after.position[at(n)]) !=
                  facet.corner.end())
          << name;
  }
}

TEST(PillowOnAnExterior, IsConformingAndStaysOnIt) {
  for (const InputMeshCase& input : all_cases()) {
    const Cells cells = cells_of(input);
    const Pillowed p = pillowed(cells);
    EXPECT_EQ(conformity_problem(p.mesh), "") << input.name;
    EXPECT_EQ(p.neighbours, face_neighbours(p.mesh)) << input.name;
    EXPECT_EQ(exterior_problem(p.mesh, 1e-12), "") << input.name;
    EXPECT_NEAR(volume(p.mesh) / volume(cells.mesh), 1, 1e-12) << input.name;
    expect_facets(cells.mesh, p.mesh, input.name);
    for (std::size_t n = 0; n < p.source.size(); ++n)
      if (!p.copied[n] && p.mesh.box_sides[n] == cells.mesh.box_sides[at(p.source[n])])
        EXPECT_EQ(p.mesh.position[n], cells.mesh.position[at(p.source[n])]) << "old nodes stay";
  }
}

// What an exterior node is on, its faces are on, and it is held.
TEST(PillowOnAnExterior, NodesKnowTheirSurfaces) {
  for (const InputMeshCase& input : all_cases()) {
    const HexMesh mesh = pillowed(cells_of(input)).mesh;
    std::vector<std::map<std::int32_t, int>> on(mesh.position.size());
    for (const ExteriorFace& f : mesh.exterior.faces)
      for (const LocalId n : face_nodes(mesh, {f.hex, f.face}))
        on[at(n)][mesh.exterior.facets[at(f.facet)].surface] = 1;
    for (LocalId n = 0; n < mesh.nodes(); ++n) {
      EXPECT_EQ(on[at(n)].empty(), mesh.exterior.hold_of[at(n)] == kNone) << input.name;
      EXPECT_EQ(on[at(n)].empty(), mesh.box_sides[at(n)] == 0) << input.name;
      if (on[at(n)].size() < 2) continue;
      const LocalId hold = mesh.exterior.hold_of[at(n)];
      EXPECT_NE(static_cast<int>(mesh.exterior.holds[at(hold)].kind), static_cast<int>(Hold::Kind::kSurface))
          << input.name << ": a node on several surfaces keeps to their edge, node " << mesh.node_id[at(n)];
    }
  }
}

TEST(PillowOnAnExterior, LayersGoOnEveryFace) {
  for (const InputMeshCase& input : all_cases()) {
    const Pillowed first = pillowed(cells_of(input));
    const std::vector<std::int32_t> everywhere(first.mesh.hexes.size(), 0);
    const Pillowed p = pillow(Comm::self(), first.mesh, first.neighbours, everywhere, {},
                              {.offset = 1, .along_edges = true, .box_sides = 0x3f, .with_neighbours = true});
    EXPECT_EQ(p.mesh.hexes.size(), first.mesh.hexes.size() + first.mesh.exterior.faces.size()) << input.name;
    EXPECT_EQ(p.mesh.exterior.faces.size(), first.mesh.exterior.faces.size()) << input.name;
    EXPECT_EQ(conformity_problem(p.mesh, 2, 1), "") << input.name;
    EXPECT_EQ(p.neighbours, face_neighbours(p.mesh)) << input.name;
    EXPECT_EQ(exterior_problem(p.mesh, 1e-12), "") << input.name;
    EXPECT_NEAR(volume(p.mesh) / volume(first.mesh), 1, 1e-12) << input.name;
  }
}

// Two blocks meet in a face that ends at an edge of the cube with one hex on either side: no copy could keep
// to the edge, so the surfaces there stay whole and get layers of their own.
TEST(PillowOnAnExterior, AnInterfaceAlongAnEdgeOfTheDomain) {
  WholeMesh mesh = generated("sphere-in-cube", {"--n", "3", "--inside", "1", "--outside", "1"});
  InputCells full = input_cells(Comm::self(), mesh);
  Cells cells{std::move(full.cells), {}};
  cells.neighbours = face_neighbours(cells.mesh);
  find_exterior(Comm::self(), cells.mesh, cells.neighbours, {}, {});
  for (std::size_t c = 0; c < cells.mesh.hexes.size(); ++c) cells.mesh.material[c] = full.block[c] == 2;
  keep_whole(Comm::self(), cells.mesh.exterior, cells.mesh, trace_interfaces(cells.mesh, cells.neighbours));
  const HexMesh after = pillowed(cells).mesh;
  EXPECT_EQ(conformity_problem(after), "");
  EXPECT_EQ(exterior_problem(after, 1e-12), "");
  EXPECT_NEAR(volume(after), 8, 1e-12);
  expect_facets(cells.mesh, after, mesh.name);
  EXPECT_GT(least_scaled_jacobian(after), 0);
}

}  // namespace
}  // namespace sculpt::test
