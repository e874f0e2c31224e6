#include "sculpt/facets/facet_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace sculpt {
namespace {

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

// Smallest member of each set of facets.
class FacetSets {
 public:
  explicit FacetSets(std::size_t facets) : first_(facets) { std::iota(first_.begin(), first_.end(), 0); }
  std::int32_t find(std::int32_t f) {
    while (first_[index(f)] != f) f = first_[index(f)] = first_[index(first_[index(f)])];
    return f;
  }
  void join(std::int32_t a, std::int32_t b) {
    const auto [least, other] = std::minmax(find(a), find(b));
    first_[index(other)] = least;
  }

 private:
  std::vector<std::int32_t> first_;
};

struct FacetEdge {
  std::int32_t a, b, facet;
  auto operator<=>(const FacetEdge&) const = default;
};

// Every edge of every facet, those of one place next to each other.
std::vector<FacetEdge> edges_of(std::span<const std::array<std::int32_t, 3>> facet) {
  std::vector<FacetEdge> edges;
  edges.reserve(3 * facet.size());
  for (std::size_t f = 0; f < facet.size(); ++f)
    for (std::size_t v = 0; v < 3; ++v) {
      const auto [a, b] = std::minmax(facet[f][v], facet[f][(v + 1) % 3]);
      edges.push_back({a, b, static_cast<std::int32_t>(f)});
    }
  std::sort(edges.begin(), edges.end());
  return edges;
}

}  // namespace

FacetSurfaces divide_facets(std::span<const Vec3> vertex, std::span<const std::array<std::int32_t, 3>> facet,
                            double angle) {
  const double least_cosine = std::cos(angle * std::numbers::pi / 180);
  const auto normal = [&](std::int32_t f) {
    const auto& [a, b, c] = facet[index(f)];
    return unit(cross(vertex[index(b)] - vertex[index(a)], vertex[index(c)] - vertex[index(a)]));
  };
  FacetSets sets(facet.size());
  const std::vector<FacetEdge> edges = edges_of(facet);
  for (std::size_t e = 0; e < edges.size();) {
    std::size_t last = e;
    while (last < edges.size() && edges[last].a == edges[e].a && edges[last].b == edges[e].b) ++last;
    if (last - e == 2 && dot(normal(edges[e].facet), normal(edges[e + 1].facet)) >= least_cosine)
      sets.join(edges[e].facet, edges[e + 1].facet);
    e = last;
  }

  FacetSurfaces out;
  out.surface.resize(facet.size());
  for (std::size_t f = 0; f < facet.size(); ++f) {
    const std::int32_t first = sets.find(static_cast<std::int32_t>(f));
    out.surface[f] = first == static_cast<std::int32_t>(f) ? out.surfaces++ : out.surface[index(first)];
  }
  std::vector<std::pair<std::int32_t, std::int32_t>> meeting;  // vertex, surface
  for (std::size_t f = 0; f < facet.size(); ++f)
    for (const std::int32_t v : facet[f]) meeting.emplace_back(v, out.surface[f]);
  std::sort(meeting.begin(), meeting.end());
  meeting.erase(std::unique(meeting.begin(), meeting.end()), meeting.end());
  out.corner.assign(vertex.size(), -1);
  for (std::size_t m = 2; m < meeting.size(); ++m) {
    std::int32_t& corner = out.corner[index(meeting[m].first)];
    if (meeting[m - 2].first == meeting[m].first && corner < 0) corner = out.corners++;
  }
  return out;
}

}  // namespace sculpt
