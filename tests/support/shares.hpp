#pragma once
// Made-up unstructured meshes and ways to spread them over the ranks.
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "sculpt/grid/grid.hpp"
#include "sculpt/mesh/element_share.hpp"
#include "sculpt/par/comm.hpp"

namespace sculpt::test {

// A whole mesh, the same on every rank.
struct WholeMesh {
  std::string name;
  std::vector<Vec3> position;
  std::vector<std::array<GlobalId, 8>> corner;
  std::vector<std::int32_t> block;  // per element
  std::vector<double> value;        // two of each element
};

// The cells and nodes of a grid in its own order.
[[nodiscard]] WholeMesh whole_grid(const Grid& grid);
// The same mesh with elements and nodes in another order and, if asked for, the corners of its elements
// turned.
[[nodiscard]] WholeMesh permuted(const WholeMesh& mesh, std::uint64_t seed, bool turned = false);
// A cylinder around the z axis. Its cross-section is five triangles around the axis, each of three kites of
// n x n quads: five hexes meet at the axis, three at the middle of each triangle.
[[nodiscard]] WholeMesh cylinder(int n, int layers);
// Appends the other mesh as it is.
void append(WholeMesh& mesh, const WholeMesh& other);

// What this rank has when elements and nodes are spread at random; some nodes are on two ranks. Some ranks
// may have nothing.
[[nodiscard]] ElementShare dealt(const Comm& comm, const WholeMesh& mesh, std::uint64_t seed);
// Elements in equal pieces of their order, as a file is read; likewise the nodes.
[[nodiscard]] ElementShare in_pieces(const Comm& comm, const WholeMesh& mesh);

}  // namespace sculpt::test
