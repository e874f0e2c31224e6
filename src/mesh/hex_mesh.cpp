#include "sculpt/mesh/hex_mesh.hpp"

#include <cmath>

namespace sculpt {
namespace {

// node_of(i): the node that position[i] belongs to.
template <class NodeOf>
void share(const HexMesh& mesh, const GhostExchange& exchange, std::vector<Vec3>& position,
           const NodeOf& node_of) {
  const bool periodic = !mesh.node_image.empty();
  const auto owned = [&](std::size_t i) { return mesh.node_owner[at(node_of(i))] == exchange.comm().rank(); };
  for (std::size_t i = 0; periodic && i < position.size(); ++i)
    if (owned(i)) round_to_quantum(mesh, position[i]);
  exchange.copy_to_ghosts(position);
  for (std::size_t i = 0; periodic && i < position.size(); ++i)
    if (!owned(i)) position[i] = position_of_ghost(mesh, node_of(i), position[i]);
}

}  // namespace

std::uint8_t face_sides(const HexMesh& mesh, LocalId hex, int face) {
  std::uint8_t sides = 0xff;
  for (const int c : kFaces[static_cast<std::size_t>(face)])
    sides &= mesh.box_sides[at(mesh.hexes[at(hex)][static_cast<std::size_t>(c)])];
  return sides;
}

Freedom freedom(const HexMesh& mesh, LocalId node, const Vec3& p) {
  if (mesh.exterior.empty()) return {mesh.box_sides[at(node)], 3, {}};
  const LocalId hold = mesh.exterior.hold_of[at(node)];
  if (hold == kNone) return {};
  switch (mesh.exterior.holds[at(hold)].kind) {
    case Hold::Kind::kSurface:
      return {0, 2, mesh.exterior.direction(hold, p)};
    case Hold::Kind::kLine:
      return {0, 1, mesh.exterior.direction(hold, p)};
    case Hold::Kind::kPoint:
      break;
  }
  return {0, 0, {}};
}

void connect_ranks(const Comm& comm, HexMesh& mesh) {
  mesh.node_exchange = GhostExchange(comm, mesh.node_id, mesh.node_owner, mesh.node_home);
  mesh.hex_exchange = GhostExchange(comm, mesh.hex_id, mesh.hex_owner, mesh.hex_home);
}

void round_to_quantum(const HexMesh& mesh, Vec3& position) {
  for (std::size_t d = 0; d < 3; ++d)
    if (mesh.quantum[d] > 0) position[d] = std::nearbyint(position[d] / mesh.quantum[d]) * mesh.quantum[d];
}

Vec3 position_of_ghost(const HexMesh& mesh, LocalId node, const Vec3& home) {
  if (mesh.node_image.empty()) return home;
  Vec3 position = home, period = mesh.period;
  round_to_quantum(mesh, period);
  const Image& image = mesh.node_image[at(node)];
  for (std::size_t d = 0; d < 3; ++d)
    if (image[d] != 0) position[d] += image[d] * period[d];
  return position;
}

void share_positions(const HexMesh& mesh, const GhostExchange& exchange, std::span<const LocalId> nodes,
                     std::vector<Vec3>& position) {
  share(mesh, exchange, position, [nodes](std::size_t i) { return nodes[i]; });
}

void share_positions(HexMesh& mesh) {
  share(mesh, mesh.node_exchange, mesh.position, [](std::size_t n) { return static_cast<LocalId>(n); });
}

}  // namespace sculpt
