#include <fmt/core.h>

#include <algorithm>

#include "sculpt/geom/hex.hpp"
#include "sculpt/input/input_mesh.hpp"
#include "sculpt/mesh/node_directory.hpp"
#include "sculpt/par/finding.hpp"

namespace sculpt {
namespace {

std::vector<GlobalId> nodes_in_use(const ElementShare& share) {
  std::vector<GlobalId> nodes;
  nodes.reserve(8 * share.corner.size());
  for (const auto& corners : share.corner) nodes.insert(nodes.end(), corners.begin(), corners.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

double least_determinant(const HexCorners& p) {
  double least = corner_determinant(p, 0);
  for (int c = 1; c < 8; ++c) least = std::min(least, corner_determinant(p, c));
  return least;
}

Vec3 centre(const HexCorners& p) {
  Vec3 sum;
  for (const Vec3& corner : p) sum += corner;
  return 0.125 * sum;
}

std::vector<Vec3> find_positions(const Comm& comm, const ElementShare& share,
                                 const std::vector<GlobalId>& nodes, const std::string& path) {
  try {
    return positions_of(comm, share, nodes);
  } catch (const AgreedError& e) {
    throw AgreedError(fmt::format("'{}': {}", path, e.what()));
  }
}

}  // namespace

void check_hexes(const Comm& comm, const InputMesh& mesh, const std::string& path) {
  const ElementShare& share = mesh.share;
  const std::vector<GlobalId> nodes = nodes_in_use(share);
  const std::vector<Vec3> position = find_positions(comm, share, nodes, path);
  std::int64_t bad = 0;
  std::size_t first = 0;
  HexCorners of_first;
  for (std::size_t e = 0; e < share.element.size(); ++e) {
    HexCorners p;
    for (std::size_t c = 0; c < 8; ++c) {
      const auto at = std::lower_bound(nodes.begin(), nodes.end(), share.corner[e][c]);
      p[c] = position[static_cast<std::size_t>(at - nodes.begin())];
    }
    if (least_determinant(p) > 0) continue;
    if (bad++ > 0) continue;
    first = e;
    of_first = p;
  }
  const std::int64_t all = comm.sum(bad);
  Finding finding;
  if (bad > 0) {
    const Vec3 at = centre(of_first);
    finding = {
        share.element[first],
        fmt::format("'{}': {} inverted or degenerate hexes, the first: element {} of block {} at ({}, "
                    "{}, {}) has a corner with the determinant {}, expected more than 0 at all corners",
                    path, all, share.element[first] + 1,
                    mesh.blocks[static_cast<std::size_t>(share.block[first])].id, at.x, at.y, at.z,
                    least_determinant(of_first))};
  }
  refuse_first(comm, finding);
}

}  // namespace sculpt
