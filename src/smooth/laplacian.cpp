#include "smooth/laplacian.hpp"

#include <limits>

namespace sculpt {
namespace {

constexpr double kFar = 2;  // in the shortest edges at a node of the overlay mesh

// Marks the nodes of all hexes that have a marked node.
void mark_layer(const HexMesh& mesh, const std::vector<std::uint8_t>& from, std::vector<std::uint8_t>& to) {
  for (const Hex& hex : mesh.hexes) {
    bool touches = false;
    for (const LocalId n : hex) touches = touches || from[at(n)] != 0;
    if (!touches) continue;
    for (const LocalId n : hex) to[at(n)] = 1;
  }
  mesh.node_exchange.copy_to_ghosts(to);  // the owner sees all hexes of a node
}

// Owned volume nodes in hexes with an interface node and in the hexes around those, ascending.
std::vector<LocalId> nodes_near_interfaces(const HexMesh& mesh, const Geometry& geometry) {
  std::vector<std::uint8_t> interface(mesh.position.size(), 0), beside(mesh.position.size(), 0),
      near(mesh.position.size(), 0);
  for (std::size_t n = 0; n < interface.size(); ++n) interface[n] = geometry.index[n] != kNone;
  mark_layer(mesh, interface, beside);
  mark_layer(mesh, beside, near);
  std::vector<LocalId> chosen;
  for (LocalId n = 0; n < mesh.nodes(); ++n)
    if (near[at(n)] && !interface[at(n)] && mesh.node_owner[at(n)] == mesh.node_exchange.comm().rank())
      chosen.push_back(n);
  return chosen;
}

}  // namespace

Vec3 towards_neighbours(const HexMesh& mesh, const NodeHexes& around, LocalId node) {
  const std::uint8_t sides = mesh.box_sides[at(node)];
  const Vec3& here = mesh.position[at(node)];
  // Hexes of an input mesh may be much longer than wide: there far neighbours count less.
  const double far = mesh.exterior.empty() ? std::numeric_limits<double>::infinity()
                                           : kFar * mesh.unit(node) * mesh.cell_size.x;
  Vec3 sum;
  double count = 0;
  for (const std::int32_t item : around[node])
    for (const int c : kCornerNeighbours[static_cast<std::size_t>(item % 8)]) {
      const LocalId other = mesh.hexes[at(item / 8)][static_cast<std::size_t>(c)];
      if ((mesh.box_sides[at(other)] & sides) != sides) continue;
      const double length = norm(mesh.position[at(other)] - here), weight = length > far ? far / length : 1;
      sum += weight * mesh.position[at(other)];
      count += weight;
    }
  if (!(count > 0)) return {};
  return held(mesh, node, here, (1.0 / count) * sum - here);
}

void laplacian_passes(HexMesh& mesh, const NodeHexes& around, const Geometry& geometry, int passes,
                      const Log& log) {
  const std::vector<LocalId> nodes = nodes_near_interfaces(mesh, geometry);
  std::vector<Vec3> moves(nodes.size());
  for (int pass = 1; pass <= passes; ++pass) {
    log.line("Laplacian Iter: {}", pass);
    for (std::size_t i = 0; i < nodes.size(); ++i) moves[i] = towards_neighbours(mesh, around, nodes[i]);
    for (std::size_t i = 0; i < nodes.size(); ++i) mesh.position[at(nodes[i])] += moves[i];
    share_positions(mesh);
  }
}

}  // namespace sculpt
