#pragma once
// An octree over the facets of a surface. Leaves list the facets that reach them; leaves that none reaches
// have one winding number. Several threads may ask at once.
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "facets/crossing.hpp"
#include "facets/facet_box.hpp"
#include "sculpt/facets/facet_mesh.hpp"
#include "sculpt/geom/shape.hpp"

namespace sculpt {

class FacetTree {
 public:
  // Of a mesh that is not empty.
  explicit FacetTree(const FacetMesh& mesh);
  // Of what pack() gave.
  explicit FacetTree(std::span<const char> packed);

  // All that questions within the region ask for: what reaches it or the six columns that lines from it pass.
  // The answers are those of the whole tree.
  [[nodiscard]] std::vector<char> pack(const Box& region) const;

  [[nodiscard]] const Box& bounds() const { return bounds_; }  // of the surface
  [[nodiscard]] const Box& cube() const { return cube_; }      // the bounds and more
  [[nodiscard]] Triangle facet(LocalId f) const {
    const auto& corner = triangles_[at(f)];
    return {vertices_[at(corner[0])], vertices_[at(corner[1])], vertices_[at(corner[2])]};
  }
  // The facets that are in it.
  [[nodiscard]] FacetMesh mesh() const {
    FacetMesh all;
    all.vertices = vertices_;
    all.triangles = triangles_;
    return all;
  }
  // Whether a facet reaches the inside of the box.
  [[nodiscard]] bool is_reached(const Box& box) const { return is_reached(0, cube_, box); }
  // Replaces `found` by the facets that reach the inside of the box, ascending.
  void find(const Box& box, std::vector<LocalId>& found) const;
  // How often the surface goes round the point: what lines along the axes say, most of them where they
  // disagree.
  [[nodiscard]] int winding(const Vec3& p) const;
  struct Nearest {
    LocalId facet;
    Vec3 point;
    double square;  // of the distance
  };
  // The nearest point of the facets for which counts(facet) holds; of several the first by x, y and z.
  // Nothing when there is none within `reach`.
  template <class Counts>
  [[nodiscard]] std::optional<Nearest> nearest_of(const Vec3& p, double reach, const Counts& counts) const {
    Nearest best{kNone, p, reach * reach};
    find_nearest(0, cube_, p, counts, best);
    return best.facet == kNone ? std::nullopt : std::optional(best);
  }
  // The nearest point of the surface.
  [[nodiscard]] Vec3 nearest(const Vec3& p) const;

 private:
  struct Node {
    LocalId first = 0;       // of eight children, the low ones first, x fastest; or the place of the list
    std::int32_t count = 0;  // of facets in the list; kInner: the node has children
  };
  static constexpr std::int32_t kInner = -1, kUnknown = INT32_MAX;

  FacetTree() = default;
  void copy_part(std::size_t node, const Box& box, const Box& region, FacetTree& part, std::size_t to) const;
  void number_facets(const FacetTree& whole);
  [[nodiscard]] std::int32_t winding_of_leaf(std::size_t node, const Box& box) const;
  void divide(std::size_t node, const Box& box, std::vector<LocalId>& facets, int depth);
  [[nodiscard]] bool is_reached(std::size_t node, const Box& of_node, const Box& box) const;
  void find(std::size_t node, const Box& of_node, const Box& box, std::vector<LocalId>& found) const;
  [[nodiscard]] int winding_by_lines(const Vec3& p) const;
  [[nodiscard]] int ahead(std::size_t node, const Box& box, std::size_t axis, const Vec3& p,
                          bool forward) const;
  template <class Counts>
  void find_nearest(std::size_t node, const Box& box, const Vec3& p, const Counts& counts,
                    Nearest& best) const;

  [[nodiscard]] static Box child_of(const Box& box, std::size_t child);
  [[nodiscard]] static double square_of_distance(const Box& box, const Vec3& p);
  [[nodiscard]] static bool comes_first(const Vec3& a, const Vec3& b);

  std::vector<Vec3> vertices_;
  std::vector<std::array<LocalId, 3>> triangles_;
  std::vector<Node> nodes_;
  std::vector<LocalId> listed_;
  mutable std::vector<std::int32_t> winding_;  // in leaves without facets, once it was asked for
  Box bounds_, cube_;
};

template <class Counts>
void FacetTree::find_nearest(std::size_t node, const Box& box, const Vec3& p, const Counts& counts,
                             Nearest& best) const {
  const Node& n = nodes_[node];
  if (n.count == kInner) {
    std::array<std::pair<double, std::size_t>, 8> order;
    for (std::size_t c = 0; c < 8; ++c) order[c] = {square_of_distance(child_of(box, c), p), c};
    std::sort(order.begin(), order.end());
    for (const auto& [square, c] : order)
      if (square <= best.square) find_nearest(at(n.first) + c, child_of(box, c), p, counts, best);
    return;
  }
  for (LocalId i = n.first; i < n.first + n.count; ++i) {
    const LocalId f = listed_[at(i)];
    if (!counts(f)) continue;
    const Vec3 q = nearest_point(facet(f), p);
    const double square = dot(q - p, q - p);
    const bool ties = square == best.square && best.facet != kNone;
    if (square < best.square || (ties && (comes_first(q, best.point) || (q == best.point && f < best.facet))))
      best = {f, q, square};
  }
}

}  // namespace sculpt
