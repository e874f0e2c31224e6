#include "filter/ring.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "sculpt/base/error.hpp"
#include "sculpt/mesh/edge_walk.hpp"

namespace sculpt {
namespace {

// Ring of a node inside a lattice: its cells ascend as x fastest, so they are the corners of a 2x2x2 block in
// order.
constexpr std::array<std::uint64_t, 8> kBlock = [] {
  std::array<std::uint64_t, 8> touching{};
  for (std::size_t c = 0; c < 8; ++c)
    for (const std::size_t axis : {1, 2, 4}) touching[c] |= std::uint64_t{1} << (c ^ axis);
  return touching;
}();

// The cells at an edge a-b of a face of the boundary, by their places in the ring; the last one in `last`.
std::uint64_t cells_at_edge(const HexMesh& mesh, const FaceNeighbours& neighbours, const Ring& ring,
                            HexFace face, LocalId a, LocalId b, LocalId& last) {
  std::uint64_t cells = 0;
  for (; face.hex != kNone; face = other_side(mesh, neighbours, across_edge(mesh, face, a, b))) {
    last = face.hex;
    for (int c = 0; c < ring.size; ++c)
      if (ring.cell[static_cast<std::size_t>(c)] == face.hex) cells |= std::uint64_t{1} << c;
  }
  return cells;
}

void find_edges(const HexMesh& mesh, const FaceNeighbours& neighbours, std::span<const std::int32_t> items,
                LocalId node, Ring& ring) {
  for (const std::int32_t item : items)
    for (const int f : kCornerFaces[static_cast<std::size_t>(item % 8)]) {
      const HexFace face{item / 8, f};
      if (neighbours[at(face.hex)][static_cast<std::size_t>(f)] != kNone) continue;
      const auto nodes = face_nodes(mesh, face);
      const auto v = static_cast<std::size_t>(std::find(nodes.begin(), nodes.end(), node) - nodes.begin());
      for (const std::size_t end : {(v + 1) % 4, (v + 3) % 4}) {
        LocalId last = kNone;
        const std::uint64_t cells = cells_at_edge(mesh, neighbours, ring, face, node, nodes[end], last);
        if (std::popcount(cells) < 3 || last < face.hex) continue;  // met from the other end
        if (ring.edges < Ring::kMost) ring.at_edge[static_cast<std::size_t>(ring.edges++)] = cells;
      }
    }
}

}  // namespace

Ring ring_of(const HexMesh& mesh, const FaceNeighbours& neighbours, const NodeHexes& around, LocalId node) {
  const auto items = around[node];
  if (items.size() > Ring::kMost)
    throw Error(fmt::format("node {} is shared by {} cells; at most {} are supported", mesh.node_id[at(node)],
                            items.size(), Ring::kMost));
  Ring ring;
  ring.size = static_cast<int>(items.size());
  for (std::size_t i = 0; i < items.size(); ++i) ring.cell[i] = items[i] / 8;
  if (mesh.lattice[0] != 0 && items.size() == 8) {
    std::copy(kBlock.begin(), kBlock.end(), ring.touching.begin());
    return ring;
  }
  std::fill_n(ring.touching.begin(), items.size(), 0);
  for (std::size_t i = 0; i < items.size(); ++i)
    for (const int f : kCornerFaces[static_cast<std::size_t>(items[i] % 8)]) {
      const LocalId other = neighbours[at(ring.cell[i])][static_cast<std::size_t>(f)];
      if (other <= ring.cell[i]) continue;  // none, or met from there
      for (std::size_t j = i + 1; j < items.size(); ++j)
        if (ring.cell[j] == other) {
          ring.touching[i] |= std::uint64_t{1} << j;
          ring.touching[j] |= std::uint64_t{1} << i;
        }
    }
  if (mesh.lattice[0] == 0) find_edges(mesh, neighbours, items, node, ring);
  return ring;
}

}  // namespace sculpt
