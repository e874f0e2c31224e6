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
  return ring;
}

}  // namespace sculpt
