#include "sculpt/brep/interfaces.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace sculpt {
namespace {

void find_quads(const HexMesh& mesh, const FaceNeighbours& neighbours, Interfaces& out) {
  for (LocalId c = 0; c < mesh.size(); ++c)
    for (int f = 0; f < 6; ++f) {
      const LocalId other = neighbours[at(c)][static_cast<std::size_t>(f)];
      if (other < c || mesh.material[at(other)] == mesh.material[at(c)])
        continue;  // kNone is below every cell
      InterfaceQuad q;
      for (std::size_t v = 0; v < 4; ++v)
        q.node[v] = mesh.hexes[at(c)][static_cast<std::size_t>(kFaces[static_cast<std::size_t>(f)][v])];
      q.cell = {c, other};
      q.face = f;
      out.quads.push_back(q);
    }
}

void number_nodes(const HexMesh& mesh, Interfaces& out) {
  out.index_of.assign(mesh.position.size(), kNone);
  for (const InterfaceQuad& q : out.quads)
    for (const LocalId n : q.node) out.index_of[at(n)] = 0;
  for (LocalId n = 0; n < mesh.nodes(); ++n)
    if (out.index_of[at(n)] == 0) {
      out.index_of[at(n)] = static_cast<LocalId>(out.nodes.size());
      out.nodes.push_back(n);
    }
}

void find_node_quads(Interfaces& out) {
  std::vector<std::int64_t> start(out.nodes.size() + 1, 0);
  for (const InterfaceQuad& q : out.quads)
    for (const LocalId n : q.node) ++start[at(out.index_of[at(n)]) + 1];
  for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
  std::vector<LocalId> items(static_cast<std::size_t>(start.back()));
  std::vector<std::int64_t> next(start.begin(), start.end() - 1);
  for (std::size_t q = 0; q < out.quads.size(); ++q)
    for (std::size_t v = 0; v < 4; ++v)
      items[static_cast<std::size_t>(next[at(out.index_of[at(out.quads[q].node[v])])]++)] =
          static_cast<LocalId>(4 * q + v);
  out.node_quads.reserve(out.nodes.size(), items.size());
  for (std::size_t i = 0; i < out.nodes.size(); ++i) {
    for (auto e = start[i]; e < start[i + 1]; ++e) out.node_quads.add(items[static_cast<std::size_t>(e)]);
    out.node_quads.end_entry();
  }
}

// Calls visit(other end, whether the edge is one of a curve) for the edges of quads at an interface node, by
// ascending end. An edge is one of a curve unless exactly two quads of one part meet at it.
template <class Visit>
void for_each_edge(const Interfaces& faces, std::size_t i, std::vector<std::pair<LocalId, LocalId>>& ends,
                   Visit&& visit) {
  ends.clear();
  for (const LocalId item : faces.node_quads[i]) {
    const auto& node = faces.quads[at(item / 4)].node;
    for (const int turn : {1, 3})
      ends.emplace_back(faces.index_of[at(node[static_cast<std::size_t>((item + turn) % 4)])], item / 4);
  }
  std::sort(ends.begin(), ends.end());
  for (std::size_t e = 0; e < ends.size();) {
    std::size_t last = e;
    while (last < ends.size() && ends[last].first == ends[e].first) ++last;
    const bool smooth = last - e == 2 && (faces.part.empty() || faces.part[at(ends[e].second)] ==
                                                                    faces.part[at(ends[e + 1].second)]);
    visit(ends[e].first, !smooth);
    e = last;
  }
}

void find_neighbours(Interfaces& out) {
  std::vector<std::pair<LocalId, LocalId>> ends;
  out.neighbours.reserve(out.nodes.size(), 4 * out.nodes.size());
  for (std::size_t i = 0; i < out.nodes.size(); ++i) {
    for_each_edge(out, i, ends, [&](LocalId end, bool) { out.neighbours.add(end); });
    out.neighbours.end_entry();
  }
}

// A curve node has two curve edges; on the box both must run in the box sides of the node, or the curve
// leaves them.
NodeClass class_of(const HexMesh& mesh, const Interfaces& faces, std::size_t i) {
  const auto curve = faces.curve_neighbours[i];
  if (curve.empty()) return NodeClass::kSurface;
  const std::uint8_t sides = mesh.box_sides[at(faces.nodes[i])];
  if (curve.size() != 2 || std::popcount(sides) > 1) return NodeClass::kVertex;
  for (const LocalId n : curve)
    if ((mesh.box_sides[at(faces.nodes[at(n)])] & sides) != sides) return NodeClass::kVertex;
  return NodeClass::kCurve;
}

// Which nodes lie on curves, and what they are there.
void find_curves(const HexMesh& mesh, Interfaces& out) {
  std::vector<std::pair<LocalId, LocalId>> ends;
  out.curve_neighbours = {};
  for (std::size_t i = 0; i < out.nodes.size(); ++i) {
    for_each_edge(out, i, ends, [&](LocalId end, bool on_curve) {
      if (on_curve) out.curve_neighbours.add(end);
    });
    out.curve_neighbours.end_entry();
  }
  out.kind.clear();
  out.kind.reserve(out.nodes.size());
  for (std::size_t i = 0; i < out.nodes.size(); ++i) out.kind.push_back(class_of(mesh, out, i));
}

}  // namespace

Interfaces trace_interfaces(const HexMesh& mesh, const FaceNeighbours& neighbours) {
  Interfaces out;
  find_quads(mesh, neighbours, out);
  number_nodes(mesh, out);
  find_node_quads(out);
  find_neighbours(out);
  find_curves(mesh, out);
  return out;
}

void divide_surfaces(const HexMesh& mesh, Interfaces& faces, std::vector<std::int32_t> part) {
  faces.part = std::move(part);
  find_curves(mesh, faces);
}

}  // namespace sculpt
