#include <algorithm>
#include <cmath>
#include <numeric>

#include "facets/crossing.hpp"
#include "sculpt/facets/facet_mesh.hpp"

namespace sculpt {
namespace {

constexpr double kWeld = 1e-6;  // of the diagonal of the bounds

void note(Defects& defects, std::int64_t facet, const Vec3& place) {
  if (defects.count++ == 0) {
    defects.facet = facet;
    defects.place = place;
  }
}

class Repair {
 public:
  explicit Repair(FacetMesh& mesh) : mesh_(mesh) {}

  FacetReport run() {
    drop_degenerate();
    next_ = facet_neighbours(mesh_);
    if (weld()) {
      drop_degenerate();
      next_ = facet_neighbours(mesh_);
    }
    if (drop_duplicates()) next_ = facet_neighbours(mesh_);
    find_components();
    count_edges();
    turn_outwards();
    return report_;
  }

 private:
  using Corners = std::array<LocalId, 3>;
  struct Component {
    std::vector<LocalId> triangles;
    Box bounds;
    double volume = 0;
    bool turned = false;
  };

  [[nodiscard]] Triangle corners(std::size_t t) const {
    const Corners& c = mesh_.triangles[t];
    return {mesh_.vertices[at(c[0])], mesh_.vertices[at(c[1])], mesh_.vertices[at(c[2])]};
  }
  void note_facet(Defects& defects, std::size_t t) const {
    const Triangle p = corners(t);
    note(defects, mesh_.facet[t], (1.0 / 3) * (p[0] + p[1] + p[2]));
  }
  void note_edge(Defects& defects, std::size_t t, std::size_t e) const {
    const Triangle p = corners(t);
    note(defects, mesh_.facet[t], 0.5 * (p[e] + p[(e + 1) % 3]));
  }
  [[nodiscard]] bool is_open(std::size_t t, std::size_t e) const { return at(next_[t][e]) == t; }
  // The facet beyond an edge of two; kNone at other edges.
  [[nodiscard]] LocalId beyond(std::size_t t, std::size_t e) const {
    const LocalId other = next_[t][e];
    if (at(other) == t) return kNone;
    return at(next_[at(other)][edge_of(at(other), t, e)]) == t ? other : kNone;
  }
  // The number, in another facet, of the edge e of a facet.
  [[nodiscard]] std::size_t edge_of(std::size_t other, std::size_t t, std::size_t e) const {
    const LocalId a = mesh_.triangles[t][e], b = mesh_.triangles[t][(e + 1) % 3];
    const Corners& c = mesh_.triangles[other];
    std::size_t edge = 0;
    while (!((c[edge] == a && c[(edge + 1) % 3] == b) || (c[edge] == b && c[(edge + 1) % 3] == a))) ++edge;
    return edge;
  }
  // Whether two facets at an edge have the same side out.
  [[nodiscard]] bool agree(std::size_t t, std::size_t e, std::size_t other) const {
    return mesh_.triangles[other][edge_of(other, t, e)] != mesh_.triangles[t][e];
  }

  template <class Goes>
  bool drop(const Goes& goes, Defects& defects) {
    std::size_t kept = 0;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (goes(t)) {
        note_facet(defects, t);
        continue;
      }
      mesh_.triangles[kept] = mesh_.triangles[t];
      mesh_.facet[kept] = mesh_.facet[t];
      mesh_.part[kept++] = mesh_.part[t];
    }
    const bool any = kept < mesh_.triangles.size();
    mesh_.triangles.resize(kept);
    mesh_.facet.resize(kept);
    mesh_.part.resize(kept);
    return any;
  }

  // Facets whose corners are on one line stay: without them there would be a gap.
  void drop_degenerate() {
    drop(
        [&](std::size_t t) {
          const Corners& c = mesh_.triangles[t];
          return c[0] == c[1] || c[1] == c[2] || c[2] == c[0];
        },
        report_.degenerate);
  }

  // Joins vertices of open edges that are almost in the same place.
  bool weld() {
    std::vector<LocalId> rim;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      for (std::size_t e = 0; e < 3; ++e)
        if (is_open(t, e)) {
          rim.push_back(mesh_.triangles[t][e]);
          rim.push_back(mesh_.triangles[t][(e + 1) % 3]);
        }
    if (rim.empty()) return false;
    const auto place = [&](LocalId v) -> const Vec3& { return mesh_.vertices[at(v)]; };
    std::sort(rim.begin(), rim.end(), [&](LocalId a, LocalId b) {
      const Vec3 &p = place(a), &q = place(b);
      return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z < q.z;
    });
    rim.erase(std::unique(rim.begin(), rim.end()), rim.end());
    const Box bounds = bounds_of(mesh_);
    const double near = kWeld * norm(bounds.hi - bounds.lo);
    std::vector<LocalId> becomes(mesh_.vertices.size());
    std::iota(becomes.begin(), becomes.end(), LocalId{0});
    for (std::size_t i = 0; i < rim.size(); ++i)
      for (std::size_t j = i; j-- > 0 && place(rim[i]).x - place(rim[j]).x <= near;)
        if (norm(place(rim[i]) - place(rim[j])) <= near) {
          becomes[at(rim[i])] = becomes[at(rim[j])];
          break;
        }
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      for (LocalId& v : mesh_.triangles[t])
        if (becomes[at(v)] != v) v = becomes[at(v)];
    for (const LocalId v : rim)
      if (becomes[at(v)] != v) note(report_.welded, 0, place(v));
    return report_.welded.count > 0;
  }

