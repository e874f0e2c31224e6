#include "sculpt/write/boundary_faces.hpp"

#include <algorithm>
#include <bit>
#include <tuple>

#include "sculpt/brep/brep.hpp"
#include "sculpt/mesh/edge_walk.hpp"

namespace sculpt {
namespace {

constexpr double kTolerance = 1e-3;  // of a cell

bool inside(const Box& box, const Vec3& p) {
  return box.lo.x <= p.x && p.x <= box.hi.x && box.lo.y <= p.y && p.y <= box.hi.y && box.lo.z <= p.z &&
         p.z <= box.hi.z;
}

// Pairs of blocks before blocks alone.
bool pair_before(const BlockPair& a, const BlockPair& b) {
  return std::tuple(a.second == BlockPair::kNothing, a) < std::tuple(b.second == BlockPair::kNothing, b);
}
void sort_once(std::vector<BlockPair>& pairs) {
  std::sort(pairs.begin(), pairs.end(), pair_before);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

}  // namespace

std::vector<BoundaryFace> boundary_faces(const HexMesh& mesh, const FaceNeighbours& neighbours) {
  std::vector<BoundaryFace> out;
  for (LocalId h = 0; h < mesh.size(); ++h)
    for (int f = 0; f < 6 && side_towards(mesh.image_of(h)) < 0; ++f) {
      const LocalId other = neighbours[at(h)][static_cast<std::size_t>(f)];
      if (other == kNone) {
        const std::uint8_t sides = face_sides(mesh, h, f);
        out.push_back({h, f, sides == 0 ? -1 : std::countr_zero(sides)});
      } else if (const int side = side_towards(mesh.image_of(other)); side >= 0) {
        out.push_back({h, f, side});
      }
    }
  return out;
}

Box widened(const std::array<double, 6>& ends, const Vec3& cell_size) {
  Box box;
  for (std::size_t d = 0; d < 3; ++d) {
    box.lo[d] = ends[d] - kTolerance * cell_size[d];
    box.hi[d] = ends[d + 3] + kTolerance * cell_size[d];
  }
  return box;
}

std::vector<SideFace> faces_in(const HexMesh& mesh, std::span<const BoundaryFace> boundary, const Box& box,
                               std::int64_t set) {
  std::vector<SideFace> out;
  for (const BoundaryFace& f : boundary) {
    if (mesh.layer[at(f.hex)] != 0) continue;
    const auto nodes = face_nodes(mesh, {f.hex, f.face});
    if (std::all_of(nodes.begin(), nodes.end(), [&](LocalId n) { return inside(box, mesh.position[at(n)]); }))
      out.push_back({set, f.hex, f.face});
  }
  return out;
}

std::vector<LocalId> nodes_in(const HexMesh& mesh, std::span<const BoundaryFace> boundary, const Box& box) {
  std::vector<std::uint8_t> own(mesh.position.size(), 0);
  for (LocalId h = 0; h < mesh.size(); ++h)
    if (mesh.layer[at(h)] == 0)
      for (const LocalId n : mesh.hexes[at(h)]) own[at(n)] = 1;
  std::vector<LocalId> out;
  for (const BoundaryFace& f : boundary)
    for (const LocalId n : face_nodes(mesh, {f.hex, f.face}))
      if (own[at(n)] && inside(box, mesh.position[at(n)])) out.push_back(n);
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

Contacts find_contacts(const Comm& comm, const HexMesh& mesh, const FaceNeighbours& neighbours,
                       std::span<const BoundaryFace> boundary) {
  Contacts contacts;
  std::vector<BlockPair> pair_of;  // per face
  const auto add = [&](LocalId hex, int face, std::int32_t other) {
    const std::int32_t mine = mesh.material[at(hex)];
    contacts.faces.push_back({0, hex, face});
    pair_of.push_back({std::min(mine, other), std::max(mine, other)});
  };
  for (LocalId h = 0; h < mesh.size(); ++h)
    for (int f = 0; f < 6 && mesh.layer[at(h)] == 0; ++f) {
      const LocalId other = neighbours[at(h)][static_cast<std::size_t>(f)];
      if (other != kNone && side_towards(mesh.image_of(other)) < 0 &&
          mesh.material[at(other)] < mesh.material[at(h)])
        add(h, f, mesh.material[at(other)]);
    }
  for (const BoundaryFace& f : boundary)
    if (f.side < 0 && mesh.layer[at(f.hex)] == 0) add(f.hex, f.face, BlockPair::kNothing);
  std::vector<BlockPair> mine = pair_of;
  sort_once(mine);
  contacts.pairs = comm.concatenate(mine);
  sort_once(contacts.pairs);
  for (std::size_t i = 0; i < pair_of.size(); ++i)
    contacts.faces[i].set =
        std::lower_bound(contacts.pairs.begin(), contacts.pairs.end(), pair_of[i], pair_before) -
        contacts.pairs.begin();
  return contacts;
}

}  // namespace sculpt
