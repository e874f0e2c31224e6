#include "sculpt/write/side_set_stats.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sculpt/base/fixed_point.hpp"
#include "sculpt/mesh/edge_walk.hpp"

namespace sculpt {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// What faces of a set add up to.
struct Sums {
  std::int64_t set = 0;                           // index
  std::int64_t faces = 0, area = 0, quality = 0;  // the last two in units
  double least = kInfinity, most = -kInfinity;
  Box bounds{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};

  void add(const std::array<Vec3, 4>& corner, double unit_area) {
    const double q = quad_scaled_jacobian(corner);
    add({set, 1, to_units(quad_area(corner) / unit_area), to_units(q), q, q, {corner[0], corner[0]}});
    for (const Vec3& p : corner) add_bounds({p, p});
  }
  void add(const Sums& other) {
    faces += other.faces;
    area += other.area;
    quality += other.quality;
    least = std::min(least, other.least);
    most = std::max(most, other.most);
    add_bounds(other.bounds);
  }

  void add_bounds(const Box& other) {
    for (std::size_t d = 0; d < 3; ++d) {
      bounds.lo[d] = std::min(bounds.lo[d], other.lo[d]);
      bounds.hi[d] = std::max(bounds.hi[d], other.hi[d]);
    }
  }
};

}  // namespace

double quad_area(const std::array<Vec3, 4>& corner) {
  const auto& [a, b, c, d] = corner;
  return 0.25 * (norm(cross(b - a, c - a)) + norm(cross(c - a, d - a)) + norm(cross(c - b, d - b)) +
                 norm(cross(d - b, a - b)));
}

double quad_scaled_jacobian(const std::array<Vec3, 4>& corner) {
  const Vec3 normal = cross(corner[2] - corner[0], corner[3] - corner[1]);
  double least = 1;
  for (std::size_t v = 0; v < 4; ++v) {
    const Vec3 a = corner[(v + 1) % 4] - corner[v], b = corner[(v + 3) % 4] - corner[v];
    const double size = norm(a) * norm(b) * norm(normal);
    least = std::min(least, size > 0 ? dot(cross(a, b), normal) / size : 0.0);
  }
  return least;
}

std::vector<SideSetStats> side_set_stats(const Comm& comm, const HexMesh& mesh,
                                         std::span<const std::int64_t> ids, std::span<const SideFace> faces) {
  const double unit_area = std::pow(mesh.cell_size.x * mesh.cell_size.y * mesh.cell_size.z, 2.0 / 3.0);
  std::vector<Sums> sums(ids.size());
  for (const SideFace& f : faces) {
    std::array<Vec3, 4> corner;
    const auto nodes = face_nodes(mesh, {f.hex, f.face});
    for (std::size_t v = 0; v < 4; ++v) corner[v] = mesh.position[at(nodes[v])];
    const auto s = std::lower_bound(ids.begin(), ids.end(), f.set) - ids.begin();
    sums[static_cast<std::size_t>(s)].add(corner, unit_area);
  }
  std::vector<Sums> mine;
  for (std::size_t s = 0; s < sums.size(); ++s) {
    sums[s].set = static_cast<std::int64_t>(s);
    if (sums[s].faces > 0) mine.push_back(sums[s]);
    sums[s] = {};
  }
  for (const Sums& part : comm.concatenate(mine)) sums[static_cast<std::size_t>(part.set)].add(part);
  std::vector<SideSetStats> stats;
  for (std::size_t s = 0; s < ids.size(); ++s) {
    const Sums& all = sums[s];
    SideSetStats& of = stats.emplace_back();
    of.id = ids[s];
    of.faces = all.faces;
    if (all.faces == 0) continue;
    of.area = unit_area * from_units(all.area);
    of.least = all.least;
    of.most = all.most;
    of.mean = from_units(all.quality) / static_cast<double>(all.faces);
    of.bounds = all.bounds;
  }
  return stats;
}

}  // namespace sculpt
