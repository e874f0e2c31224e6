#include "sculpt/write/node_sets.hpp"

#include <algorithm>
#include <cstdlib>

namespace sculpt {
namespace {

std::uint32_t copy_bit(const BoxPlace& copy) {
  return std::uint32_t{1} << static_cast<unsigned>(13 + copy[0] + 3 * copy[1] + 9 * copy[2]);
}

}  // namespace

NodeSet gathered(const HexMesh& mesh, const NodeSetMembers& members) {
  std::vector<std::uint8_t> in_set(mesh.position.size(), 0);
  for (const GlobalId id : members.node) {
    const auto found = std::lower_bound(mesh.node_id.begin(), mesh.node_id.end(), id);
    if (found != mesh.node_id.end() && *found == id)
      in_set[static_cast<std::size_t>(found - mesh.node_id.begin())] = 1;
  }
  mesh.node_exchange.reduce_to_owners(std::span<std::uint8_t>(in_set), [](std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>(a | b);
  });
  mesh.node_exchange.copy_to_ghosts(in_set);
  NodeSet set{members.id, {}};
  for (LocalId n = 0; n < mesh.nodes(); ++n)
    if (in_set[at(n)]) set.node.push_back(n);
  return set;
}

std::vector<BoxPlace> box_places() {
  std::vector<BoxPlace> places;
  for (const int axes : {1, 2, 3})
    for (unsigned used = 1; used < 8; ++used) {
      // Axes in the order x, y, z and xy, xz, yz.
      const BoxPlace on{static_cast<int>(used & 1), static_cast<int>(used >> 1 & 1),
                        static_cast<int>(used >> 2 & 1)};
      if (on[0] + on[1] + on[2] != axes) continue;
      for (int i = -on[0]; i <= on[0]; i += 2)
        for (int j = -on[1]; j <= on[1]; j += 2)
          for (int k = -on[2]; k <= on[2]; k += 2) places.push_back({i, j, k});
    }
  return places;
}

std::string place_name(const BoxPlace& place) {
  std::string name;
  for (std::size_t d = 0; d < 3; ++d) {
    if (place[d] == 0) continue;
    if (!name.empty()) name += '_';
    name += "xyz"[d];
    name += place[d] < 0 ? "min" : "max";
  }
  return name;
}

NodesOfBox::NodesOfBox(const HexMesh& mesh) : mesh_(mesh) {
  check(mesh.exterior.empty(), "node sets of a box on a mesh that has none");
  if (mesh.hex_image.empty()) return;
  copies_.assign(mesh.position.size(), 0);
  for (LocalId h = 0; h < mesh.size(); ++h) {
    const Image& image = mesh.hex_image[at(h)];
    if (std::any_of(image.begin(), image.end(), [](int periods) { return std::abs(periods) > 1; })) continue;
    for (const LocalId n : mesh.hexes[at(h)]) copies_[at(n)] |= copy_bit({image[0], image[1], image[2]});
  }
}

bool NodesOfBox::is_at(LocalId node, const BoxPlace& place) const {
  unsigned periodic = 0;  // axes of the place
  for (std::size_t d = 0; d < 3; ++d) {
    if (place[d] == 0) continue;
    if (mesh_.period[d] != 0)
      periodic |= 1U << d;
    else if ((mesh_.box_sides[at(node)] >> (2 * d + (place[d] > 0 ? 1 : 0)) & 1) == 0)
      return false;
  }
  if (periodic == 0) return true;
  for (unsigned part = 0; part < 8; ++part) {
    if ((part & ~periodic) != 0) continue;
    BoxPlace copy{0, 0, 0};
    for (std::size_t d = 0; d < 3; ++d)
      if ((part >> d & 1) != 0) copy[d] = place[d];
    if ((copies_[at(node)] & copy_bit(copy)) == 0) return false;
  }
  return true;
}

std::vector<LocalId> NodesOfBox::at_place(const BoxPlace& place) const {
  std::vector<LocalId> nodes;
  for (LocalId n = 0; n < mesh_.nodes(); ++n)
    if (is_at(n, place)) nodes.push_back(n);
  return nodes;
}

}  // namespace sculpt
