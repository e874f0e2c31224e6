#include "pipeline/interface_geometry.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace sculpt {
namespace {

constexpr double kIntoSurface = 1.0 / 3;  // of the way from a curve node to the middle of the quads beside it
constexpr double kSliding = 0.1;          // weight of a tangential deviation

// The two materials of the hexes around each node; second = -1 where there is one only.
std::vector<std::pair<std::int32_t, std::int32_t>> materials_at_nodes(const HexMesh& mesh) {
  std::vector<std::pair<std::int32_t, std::int32_t>> found(mesh.position.size(), {-1, -1});
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h)
    for (const LocalId n : mesh.hexes[h]) {
      auto& [first, second] = found[at(n)];
      if (first < 0 || first == mesh.material[h])
        first = mesh.material[h];
      else
        second = mesh.material[h];
    }
  for (auto& [first, second] : found)
    if (second >= 0 && second < first) std::swap(first, second);
  return found;
}

// A point of the surface between two materials beside one of its curve nodes, and the weight of a deviation
// there.
struct SurfacePoint {
  Vec3 position;
  Weight weight;
};

SurfacePoint beside_curve(const HexMesh& cells, const Interfaces& faces, LocalId entry,
                          std::pair<std::int32_t, std::int32_t> materials) {
  Vec3 middle, normal;
  int quads = 0;
  for (const LocalId item : faces.node_quads[at(entry)]) {
    const InterfaceQuad& q = faces.quads[at(item / 4)];
    const auto pair = Interfaces::materials(cells, q);
    if (pair[0] != materials.first || pair[1] != materials.second) continue;
    std::array<Vec3, 4> p;
    for (std::size_t v = 0; v < 4; ++v) p[v] = cells.position[at(q.node[v])];
    middle += 0.25 * (p[0] + p[1] + p[2] + p[3]);
    const Vec3 n = unit(cross(p[2] - p[0], p[3] - p[1]));
    normal += cells.material[at(q.cell[0])] == pair[0] ? n : -n;
    ++quads;
  }
  const Vec3 curve = cells.position[at(faces.nodes[at(entry)])];
  if (quads == 0) return {curve, {kSliding, 0, 0, kSliding, 0, kSliding}};
  const Vec3 n = unit(normal);
  const double along = 1 - kSliding;
  const std::uint8_t sides = cells.box_sides[at(faces.nodes[at(entry)])];
  return {curve + held_on_box(kIntoSurface * ((1.0 / quads) * middle - curve), sides),
          {kSliding + along * n.x * n.x, along * n.x * n.y, along * n.x * n.z, kSliding + along * n.y * n.y,
           along * n.y * n.z, kSliding + along * n.z * n.z}};
}

// Onto the plane through a point across the direction that the weight holds.
Vec3 onto_plane(const Vec3& target, const Weight& w, const Vec3& p) {
  const Vec3 d = p - target;
  const Vec3 held = {(w[0] - kSliding) * d.x + w[1] * d.y + w[2] * d.z,
                     w[1] * d.x + (w[3] - kSliding) * d.y + w[4] * d.z,
                     w[2] * d.x + w[4] * d.y + (w[5] - kSliding) * d.z};
  return p - (1 / (1 - kSliding)) * held;
}

}  // namespace

Pillowed stacked(const Pillowed& first, Pillowed second) {
  for (std::size_t n = 0; n < second.source.size(); ++n) {
    const std::size_t before = at(second.source[n]);
    second.copied[n] = first.copied[before] ? 1 : static_cast<std::uint8_t>(2 * second.copied[n]);
    second.source[n] = first.source[before];
  }
  return second;
}

Geometry interface_geometry(Pillowed& pillowed, const HexMesh& cells, const Interfaces& faces,
                            const std::vector<Weight>& weights) {
  HexMesh& mesh = pillowed.mesh;
  Geometry g;
  g.index.assign(mesh.position.size(), kNone);
  const bool stacked =
      std::find(pillowed.copied.begin(), pillowed.copied.end(), std::uint8_t{2}) != pillowed.copied.end();
  const auto materials =
      stacked ? materials_at_nodes(mesh) : std::vector<std::pair<std::int32_t, std::int32_t>>{};
  for (std::size_t n = 0; n < pillowed.source.size(); ++n) {
    const LocalId entry = faces.index_of[at(pillowed.source[n])];
    if (entry == kNone || pillowed.copied[n] == 1) continue;
    if (pillowed.copied[n] == 2 && materials[n].second < 0) continue;
    g.index[n] = static_cast<LocalId>(g.target.size());
    SurfacePoint point{mesh.position[n], weights[at(entry)]};
    if (pillowed.copied[n] == 2) point = beside_curve(cells, faces, entry, materials[n]);
    mesh.position[n] = point.position;
    g.target.push_back(point.position);
    g.weight.push_back(point.weight);
    g.on_curve.push_back(pillowed.copied[n] == 0 && faces.kind[at(entry)] != NodeClass::kSurface);
  }
  mesh.node_exchange.copy_to_ghosts(mesh.position);
  return g;
}

void hold(Geometry& geometry, const Pillowed& pillowed, HeldInterface interface) {
  const auto held = std::make_shared<const HeldInterface>(std::move(interface));
  // Per entry of the geometry its interface node; copies that a surface pillow made have none.
  std::vector<LocalId> node(geometry.target.size(), kNone);
  for (std::size_t n = 0; n < pillowed.source.size(); ++n)
    if (geometry.index[n] != kNone && pillowed.copied[n] == 0)
      node[at(geometry.index[n])] = held->faces.index_of[at(pillowed.source[n])];
  const auto quadrics = std::make_shared<std::vector<Quadric>>();
  if (held->quadrics)
    for (std::size_t i = 0; i < held->faces.nodes.size(); ++i)
      quadrics->push_back(surface_quadric(held->cells, held->faces, i, [&](LocalId other) {
        return held->cells.position[at(held->faces.nodes[at(other)])];
      }));
  geometry.onto = [held, quadrics, node, targets = geometry.target, weights = geometry.weight](
                      LocalId entry, const Vec3& p) {
    const LocalId i = node[at(entry)];
    if (i == kNone) return onto_plane(targets[at(entry)], weights[at(entry)], p);
    const bool on_surface = held->faces.kind[at(i)] == NodeClass::kSurface;
    if (held->quadrics) return on_surface ? onto_quadric((*quadrics)[at(i)], p) : targets[at(entry)];
    const Vec3 point = onto_geometry(held->cells, held->faces, held->crossings, held->exact, at(i), p);
    // Planes that hardly cut each other meet far away.
    return on_surface
               ? point
               : within_reach(held->cells, held->faces.nodes[at(i)], held->grid_position[at(i)], point);
  };
}

}  // namespace sculpt
