#include "sculpt/brep/brep.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "sculpt/par/components.hpp"

namespace sculpt {
namespace {

// Cells of a full lattice. A cell joins the run of its left neighbour without a search; towards the rows
// before it, it joins only where the two runs begin to touch.
DisjointSets join_lattice(const HexMesh& cells) {
  const auto [nx, ny, nz] = cells.lattice;
  const std::int32_t* const material = cells.material.data();
  DisjointSets sets(cells.hexes.size());
  LocalId c = 0;
  for (LocalId k = 0; k < nz; ++k)
    for (LocalId j = 0; j < ny; ++j)
      for (LocalId i = 0; i < nx; ++i, ++c) {
        const bool run = i > 0 && material[c - 1] == material[c];
        if (run) sets.attach(c, c - 1);
        for (const auto& [inside, step] : {std::pair{j > 0, nx}, std::pair{k > 0, nx * ny}}) {
          if (!inside || material[c - step] != material[c]) continue;
          if (!run || material[c - step - 1] != material[c]) sets.join(c, c - step);
        }
      }
  return sets;
}

DisjointSets join_any(const HexMesh& cells, const FaceNeighbours& neighbours) {
  DisjointSets sets(cells.hexes.size());
  for (LocalId c = 0; c < cells.size(); ++c)
    for (const LocalId other : neighbours[at(c)])
      if (other != kNone && other < c && cells.material[at(other)] == cells.material[at(c)])
        sets.join(c, other);
  return sets;
}

std::int64_t find_volumes(const Comm& comm, const HexMesh& cells, const FaceNeighbours& neighbours,
                          std::vector<std::int32_t>& volume) {
  Components parts =
      connected_components(comm, cells.lattice[0] > 0 ? join_lattice(cells) : join_any(cells, neighbours),
                           cells.hex_homes(), cells.hex_exchange);
  std::vector<std::int32_t> material;
  material.reserve(parts.first.size());
  for (const LocalId c : parts.first) material.push_back(cells.material[at(c)]);
  const std::int64_t count = number_components(comm, parts, cells.hex_homes(), material);
  volume = std::move(parts.of);
  return count;
}

// Interface nodes of quads with a cell that is owned or in the first ghost layer: there all quads are known
// and all classes right. All owned nodes are among them, and so are both ends of every edge of the quads of
// owned cells.
std::vector<std::uint8_t> settled_nodes(const HexMesh& cells, const Interfaces& faces) {
  std::vector<std::uint8_t> settled(faces.nodes.size(), 0);
  for (const InterfaceQuad& q : faces.quads)
    if (cells.layer[at(q.cell[0])] <= 1 || cells.layer[at(q.cell[1])] <= 1)
      for (const LocalId n : q.node) settled[at(faces.index_of[at(n)])] = 1;
  return settled;
}

// Joins the two quads of every edge that has exactly two, of one part.
DisjointSets join_quads(const Interfaces& faces, const std::vector<std::uint8_t>& settled) {
  DisjointSets sets(faces.quads.size());
  std::vector<std::pair<LocalId, LocalId>> ends;  // (other end of the edge, quad)
  for (std::size_t i = 0; i < faces.nodes.size(); ++i) {
    if (!settled[i]) continue;
    ends.clear();
    for (const LocalId item : faces.node_quads[i])
      for (const int turn : {1, 3}) {
        const LocalId end =
            faces.index_of[at(faces.quads[at(item / 4)].node[static_cast<std::size_t>((item + turn) % 4)])];
        if (end > static_cast<LocalId>(i) && settled[at(end)]) ends.emplace_back(end, item / 4);
      }
    std::sort(ends.begin(), ends.end());
    for (std::size_t e = 0; e < ends.size();) {
      std::size_t last = e;
      while (last < ends.size() && ends[last].first == ends[e].first) ++last;
      const auto one_part = [&](LocalId a, LocalId b) {
        return faces.part.empty() || faces.part[at(a)] == faces.part[at(b)];
      };
      if (last - e == 2 && one_part(ends[e].second, ends[e + 1].second))
        sets.join(ends[e].second, ends[e + 1].second);
      e = last;
    }
  }
  return sets;
}

std::int64_t find_surfaces(const Comm& comm, const HexMesh& cells, const Interfaces& faces,
                           const std::vector<std::uint8_t>& settled, std::vector<std::int32_t>& surface) {
  std::vector<GlobalId> ids, homes;
  std::vector<std::int32_t> owner;
  ids.reserve(faces.quads.size());
  homes.reserve(faces.quads.size());
  owner.reserve(faces.quads.size());
  for (const InterfaceQuad& q : faces.quads) {
    ids.push_back(8 * cells.hex_id[at(q.cell[0])] + q.face);
    homes.push_back(8 * cells.hex_homes()[at(q.cell[0])] + q.face);
    owner.push_back(cells.hex_owner[at(q.cell[0])]);
  }
  Components parts =
      connected_components(comm, join_quads(faces, settled), homes, GhostExchange(comm, ids, owner, homes));
  const std::int64_t count = number_components(comm, parts, homes);
  surface = std::move(parts.of);
  return count;
}

// Chains of kCurve nodes, and single edges between two vertices.
void count_curves(const Comm& comm, const HexMesh& cells, const Interfaces& faces,
                  const std::vector<std::uint8_t>& settled, Brep& brep) {
  std::vector<GlobalId> ids, homes;
  std::vector<std::int32_t> owner;
  DisjointSets sets(faces.nodes.size());
  std::int64_t vertices = 0, curves = 0;
  for (std::size_t i = 0; i < faces.nodes.size(); ++i) {
    ids.push_back(cells.node_id[at(faces.nodes[i])]);
    homes.push_back(cells.node_homes()[at(faces.nodes[i])]);
    owner.push_back(cells.node_owner[at(faces.nodes[i])]);
    if (!settled[i]) continue;
    const bool is_vertex = faces.kind[i] == NodeClass::kVertex, own = owner[i] == comm.rank();
    vertices += is_vertex && own;
    for (const LocalId end : faces.curve_neighbours[i]) {
      if (end < static_cast<LocalId>(i)) continue;
      if (is_vertex)
        curves += own && faces.kind[at(end)] == NodeClass::kVertex;
      else if (settled[at(end)] && faces.kind[at(end)] == NodeClass::kCurve)
        sets.join(static_cast<LocalId>(i), end);
    }
  }
  const Components chains =
      connected_components(comm, std::move(sets), homes, GhostExchange(comm, ids, owner, homes));
  for (std::size_t i = 0; i < ids.size(); ++i)  // each chain is counted at the node that gives it its label
    curves += owner[i] == comm.rank() && faces.kind[i] == NodeClass::kCurve &&
              chains.label[at(chains.of[i])] == ids[i];
  brep.vertices = comm.sum(vertices);
  brep.curves = comm.sum(curves);
}

}  // namespace

Brep build_brep(const Comm& comm, const HexMesh& cells, const FaceNeighbours& neighbours,
                const Interfaces& faces) {
  Brep brep;
  brep.volumes = find_volumes(comm, cells, neighbours, brep.volume);
  const std::vector<std::uint8_t> settled = settled_nodes(cells, faces);
  brep.surfaces = find_surfaces(comm, cells, faces, settled, brep.surface);
  count_curves(comm, cells, faces, settled, brep);
  return brep;
}

int side_towards(const Image& image) {
  for (std::size_t d = 0; d < 3; ++d)
    if (image[d] != 0) return static_cast<int>(2 * d) + (image[d] > 0 ? 1 : 0);
  return -1;
}

int side_of_box(const HexMesh& cells, const FaceNeighbours& neighbours, LocalId cell, int face) {
  if (!cells.exterior.empty()) {
    const LocalId facet = cells.exterior.facet_at(cell, face);
    return facet == kNone ? -1 : cells.exterior.facets[at(facet)].surface;
  }
  if (side_towards(cells.image_of(cell)) >= 0) return -1;
  const LocalId other = neighbours[at(cell)][static_cast<std::size_t>(face)];
  if (other != kNone) return side_towards(cells.image_of(other));
  const std::uint8_t sides = face_sides(cells, cell, face);
  return sides == 0 ? -1 : std::countr_zero(sides);
}

BoxFaces trace_box_faces(const Comm& comm, const HexMesh& cells, const FaceNeighbours& neighbours,
                         const std::vector<std::int32_t>& volume) {
  BoxFaces out;
  std::vector<GlobalId> ids;
  std::vector<std::int32_t> owner;
  for (LocalId c = 0; c < cells.size(); ++c)
    for (int f = 0; f < 6; ++f) {
      const int on_side = side_of_box(cells, neighbours, c, f);
      if (on_side < 0) continue;
      out.faces.push_back({c, f, on_side});
      ids.push_back(8 * cells.hex_id[at(c)] + f);
      owner.push_back(cells.hex_owner[at(c)]);
    }
  // Faces of one volume at one edge of one side: at most two, found next to each other.
  struct Edge {
    LocalId a, b;
    std::int32_t side, volume, face;
    auto operator<=>(const Edge&) const = default;
  };
  std::vector<Edge> edges;
  edges.reserve(4 * out.faces.size());
  for (std::size_t i = 0; i < out.faces.size(); ++i) {
    const auto& [cell, face, side] = out.faces[i];
    const auto& corner = kFaces[static_cast<std::size_t>(face)];
    for (std::size_t v = 0; v < 4; ++v) {
      const LocalId a = cells.hexes[at(cell)][static_cast<std::size_t>(corner[v])];
      const LocalId b = cells.hexes[at(cell)][static_cast<std::size_t>(corner[(v + 1) % 4])];
      edges.push_back({std::min(a, b), std::max(a, b), side, volume[at(cell)], static_cast<std::int32_t>(i)});
    }
  }
  std::sort(edges.begin(), edges.end());
  DisjointSets sets(out.faces.size());
  for (std::size_t e = 0; e + 1 < edges.size(); ++e) {
    const Edge &p = edges[e], &q = edges[e + 1];
    if (p.a == q.a && p.b == q.b && p.side == q.side && p.volume == q.volume) sets.join(p.face, q.face);
  }
  Components parts = connected_components(comm, std::move(sets), ids, GhostExchange(comm, ids, owner));
  out.surfaces = number_components(comm, parts, ids);
  out.surface = std::move(parts.of);
  return out;
}

}  // namespace sculpt
