#include "sculpt/mesh/adjacency.hpp"

#include <algorithm>

namespace sculpt {

NodeHexes::NodeHexes(const HexMesh& mesh)
    : offset_(mesh.position.size() + 2, 0), items_(mesh.hexes.size() * 8) {
  // One place further on while they are counted: then the offset after a node is where its next item goes.
  for (const Hex& hex : mesh.hexes)
    for (const LocalId n : hex) ++offset_[at(n) + 2];
  for (std::size_t n = 1; n < offset_.size(); ++n) offset_[n] += offset_[n - 1];
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h)
    for (std::size_t c = 0; c < 8; ++c)
      items_[static_cast<std::size_t>(offset_[at(mesh.hexes[h][c]) + 1]++)] =
          static_cast<std::int32_t>(8 * h + c);
  offset_.pop_back();
}

std::size_t NodeHexes::largest() const {
  std::int64_t most = 0;
  for (std::size_t n = 1; n < offset_.size(); ++n) most = std::max(most, offset_[n] - offset_[n - 1]);
  return static_cast<std::size_t>(most);
}

int face_with_nodes(const Hex& hex, const std::array<LocalId, 4>& nodes) {
  for (std::size_t f = 0; f < 6; ++f) {
    bool same = true;
    for (const int c : kFaces[f])
      same = same && std::find(nodes.begin(), nodes.end(), hex[static_cast<std::size_t>(c)]) != nodes.end();
    if (same) return static_cast<int>(f);
  }
  return -1;
}

FaceNeighbours face_neighbours(const HexMesh& mesh) {
  const auto [nx, ny, nz] = mesh.lattice;
  if (nx == 0) return face_neighbours_of_any(mesh);
  FaceNeighbours all(mesh.hexes.size());
  LocalId h = 0;
  for (LocalId k = 0; k < nz; ++k)
    for (LocalId j = 0; j < ny; ++j)
      for (LocalId i = 0; i < nx; ++i, ++h)
        all[static_cast<std::size_t>(h)] = {j > 0 ? h - nx : kNone,      i + 1 < nx ? h + 1 : kNone,
                                            j + 1 < ny ? h + nx : kNone, i > 0 ? h - 1 : kNone,
                                            k > 0 ? h - nx * ny : kNone, k + 1 < nz ? h + nx * ny : kNone};
  return all;
}

namespace {

// A face that waits for its neighbour is a link of a list, kept in its own place of the result: -2 - the next
// face of the list (8 * hex + face), or kNone at the end. Faces are listed at the smallest of their nodes.
constexpr std::int32_t kLinks = -2;

// The corner of the face with the smallest node (index into kFaces).
std::size_t least_corner(const Hex& hex, std::size_t face) {
  const auto& c = kFaces[face];
  const auto node = [&](std::size_t v) { return hex[static_cast<std::size_t>(c[v])]; };
  const std::size_t a = node(1) < node(0) ? 1 : 0, b = node(3) < node(2) ? 3 : 2;
  return node(b) < node(a) ? b : a;
}

// The four nodes of a face around its smallest: the smallest, its two neighbours ascending, the opposite one.
std::array<LocalId, 4> face_key(const Hex& hex, std::size_t face) {
  const std::size_t v = least_corner(hex, face);
  const auto node = [&](std::size_t turn) {
    return hex[static_cast<std::size_t>(kFaces[face][(v + turn) % 4])];
  };
  return {node(0), std::min(node(1), node(3)), std::max(node(1), node(3)), node(2)};
}

// Takes the face with this key out of the list of waiting ones that begins at `link`: 8 * hex + face, or
// kNone.
std::int32_t take_waiting(const HexMesh& mesh, FaceNeighbours& all, std::int32_t* link,
                          const std::array<LocalId, 4>& key) {
  while (*link != kNone) {
    const std::int32_t face = kLinks - *link;
    std::int32_t& next = all[at(face / 8)][static_cast<std::size_t>(face % 8)];
    if (face_key(mesh.hexes[at(face / 8)], static_cast<std::size_t>(face % 8)) == key) {
      *link = next;
      return face;
    }
    link = &next;
  }
  return kNone;
}

}  // namespace

FaceNeighbours face_neighbours_of_any(const HexMesh& mesh) {
  FaceNeighbours all(mesh.hexes.size());
  std::vector<std::int32_t> first(mesh.position.size(),
                                  kNone);  // link to the first face that waits at a node
  for (LocalId h = 0; h < mesh.size(); ++h)
    for (std::size_t f = 0; f < 6; ++f) {
      const std::array<LocalId, 4> key = face_key(mesh.hexes[at(h)], f);
      const std::int32_t face = take_waiting(mesh, all, &first[at(key[0])], key);
      if (face == kNone) {
        all[at(h)][f] = first[at(key[0])];
        first[at(key[0])] = kLinks - (8 * h + static_cast<LocalId>(f));
      } else {
        all[at(h)][f] = face / 8;
        all[at(face / 8)][static_cast<std::size_t>(face % 8)] = h;
      }
    }
  for (auto& faces : all)
    for (LocalId& other : faces) other = std::max(other, kNone);  // those that still wait have none
  return all;
}

}  // namespace sculpt
