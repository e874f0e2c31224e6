#include "support/faulty_meshes.hpp"

#include <algorithm>

#include "sculpt/distribute/conformity.hpp"

namespace sculpt::test {
namespace {

WholeMesh unit_grid(const Index3& cells, const Vec3& origin = {0, 0, 0}, double size = 1) {
  return whole_grid(uniform_grid(cells, origin, {size, size, size}));
}
WholeMesh named(const std::string& name, WholeMesh mesh) {
  mesh.name = name;
  mesh.block.assign(mesh.corner.size(), 0);
  mesh.block.back() = 1;
  mesh.value.assign(2 * mesh.corner.size(), 0);
  return mesh;
}
// Makes b node a, wherever it is used.
void merge(WholeMesh& mesh, GlobalId a, GlobalId b) {
  for (auto& corner : mesh.corner) std::replace(corner.begin(), corner.end(), b, a);
}

}  // namespace

std::vector<WholeMesh> conforming_meshes() {
  std::vector<WholeMesh> meshes{unit_grid({1, 1, 1}), permuted(unit_grid({4, 3, 5}), 2),
                                permuted(cylinder(3, 3), 4)};
  meshes.push_back(unit_grid({2, 2, 2}));
  append(meshes.back(), unit_grid({2, 2, 2}, {2.001, 0, 0}, 0.3));  // near, but apart
  meshes.back().name = "two grids";
  Grid graded = uniform_grid({19, 2, 2}, {0, 0, 0}, {1, 1e-3, 1e-3});  // sizes from 1 to 2^-18 side by side
  double size = 1;
  for (std::size_t i = 1; i < graded.planes[0].size(); ++i, size /= 2)
    graded.planes[0][i] = graded.planes[0][i - 1] + size;
  meshes.push_back(whole_grid(graded));
  meshes.back().name = "graded";
  WholeMesh two = unit_grid({1, 1, 1});  // two hexes that share an edge only
  append(two, unit_grid({1, 1, 1}, {1, 1, 0}));
  merge(two, 3, 8);
  merge(two, 7, 12);
  meshes.push_back(named("an edge", two));
  return meshes;
}

std::vector<FaultyMesh> faulty_meshes() {
  std::vector<FaultyMesh> all;
  const auto add = [&all](const std::string& name, const WholeMesh& mesh, const std::string& message) {
    all.push_back({named(name, mesh), message});
  };
  WholeMesh mesh = unit_grid({3, 2, 2});
  mesh.corner[7][2] = mesh.corner[7][0];
  add("a node twice", mesh,
      "element 8 (block 10) uses node 14 at (1, 0, 1) twice; expected eight different nodes");

  mesh = unit_grid({3, 1, 1});
  mesh.corner.push_back({1, 16, 17, 5, 9, 18, 19, 13});
  mesh.position.insert(mesh.position.end(), {{1.9, 0.2, 0}, {1.9, 1.2, 0}, {1.9, 0.2, 1}, {1.9, 1.2, 1}});
  add("a face of three", mesh,
      "elements 1 (block 10), 2 (block 10) and 4 (block 20) share the face of nodes 2, 6, 10, 14 around (1, "
      "0.5, 0.5); expected two elements at most");

  mesh = unit_grid({3, 2, 2});
  std::swap_ranges(mesh.corner[7].begin(), mesh.corner[7].begin() + 4, mesh.corner[7].begin() + 4);
  add("inside out", mesh,
      "elements 2 (block 10) and 8 (block 10) lie on the same side of the face of nodes 14, 15, 18, 19 "
      "around "
      "(1.5, 0.5, 1): they overlap, or one of them is inside out");

  mesh = unit_grid({2, 1, 1});
  std::swap(mesh.corner[1][3], mesh.corner[1][7]);
  add("twisted", mesh,
      "elements 1 (block 10) and 2 (block 20) run through the face of nodes 2, 5, 8, 11 around (1, 0.5, 0.5) "
      "in different orders: one of them is twisted");

  mesh = unit_grid({2, 2, 2});
  append(mesh, unit_grid({2, 2, 2}, {2, 0, 0}));
  add("not merged", mesh, "nodes 3 and 28 lie at the same place (2, 0, 0) but are two nodes; merge them");

  for (Vec3& p : mesh.position)
    if (p.x > 2) p.x += 1e-7;
  for (std::size_t n = 27; n < 54; ++n)
    if (mesh.position[n].x == 2) mesh.position[n].x += 1e-7;
  add("hardly apart", mesh,
      "nodes 3 and 28 lie at nearly the same place (2, 0, 0) but are two nodes; merge them");

  mesh = unit_grid({2, 2, 2});
  append(mesh, unit_grid({1, 1, 1}, {2, 0, 0}, 2));
  for (const auto& [a, b] : std::vector<std::pair<GlobalId, GlobalId>>{{2, 27}, {8, 29}, {20, 31}, {26, 33}})
    merge(mesh, a, b);
  for (const std::size_t n : {27U, 29U, 31U, 33U}) mesh.position[n].x = -7;  // unused now
  add("hanging", mesh,
      "node 6 at (2, 1, 0) lies in a face or on an edge of element 9 (block 20) but is no node of that face "
      "(a "
      "hanging node); the faces of neighbours must have the same four nodes");

  mesh = unit_grid({1, 1, 1});
  append(mesh, unit_grid({1, 1, 1}, {1, 0.25, 0.25}, 0.5));
  add("a small cell on a large one", mesh,
      "node 9 at (1, 0.25, 0.25) lies in a face or on an edge of element 1 (block 10) but is no node of that "
      "face (a hanging node); the faces of neighbours must have the same four nodes");

  mesh = unit_grid({2, 1, 1});
  mesh.corner[1][7] = 12;
  mesh.position.push_back({1.05, 1.05, 1.05});
  add("three nodes of a face", mesh,
      "elements 1 (block 10) and 2 (block 20) share opposite corners of a face, nodes 5 and 8 at (1, 1, 0), "
      "but "
      "not the whole face; the faces of neighbours must have the same four nodes");
  return all;
}

std::string conformity_message(const Comm& comm, const ElementShare& share) {
  try {
    check_conformity(comm, share, {10, 20, 30});
  } catch (const AgreedError& error) {
    return error.what();
  }
  return {};
}

}  // namespace sculpt::test
