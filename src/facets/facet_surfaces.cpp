#include "sculpt/facets/facet_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace sculpt {
namespace {

// Sets of facets, each told by its smallest member.
class FacetSets {
 public:
  explicit FacetSets(std::size_t facets) : first_(facets) { std::iota(first_.begin(), first_.end(), 0); }
  LocalId find(LocalId f) {
    while (first_[at(f)] != f) f = first_[at(f)] = first_[at(first_[at(f)])];
    return f;
  }
  void join(LocalId a, LocalId b) {
    const auto [least, other] = std::minmax({find(a), find(b)});
    first_[at(other)] = least;
  }

 private:
  std::vector<LocalId> first_;
};

Vec3 normal_of(const FacetMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return unit(
      cross(mesh.vertices[at(b)] - mesh.vertices[at(a)], mesh.vertices[at(c)] - mesh.vertices[at(a)]));
}

void find_surfaces(FacetMesh& mesh, double angle) {
  const double least_cosine = std::cos(angle * std::numbers::pi / 180);
  const FacetNeighbours neighbours = facet_neighbours(mesh);
  std::vector<Vec3> normal(mesh.triangles.size());
  for (std::size_t t = 0; t < normal.size(); ++t) normal[t] = normal_of(mesh, t);
  FacetSets sets(mesh.triangles.size());
  for (std::size_t t = 0; t < normal.size(); ++t)
    for (const LocalId other : neighbours[t]) {
      const auto& back = neighbours[at(other)];
      const bool just_two = std::find(back.begin(), back.end(), static_cast<LocalId>(t)) != back.end();
      const bool one_part = mesh.part.empty() || mesh.part[t] == mesh.part[at(other)];
      if (just_two && one_part && dot(normal[t], normal[at(other)]) >= least_cosine)
        sets.join(static_cast<LocalId>(t), other);
    }
  mesh.surface.resize(mesh.triangles.size());
  mesh.surfaces = 0;
  for (std::size_t t = 0; t < mesh.surface.size(); ++t) {
    const LocalId first = sets.find(static_cast<LocalId>(t));
    mesh.surface[t] = at(first) == t ? mesh.surfaces++ : mesh.surface[at(first)];
  }
}

void find_corners(FacetMesh& mesh) {
  std::vector<std::pair<LocalId, std::int32_t>> meeting;  // vertex, surface
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const LocalId v : mesh.triangles[t]) meeting.emplace_back(v, mesh.surface[t]);
  std::sort(meeting.begin(), meeting.end());
  meeting.erase(std::unique(meeting.begin(), meeting.end()), meeting.end());
  mesh.corner.assign(mesh.vertices.size(), -1);
  mesh.corners = 0;
  for (std::size_t m = 2; m < meeting.size(); ++m) {
    std::int32_t& corner = mesh.corner[at(meeting[m].first)];
    if (meeting[m - 2].first == meeting[m].first && corner < 0) corner = mesh.corners++;
  }
}

}  // namespace

void divide_facets(FacetMesh& mesh, double angle) {
  find_surfaces(mesh, angle);
  find_corners(mesh);
}

}  // namespace sculpt
