#include "sculpt/facets/facet_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sculpt {

void turn_facets(FacetMesh& mesh, const std::array<Vec3, 3>& axes) {
  for (Vec3& p : mesh.vertices) p = {dot(p, axes[0]), dot(p, axes[1]), dot(p, axes[2])};
}

Box bounds_of(const FacetMesh& mesh) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box box{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  for (const auto& triangle : mesh.triangles)
    for (const LocalId v : triangle)
      for (std::size_t d = 0; d < 3; ++d) {
        box.lo[d] = std::min(box.lo[d], mesh.vertices[at(v)][d]);
        box.hi[d] = std::max(box.hi[d], mesh.vertices[at(v)][d]);
      }
  return box;
}

FacetNeighbours facet_neighbours(const FacetMesh& mesh) {
  struct Side {
    std::uint64_t edge;  // both vertices
    LocalId triangle;
    std::int32_t corner;
  };
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t e = 0; e < 3; ++e) {
      const auto [low, high] = std::minmax(mesh.triangles[t][e], mesh.triangles[t][(e + 1) % 3]);
      sides.push_back({static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint64_t>(high),
                       static_cast<LocalId>(t), static_cast<std::int32_t>(e)});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.triangle < b.triangle;
  });
  FacetNeighbours next(mesh.triangles.size());
  for (std::size_t first = 0; first < sides.size();) {
    std::size_t end = first + 1;
    while (end < sides.size() && sides[end].edge == sides[first].edge) ++end;
    for (std::size_t s = first; s < end; ++s)
      next[at(sides[s].triangle)][static_cast<std::size_t>(sides[s].corner)] =
          sides[s + 1 < end ? s + 1 : first].triangle;
    first = end;
  }
  return next;
}

FacetSizes sizes_of(const FacetMesh& mesh) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  FacetSizes sizes{kInfinity, 0, kInfinity, 0, kInfinity, 0, 0};
  if (mesh.triangles.empty()) return {};
  const Vec3 origin = mesh.vertices[at(mesh.triangles[0][0])];
  for (const auto& triangle : mesh.triangles) {
    std::array<Vec3, 3> p;
    for (std::size_t c = 0; c < 3; ++c) p[c] = mesh.vertices[at(triangle[c])] - origin;
    const double area = 0.5 * norm(cross(p[1] - p[0], p[2] - p[0]));
    sizes.area_min = std::min(sizes.area_min, area);
    sizes.area_max = std::max(sizes.area_max, area);
    sizes.volume += dot(p[0], cross(p[1], p[2])) / 6;
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 a = p[(c + 1) % 3] - p[c], b = p[(c + 2) % 3] - p[c];
      const double side = norm(a), angle = std::atan2(2 * area, dot(a, b)) * 180 / std::numbers::pi;
      sizes.side_min = std::min(sizes.side_min, side);
      sizes.side_max = std::max(sizes.side_max, side);
      sizes.angle_min = std::min(sizes.angle_min, angle);
      sizes.angle_max = std::max(sizes.angle_max, angle);
    }
  }
  return sizes;
}

}  // namespace sculpt
