// Side sets of final meshes: against a mesh that real Sculpt wrote, and against the faces of the final mesh
// itself.
#include "sculpt/write/side_sets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "pipeline/layers.hpp"
#include "sculpt/deck/deck.hpp"
#include "support/cases.hpp"
#include "support/stages.hpp"

namespace sculpt::test {
namespace {

struct Made {
  HexMesh mesh;
  std::vector<SideFace> faces;
};

enum class Hexes { kStair, kPillowed, kPillowedTwice, kBoundaryLayers, kCurveLayers, kAllLayers };
constexpr std::array kAllHexes{Hexes::kStair,          Hexes::kPillowed,    Hexes::kPillowedTwice,
                               Hexes::kBoundaryLayers, Hexes::kCurveLayers, Hexes::kAllLayers};

LayerPlan plan_of(Hexes kind) {
  LayerPlan p;
  p.surfaces = kind == Hexes::kPillowedTwice || kind == Hexes::kAllLayers;
  p.curves = kind == Hexes::kCurveLayers || kind == Hexes::kAllLayers;
  p.curve_layers = 1;
  p.curve_threshold = kind == Hexes::kCurveLayers ? 0.35 : 0.1;
  p.boundary_layers = kind == Hexes::kBoundaryLayers ? 1 : kind == Hexes::kAllLayers ? 2 : 0;
  return p;
}

// The mesh with its side sets; `left_out` is a material that is not meshed; is_lattice: the cells know that
// they are one.
Made made(const Case& input, Hexes kind, int gen_sidesets, std::int32_t left_out = -1,
          bool is_lattice = true) {
  const Comm comm = Comm::self();
  const LayerPlan layers = plan_of(kind);
  HexMesh cells = filtered(comm, input, layers.ghost_layers()).cells;
  if (!is_lattice) cells = turned(std::move(cells));
  const FaceNeighbours neighbours = face_neighbours(cells);
  const Interfaces faces = trace_interfaces(cells, neighbours);
  const Brep brep = build_brep(comm, cells, neighbours, faces);
  std::vector<std::uint8_t> drop(cells.hexes.size(), 0);
  for (std::size_t c = 0; c < drop.size(); ++c) drop[c] = cells.material[c] == left_out;
  const SidePlan plan = plan_side_sets(comm, cells, neighbours, faces, brep, drop,
                                       {gen_sidesets, is_lattice ? input.grid.cells : Index3{0, 0, 0}});
  if (kind == Hexes::kStair) {
    const std::vector<std::int32_t> none(cells.hexes.size(), -1);
    HexMesh mesh = pillow(comm, cells, neighbours, none, drop, {}).mesh;
    std::vector<SideFace> side = side_faces(plan, mesh, 1);
    return {std::move(mesh), std::move(side)};
  }
  LayeredMesh m =
      add_layers(comm, cells, neighbours, drop, faces, deviation_weights(cells, faces), layers, Log());
  const int before = m.pillows;
  if (layers.curves) {
    add_curve_layers(comm, m, layers, {}, Log());
    EXPECT_EQ(m.pillows, before + 1) << "a layer around curves";
  }
  std::vector<SideFace> side = side_faces(plan, m.mesh, m.pillows);
  return {std::move(m.mesh), std::move(side)};
}

std::vector<std::int64_t> sizes(const std::vector<SideFace>& faces) {
  std::map<std::int64_t, std::int64_t> count;
  for (const SideFace& f : faces) ++count[f.set];
  std::vector<std::int64_t> out;
  for (const auto& [set, n] : count) {
    EXPECT_EQ(set, static_cast<std::int64_t>(out.size()) + 1);  // ids without gaps
    out.push_back(n);
  }
  return out;
}

Case letter_f() {
  return voxels("letter F", {3, 5, 4}, 2, [](const Index3& c) {
    return c[0] == 0 || c[1] == 0 || c[2] == 0 || (c[0] == 1 && c[1] == 2) ? 1 : 0;
  });
}

// The ten sets of the mesh that Sculpt 16.14 made of the letter F with `stair = 1`, `gen_sidesets =
// variable`: 1 xmin of material 1, 2 interface, 3 xmax of 1, 4 xmax of 0, 5 ymin of 1, 6 ymax of 1, 7 ymax of
// 0, 8 zmin of 1, 9 zmax of 1, 10 zmax of 0.
TEST(SideSets, VariableOfTheLetterFAreThoseOfSculpt) {
  const Made m = made(letter_f(), Hexes::kStair, kSidesetsVariable);
  EXPECT_EQ(sizes(m.faces), (std::vector<std::int64_t>{20, 31, 8, 12, 12, 6, 6, 15, 8, 7}));
  const std::vector<std::pair<std::uint8_t, std::int32_t>> side_and_material{
      {kXmin, 1}, {0, 1},     {kXmax, 1}, {kXmax, 0}, {kYmin, 1},
      {kYmax, 1}, {kYmax, 0}, {kZmin, 1}, {kZmax, 1}, {kZmax, 0}};
  for (const SideFace& f : m.faces) {
    const auto& [side, material] = side_and_material[static_cast<std::size_t>(f.set) - 1];
    EXPECT_EQ(face_sides(m.mesh, f.hex, f.face), side) << "set " << f.set;
    EXPECT_EQ(m.mesh.material[at(f.hex)], material) << "set " << f.set;
  }
}

TEST(SideSets, AreTheSameFacesWhateverTheOrderOfCorners) {
  for (const Hexes kind : kAllHexes)
    for (const int sets : {kSidesetsFixed, kSidesetsVariable, kSidesetsRve}) {
      const Case input = grains({9, 8, 10}, 12, 4, 3);
      std::vector<std::int64_t> lattice = sizes(made(input, kind, sets, 2).faces),
                                any = sizes(made(input, kind, sets, 2, false).faces);
      if (sets == kSidesetsVariable) {  // in another order
        std::sort(lattice.begin(), lattice.end());
        std::sort(any.begin(), any.end());
      }
      EXPECT_EQ(any, lattice);
    }
}

TEST(SideSets, FixedOfTheLetterFAreBoundaryAndInterface) {
  const Made m = made(letter_f(), Hexes::kStair, kSidesetsFixed);
  std::map<std::int64_t, int> count;
  for (const SideFace& f : m.faces) ++count[f.set];
  EXPECT_EQ(count, (std::map<std::int64_t, int>{{1, 94}, {3, 31}}));
}

TEST(SideSets, FixedWithoutTheVoidHaveExteriorFaces) {
  const Made m = made(letter_f(), Hexes::kStair, kSidesetsFixed, 0);
  EXPECT_EQ(sizes(m.faces), (std::vector<std::int64_t>{20 + 8 + 12 + 6 + 15 + 8, 31}));
}

TEST(SideSets, RveAreTheSixSides) {
  EXPECT_EQ(sizes(made(letter_f(), Hexes::kStair, kSidesetsRve).faces),
            (std::vector<std::int64_t>{20, 20, 12, 12, 15, 15}));
}

// A refined cell may have two faces on one side, each of which plans the side of the cell.
TEST(SideSets, ListAFaceOfTheBoxOnce) {
  const HexMesh mesh = lattice({2, 2, 2});
  SidePlan plan;
  plan.box = {{0, 0, 5}, {2, 0, 5}, {0, 0, 5}};
  EXPECT_EQ(side_faces(plan, mesh, 0).size(), 2U);
}

// The sides, and the interface after them.
TEST(SideSets, RveVariableAreTheSidesAndTheSurfacesInside) {
  EXPECT_EQ(sizes(made(letter_f(), Hexes::kStair, kSidesetsRveVariable).faces),
            (std::vector<std::int64_t>{20, 20, 12, 12, 15, 15, 31}));
  EXPECT_EQ(sizes(made(letter_f(), Hexes::kStair, kSidesetsRveVariable, 0).faces),
            (std::vector<std::int64_t>{20, 8, 12, 6, 15, 8, 31}));
}

// Free surfaces are the sets of `variable` that are towards cells left out, in the same order.
TEST(SideSets, FreeSurfacesAreThoseOfVariable) {
  const Case input = grains({9, 8, 10}, 12, 4, 3);
  for (const Hexes kind : {Hexes::kStair, Hexes::kPillowed, Hexes::kAllLayers}) {
    const Made all = made(input, kind, kSidesetsVariable, 2), fixed = made(input, kind, kSidesetsFixed, 2),
               free = made(input, kind, kSidesetsInputMeshAndFreeSurfaces, 2);
    std::set<std::pair<LocalId, int>> exterior;
    for (const SideFace& f : fixed.faces)
      if (f.set == 2) exterior.insert({f.hex, f.face});
    std::map<std::int64_t, std::set<std::pair<LocalId, int>>> wanted, found;
    for (const SideFace& f : all.faces)
      if (exterior.contains({f.hex, f.face})) wanted[f.set].insert({f.hex, f.face});
    for (const SideFace& f : free.faces) found[f.set].insert({f.hex, f.face});
    ASSERT_EQ(found.size(), wanted.size());
    EXPECT_GT(found.size(), 3U);
    for (auto w = wanted.begin(), f = found.begin(); w != wanted.end(); ++w, ++f)
      EXPECT_TRUE(w->second == f->second) << "set " << f->first;
    EXPECT_EQ(found.begin()->first, 1);
    EXPECT_EQ(free.faces.size(), exterior.size());
  }
}

TEST(SideSets, OffAreNone) { EXPECT_TRUE(made(letter_f(), Hexes::kStair, kSidesetsOff).faces.empty()); }

// A ball in a shell in unmeshed space: the inner interface and the outer free surface. From low x the outer
// comes first.
TEST(SideSets, VariableOfConcentricBallsAreTwo) {
  const Case input = voxels("shells", {14, 14, 14}, 3, [](const Index3& c) {
    double r2 = 0;
    for (const auto x : c) r2 += (static_cast<double>(x) - 6.5) * (static_cast<double>(x) - 6.5);
    return r2 > 36 ? 0 : r2 > 9 ? 1 : 2;
  });
  const Made m = made(input, Hexes::kPillowed, kSidesetsVariable, 0);
  const auto n = sizes(m.faces);
  ASSERT_EQ(n.size(), 2u);
  EXPECT_GT(n[0], n[1]);
  for (const SideFace& f : m.faces)
    EXPECT_EQ(m.mesh.material[at(f.hex)], f.set);  // the shell's 1, the ball's 2
}

// Every face of the final mesh is where `fixed` has to have it.
std::string fixed_problem(const Made& m) {
  const FaceNeighbours neighbours = face_neighbours_of_any(m.mesh);
  std::map<std::pair<LocalId, int>, std::int64_t> listed;
  for (const SideFace& f : m.faces)
    if (!listed.try_emplace({f.hex, f.face}, f.set).second) return "a face is listed twice";
  std::size_t wanted = 0;
  for (LocalId h = 0; h < m.mesh.size(); ++h)
    for (int f = 0; f < 6; ++f) {
      const LocalId other = neighbours[at(h)][static_cast<std::size_t>(f)];
      std::int64_t set = 0;
      if (other == kNone)
        set = face_sides(m.mesh, h, f) != 0 ? 1 : 2;
      else if (m.mesh.material[at(other)] < m.mesh.material[at(h)])
        set = 3;
      if (set == 0) continue;
      ++wanted;
      const auto found = listed.find({h, f});
      if (found == listed.end()) return "a face of set " + std::to_string(set) + " is missing";
      if (found->second != set)
        return "a face of set " + std::to_string(set) + " is in set " + std::to_string(found->second);
    }
  return wanted == listed.size() ? "" : "faces that belong to no set are listed";
}

TEST(SideSets, FixedHoldExactlyTheBoundaryAndTheInterfacesOfTheMesh) {
  const Case input = grains({9, 8, 10}, 12, 4, 3);
  for (const Hexes kind : kAllHexes)
    for (const std::int32_t left_out : {-1, 0, 2}) {
      const Made m = made(input, kind, kSidesetsFixed, left_out);
      EXPECT_EQ(fixed_problem(m), "") << static_cast<int>(kind) << ' ' << left_out;
    }
}

// `variable` cuts the same faces into more sets: each on one side of the box or between one pair of
// materials.
TEST(SideSets, VariablePartTheFacesOfFixed) {
  const Case input = grains({9, 8, 10}, 12, 4, 3);
  for (const Hexes kind : kAllHexes) {
    const Made whole = made(input, kind, kSidesetsFixed, 2), parts = made(input, kind, kSidesetsVariable, 2);
    std::map<std::pair<LocalId, int>, std::int64_t> fixed;
    for (const SideFace& f : whole.faces) fixed[{f.hex, f.face}] = f.set;
    ASSERT_EQ(parts.faces.size(), whole.faces.size());
    std::map<std::int64_t, std::set<std::array<std::int64_t, 3>>> kinds;
    for (const SideFace& f : parts.faces) {
      ASSERT_TRUE(fixed.contains({f.hex, f.face}));
      kinds[f.set].insert(
          {fixed.at({f.hex, f.face}), face_sides(parts.mesh, f.hex, f.face), parts.mesh.material[at(f.hex)]});
    }
    EXPECT_GT(kinds.size(), 20u);
    for (const auto& [set, k] : kinds) EXPECT_EQ(k.size(), 1u) << "set " << set;
    (void)sizes(parts.faces);
  }
}

}  // namespace
}  // namespace sculpt::test
