#include <algorithm>
#include <array>

#include "sculpt/contour/contour.hpp"

namespace sculpt {
namespace {

constexpr double kFarthest = 0.7;  // of a cell, per axis: enough to reach any plane between the cell centres
constexpr double kFarthestOnBox = 0.45;  // the same for nodes held on the box: two of them must not meet
constexpr double kParallel = 0.2;  // sine of the angle below which two planes have no useful intersection

// A plane that stands for all quads at the node between the same two materials.
struct Plane {
  std::array<std::int32_t, 2> materials;
  Vec3 point, normal;
  int count = 0;
};

// Mean of the projections to the planes of the single crossings; near crossings weigh more.
Vec3 on_surface(const Vec3& p, const Vec3& in_cells, const std::vector<Crossing>& crossings,
                std::span<const LocalId> items) {
  constexpr double kSoftness = 0.25;  // square of a distance in cells
  Vec3 sum;
  double weight = 0;
  for (const LocalId item : items) {
    const Crossing& x = crossings[at(item / 4)];
    const Vec3 off = scaled(p - x.point, in_cells);
    const double w = 1 / (kSoftness + dot(off, off));
    sum += w * (p - dot(p - x.point, x.normal) * x.normal);
    weight += w;
  }
  return (1 / weight) * sum;
}

void merge_planes(const HexMesh& mesh, const Interfaces& faces, const std::vector<Crossing>& crossings,
                  std::span<const LocalId> items, std::vector<Plane>& planes) {
  planes.clear();
  for (const LocalId item : items) {
    const auto pair = Interfaces::materials(mesh, faces.quads[at(item / 4)]);
    auto plane =
        std::find_if(planes.begin(), planes.end(), [&](const Plane& x) { return x.materials == pair; });
    if (plane == planes.end()) plane = planes.insert(planes.end(), {pair, {}, {}, 0});
    plane->point += crossings[at(item / 4)].point;
    plane->normal += crossings[at(item / 4)].normal;
    ++plane->count;
  }
  std::sort(planes.begin(), planes.end(),
            [](const Plane& a, const Plane& b) { return a.materials < b.materials; });
  for (Plane& plane : planes) {
    plane.point = (1.0 / plane.count) * plane.point;
    plane.normal = unit(plane.normal);
  }
}

// Mean of the nearest points on the pairwise intersections; false when no two planes intersect well.
bool on_intersections(const Vec3& p, const std::vector<Plane>& planes, Vec3& result) {
  Vec3 sum;
  double weight = 0;
  for (std::size_t a = 0; a < planes.size(); ++a)
    for (std::size_t b = a + 1; b < planes.size(); ++b) {
      const double sine = norm(cross(planes[a].normal, planes[b].normal));
      if (sine < kParallel) continue;
      const double cosine = dot(planes[a].normal, planes[b].normal), det = 1 - cosine * cosine;
      const double ra = dot(p - planes[a].point, planes[a].normal),
                   rb = dot(p - planes[b].point, planes[b].normal);
      const double la = (ra - cosine * rb) / det, lb = (rb - cosine * ra) / det;
      sum += sine * (p - la * planes[a].normal - lb * planes[b].normal);
      weight += sine;
    }
  if (weight > 0) result = (1 / weight) * sum;
  return weight > 0;
}

}  // namespace

Vec3 onto_interface(const HexMesh& mesh, const Interfaces& faces, const std::vector<Crossing>& crossings,
                    std::size_t i, const Vec3& p) {
  const auto items = faces.node_quads[i];
  std::vector<Plane> planes;
  merge_planes(mesh, faces, crossings, items, planes);
  Vec3 target;
  if (planes.size() > 1 && on_intersections(p, planes, target)) return target;
  return on_surface(p, mesh.per_cell(faces.nodes[i]), crossings, items);
}

Vec3 onto_geometry(const HexMesh& mesh, const Interfaces& faces, const std::vector<Crossing>& crossings,
                   const ExactSurface& exact, std::size_t i, const Vec3& p) {
  if (exact && faces.kind[i] == NodeClass::kSurface) {
    const auto [a, b] = Interfaces::materials(mesh, faces.quads[at(faces.node_quads[i][0] / 4)]);
    if (const std::optional<Vec3> known = exact(p, a, b)) return *known;
  }
  return onto_interface(mesh, faces, crossings, i, p);
}

Vec3 within_reach(const HexMesh& mesh, LocalId node, const Vec3& grid_position, const Vec3& point) {
  Vec3 move = held(mesh, node, grid_position, point - grid_position);
  const double most = largest(scaled(move, mesh.per_cell(node)));
  const double farthest = mesh.box_sides[at(node)] != 0 ? kFarthestOnBox : kFarthest;
  if (most > farthest) move = held(mesh, node, grid_position, (farthest / most) * move);
  return grid_position + move;
}

void place_nodes(HexMesh& mesh, const Interfaces& faces, const std::vector<Crossing>& crossings) {
  const int rank = mesh.node_exchange.comm().rank();
  for (std::size_t i = 0; i < faces.nodes.size(); ++i) {
    const LocalId n = faces.nodes[i];
    if (mesh.node_owner[at(n)] != rank) continue;
    Vec3& p = mesh.position[at(n)];
    p = within_reach(mesh, n, p, onto_interface(mesh, faces, crossings, i, p));
  }
  share_positions(mesh);
}

}  // namespace sculpt
