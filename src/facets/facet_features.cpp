#include "sculpt/facets/facet_features.hpp"

#include <algorithm>
#include <limits>

#include "facets/facet_tree.hpp"

namespace sculpt {
namespace {

Vec3 nearest_on_segment(const Vec3& a, const Vec3& b, const Vec3& p) {
  const Vec3 along = b - a;
  const double square = dot(along, along);
  const double t = square > 0 ? std::clamp(dot(p - a, along) / square, 0.0, 1.0) : 0;
  return t == 1 ? b : a + t * along;
}

}  // namespace

FacetFeatures::FacetFeatures(const std::vector<Solid>& solids, double reach) : reach_(reach) {
  FacetMesh all;
  std::int32_t corners = 0;
  for (const Solid& solid : solids) {
    const auto first = static_cast<LocalId>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), solid.mesh->vertices.begin(), solid.mesh->vertices.end());
    for (const auto& [a, b, c] : solid.mesh->triangles)
      all.triangles.push_back({first + a, first + b, first + c});
    add(solid, surfaces_, corners);
    surfaces_ += solid.mesh->surfaces;
    corners += solid.mesh->corners;
  }
  tree_ = std::make_unique<const FacetTree>(all);
}

FacetFeatures::~FacetFeatures() = default;

void FacetFeatures::add(const Solid& solid, std::int32_t first_surface, std::int32_t first_corner) {
  const FacetMesh& mesh = *solid.mesh;
  const FacetNeighbours neighbours = facet_neighbours(mesh);
  std::map<LocalId, std::vector<std::int32_t>> at_corner;  // by vertex: the surfaces there
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::int32_t surface = first_surface + mesh.surface[t];
    surface_.push_back(surface);
    material_.push_back(solid.material);
    for (std::size_t e = 0; e < 3; ++e) {
      const LocalId a = mesh.triangles[t][e], b = mesh.triangles[t][(e + 1) % 3];
      if (mesh.corner[at(a)] >= 0) at_corner[a].push_back(surface);
      const std::int32_t beside = first_surface + mesh.surface[at(neighbours[t][e])];
      if (surface < beside)
        curves_[{surface, beside}].push_back({mesh.vertices[at(a)], mesh.vertices[at(b)]});
    }
  }
  for (auto& [vertex, surfaces] : at_corner) {
    std::sort(surfaces.begin(), surfaces.end());
    surfaces.erase(std::unique(surfaces.begin(), surfaces.end()), surfaces.end());
    corners_.push_back({first_corner + mesh.corner[at(vertex)], mesh.vertices[at(vertex)], surfaces});
  }
}

std::optional<GeometryFeatures::SurfacePoint> FacetFeatures::nearest(const Vec3& p, std::int32_t a,
                                                                     std::int32_t b) const {
  const auto found =
      tree_->nearest_of(p, reach_, [&](LocalId f) { return material_[at(f)] == a || material_[at(f)] == b; });
  if (!found) return std::nullopt;
  return SurfacePoint{surface_[at(found->facet)], found->point};
}

std::optional<Vec3> FacetFeatures::on_surface(std::int32_t surface, const Vec3& p) const {
  const auto found = tree_->nearest_of(p, reach_, [&](LocalId f) { return surface_[at(f)] == surface; });
  if (!found) return std::nullopt;
  return found->point;
}

std::optional<Vec3> FacetFeatures::on_curve(std::int32_t a, std::int32_t b, const Vec3& p) const {
  const auto curve = curves_.find(std::minmax(a, b));
  if (curve == curves_.end()) return std::nullopt;
  std::optional<Vec3> best;
  double least = reach_ * reach_;
  for (const Segment& s : curve->second) {
    const Vec3 q = nearest_on_segment(s.a, s.b, p);
    if (const double square = dot(q - p, q - p); square < least) {
      least = square;
      best = q;
    }
  }
  return best;
}

std::optional<GeometryFeatures::Corner> FacetFeatures::at_corner(std::span<const std::int32_t> surfaces,
                                                                 const Vec3& p) const {
  std::optional<Corner> best;
  double least = reach_ * reach_;
  for (const SolidCorner& c : corners_) {
    const double square = dot(c.point - p, c.point - p);
    if (!(square < least) ||
        !std::includes(c.surfaces.begin(), c.surfaces.end(), surfaces.begin(), surfaces.end()))
      continue;
    least = square;
    best = Corner{c.number, c.point};
  }
  return best;
}

}  // namespace sculpt
