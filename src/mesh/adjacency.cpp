#include "sculpt/mesh/adjacency.hpp"

#include <algorithm>

namespace sculpt {

NodeHexes::NodeHexes(const HexMesh& mesh)
    : offset_(mesh.position.size() + 1, 0), items_(mesh.hexes.size() * 8) {
  for (const Hex& hex : mesh.hexes)
    for (const LocalId n : hex) ++offset_[static_cast<std::size_t>(n) + 1];
  for (std::size_t n = 1; n < offset_.size(); ++n) offset_[n] += offset_[n - 1];
  std::vector<std::int64_t> at(offset_.begin(), offset_.end() - 1);
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h)
    for (std::size_t c = 0; c < 8; ++c)
      items_[static_cast<std::size_t>(at[static_cast<std::size_t>(mesh.hexes[h][c])]++)] =
          static_cast<std::int32_t>(8 * h + c);
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

FaceNeighbours face_neighbours_of_any(const HexMesh& mesh) {
  FaceNeighbours all(mesh.hexes.size());
  for (auto& faces : all) faces.fill(kNone);
  const NodeHexes around(mesh);
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h)
    for (std::size_t f = 0; f < 6; ++f) {
      if (all[h][f] != kNone) continue;
      std::array<LocalId, 4> nodes;
      for (std::size_t c = 0; c < 4; ++c) nodes[c] = mesh.hexes[h][static_cast<std::size_t>(kFaces[f][c])];
      for (const std::int32_t item : around[nodes[0]]) {
        const LocalId other = item / 8;
        if (other == static_cast<LocalId>(h)) continue;
        const int face = face_with_nodes(mesh.hexes[static_cast<std::size_t>(other)], nodes);
        if (face < 0) continue;
        all[h][f] = other;
        all[static_cast<std::size_t>(other)][static_cast<std::size_t>(face)] = static_cast<LocalId>(h);
        break;
      }
    }
  return all;
}

}  // namespace sculpt