  // Drops facets with the corners of an earlier one in the same sense. Two in opposite senses are the walls
  // of two bodies that touch.
  bool drop_duplicates() {
    std::vector<std::uint8_t> again(mesh_.triangles.size(), 0);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      for (std::size_t u = at(next_[t][0]); u != t; u = at(next_[u][edge_of(u, t, 0)])) {
        Corners c = mesh_.triangles[u];
        for (int turn = 0; turn < 3 && c != mesh_.triangles[t]; ++turn)
          std::rotate(c.begin(), c.begin() + 1, c.end());
        if (c == mesh_.triangles[t]) again[std::max(t, u)] = 1;
      }
    return drop([&](std::size_t t) { return again[t] != 0; }, report_.duplicate);
  }

  // Spreads over edges of two facets and marks the facets that look the other way; within a component the
  // sense of most facets is kept.
  void find_components() {
    turned_.assign(mesh_.triangles.size(), 0);
    std::vector<std::uint8_t> seen(mesh_.triangles.size(), 0);
    for (std::size_t start = 0; start < seen.size(); ++start) {
      if (seen[start]) continue;
      Component component;
      std::vector<LocalId>& list = component.triangles;
      seen[start] = 1;
      list.push_back(static_cast<LocalId>(start));
      std::size_t turned = 0;
      for (std::size_t i = 0; i < list.size(); ++i)
        for (std::size_t e = 0; e < 3; ++e) {
          const std::size_t t = at(list[i]);
          const LocalId other = beyond(t, e);
          if (other == kNone || seen[at(other)]) continue;
          seen[at(other)] = 1;
          turned_[at(other)] = agree(t, e, at(other)) ? turned_[t] : !turned_[t];
          turned += turned_[at(other)];
          list.push_back(other);
        }
      if (2 * turned > list.size())
        for (const LocalId t : list) turned_[at(t)] = !turned_[at(t)];
      measure(component);
      components_.push_back(std::move(component));
    }
    report_.components = static_cast<std::int64_t>(components_.size());
  }

  void measure(Component& component) const {
    const Vec3 origin = corners(at(component.triangles[0]))[0];
    component.bounds = {origin, origin};
    for (const LocalId t : component.triangles) {
      const Triangle p = corners(at(t));
      const double volume = dot(p[0] - origin, cross(p[1] - origin, p[2] - origin)) / 6;
      component.volume += turned_[at(t)] ? -volume : volume;
      for (const Vec3& q : p)
        for (std::size_t d = 0; d < 3; ++d) {
          component.bounds.lo[d] = std::min(component.bounds.lo[d], q[d]);
          component.bounds.hi[d] = std::max(component.bounds.hi[d], q[d]);
        }
    }
  }

  void count_edges() {
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      for (std::size_t e = 0; e < 3; ++e) {
        const LocalId other = beyond(t, e);
        if (is_open(t, e))
          note_edge(report_.open, t, e);
        else if (other == kNone)
          count_non_manifold(t, e);
        else if (at(other) > t && agree(t, e, at(other)) != (turned_[t] == turned_[at(other)]))
          note_edge(report_.inconsistent, t, e);
      }
  }
  // Once per edge: for the first of its facets.
  void count_non_manifold(std::size_t t, std::size_t e) {
    for (std::size_t u = at(next_[t][e]); u != t; u = at(next_[u][edge_of(u, t, e)]))
      if (u < t) return;
    note_edge(report_.non_manifold, t, e);
  }

  void turn_outwards() {
    for (Component& c : components_) {
      const Component* outermost = &c;
      for (const Component& other : components_)
        if (&other != &c && std::fabs(other.volume) > std::fabs(outermost->volume) && holds(other, c))
          outermost = &other;
      c.turned = outermost->volume < 0;
    }
    for (const Component& c : components_)
      if (c.turned)
        for (const LocalId t : c.triangles) turned_[at(t)] = !turned_[at(t)];
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (!turned_[t]) continue;
      std::swap(mesh_.triangles[t][1], mesh_.triangles[t][2]);
      note_facet(report_.flipped, t);
    }
  }

  // Whether a component lies inside another: by a corner of it, along three lines.
  [[nodiscard]] bool holds(const Component& outer, const Component& inner) const {
    for (std::size_t d = 0; d < 3; ++d)
      if (!(outer.bounds.lo[d] < inner.bounds.lo[d] && inner.bounds.hi[d] < outer.bounds.hi[d])) return false;
    const Vec3 p = corners(at(inner.triangles[0]))[0];
    int inside = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      int crossings = 0;
      for (const LocalId t : outer.triangles) {
        const auto c = cross_line(corners(at(t)), axis, p[(axis + 1) % 3], p[(axis + 2) % 3]);
        crossings += c && c->t > p[axis];
      }
      inside += crossings % 2;
    }
    return inside >= 2;
  }

  FacetMesh& mesh_;
  FacetReport report_;
  FacetNeighbours next_;
  std::vector<std::uint8_t> turned_;  // per triangle
  std::vector<Component> components_;
};

}  // namespace

FacetReport repair(FacetMesh& mesh) { return Repair(mesh).run(); }

}  // namespace sculpt
