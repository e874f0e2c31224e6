// Sets by places and blocks, on meshes small enough to count.
#include "sculpt/write/boundary_faces.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "support/stages.hpp"

namespace sculpt::test {
namespace {

// 4 x 3 x 2 cells of size 1; material 1 where x > 2.
HexMesh two_halves() {
  HexMesh mesh = lattice({4, 3, 2});
  for (LocalId h = 0; h < mesh.size(); ++h) mesh.material[at(h)] = mesh.corners(h)[0].x >= 2;
  return mesh;
}

std::vector<BoundaryFace> boundary_of(const HexMesh& mesh) {
  return boundary_faces(mesh, face_neighbours(mesh));
}

TEST(BoundaryFaces, AreThoseOnTheSidesOfABox) {
  const HexMesh mesh = two_halves();
  std::map<int, int> count;
  for (const BoundaryFace& f : boundary_of(mesh)) {
    ++count[f.side];
    EXPECT_EQ(face_sides(mesh, f.hex, f.face), 1 << f.side);
  }
  EXPECT_EQ(count, (std::map<int, int>{{0, 6}, {1, 6}, {2, 8}, {3, 8}, {4, 12}, {5, 12}}));
}

TEST(BoundaryFaces, AFlatBoxCatchesASide) {
  const HexMesh mesh = two_halves();
  const auto boundary = boundary_of(mesh);
  const auto count = [&](const std::array<double, 6>& ends) {
    const Box box = widened(ends, mesh.cell_size);
    return std::pair(faces_in(mesh, boundary, box, 7).size(), nodes_in(mesh, boundary, box).size());
  };
  using Count = std::pair<std::size_t, std::size_t>;
  EXPECT_EQ(count({0, 0, 0, 0, 3, 2}), (Count{6, 12}));
  EXPECT_EQ(count({0.0005, -9, -9, 0.0005, 9, 9}), (Count{6, 12})) << "within a thousandth of a cell";
  EXPECT_EQ(count({0.002, -9, -9, 0.5, 9, 9}), (Count{0, 0}));
  EXPECT_EQ(count({0, 0, 0, 1, 1, 2}), (Count{2 + 2 + 1 + 1, 2 * 2 * 3 - 1})) << "at an edge of the box";
  EXPECT_EQ(count({1, 1, 1, 3, 2, 1}), (Count{0, 0})) << "inside the mesh";
  EXPECT_EQ(count({0, 0, 0, 0, 0, 0}), (Count{0, 1}));
  EXPECT_EQ(count({-1, -1, -1, 9, 9, 9}), (Count{52, 5 * 4 * 3 - 3 * 2 * 1}));
  for (const SideFace& f : faces_in(mesh, boundary, widened({0, 0, 0, 0, 3, 2}, mesh.cell_size), 7))
    EXPECT_EQ(f.set, 7);
}

// Grains of a lattice: every pair has the faces that its cells have in common.
TEST(Contacts, CoverEveryFaceBetweenBlocksOnce) {
  const Overlay o = overlay(grains({7, 6, 5}, 9, 4, 2));
  const FaceNeighbours neighbours = face_neighbours(o.cells);
  const Contacts contacts =
      find_contacts(Comm::self(), o.cells, neighbours, boundary_faces(o.cells, neighbours));
  std::map<BlockPair, std::size_t> wanted, found;
  for (LocalId h = 0; h < o.cells.size(); ++h)
    for (const LocalId other : neighbours[at(h)])
      if (other != kNone && o.cells.material[at(other)] < o.cells.material[at(h)])
        ++wanted[{o.cells.material[at(other)], o.cells.material[at(h)]}];
  std::set<std::pair<LocalId, int>> once;
  for (const SideFace& f : contacts.faces) {
    ++found[contacts.pairs[static_cast<std::size_t>(f.set)]];
    EXPECT_TRUE(once.insert({f.hex, f.face}).second);
  }
  EXPECT_GT(wanted.size(), 4U);
  EXPECT_TRUE(found == wanted);
  EXPECT_TRUE(std::is_sorted(contacts.pairs.begin(), contacts.pairs.end()));
}

// What is left out of the mesh is no block; pairs of two blocks come first.
TEST(Contacts, TellTheSurfacesTowardsWhatIsNotMeshed) {
  StageOptions options;
  options.void_material = 0;
  const Case bars = voxels("bars", {6, 5, 5}, 3, [](const Index3& c) {
    return c[1] != 2 || c[2] != 2 ? 0 : c[0] < 3 ? 1 : 2;
  });
  const HexMesh mesh = run_stages(Comm::self(), bars, options).mesh;
  const FaceNeighbours neighbours = face_neighbours(mesh);
  const auto boundary = boundary_faces(mesh, neighbours);
  const Contacts contacts = find_contacts(Comm::self(), mesh, neighbours, boundary);
  EXPECT_EQ(contacts.pairs,
            (std::vector<BlockPair>{{1, 2}, {1, BlockPair::kNothing}, {2, BlockPair::kNothing}}));
  std::array<std::size_t, 3> count{};
  for (const SideFace& f : contacts.faces) ++count[static_cast<std::size_t>(f.set)];
  EXPECT_EQ(count, (std::array<std::size_t, 3>{1, 12, 12}));
  std::size_t on_box = 0;
  for (const BoundaryFace& f : boundary) on_box += f.side >= 0;
  EXPECT_EQ(boundary.size(), on_box + 24);
}

}  // namespace
}  // namespace sculpt::test
