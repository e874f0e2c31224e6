#include "facets/facet_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "facets/facet_box.hpp"

namespace sculpt {
namespace {

constexpr std::size_t kMostInLeaf = 24;
constexpr int kDeepest = 16;
constexpr double kSlack = 1e-9;  // of the cube: facets are listed a little beyond where they are

bool touch(const Box& a, const Box& b) {
  for (std::size_t d = 0; d < 3; ++d)
    if (a.hi[d] < b.lo[d] || b.hi[d] < a.lo[d]) return false;
  return true;
}

}  // namespace

Box FacetTree::child_of(const Box& box, std::size_t child) {
  Box part = box;
  for (std::size_t d = 0; d < 3; ++d)
    ((child >> d & 1U) != 0 ? part.lo : part.hi)[d] = 0.5 * (box.lo[d] + box.hi[d]);
  return part;
}

double FacetTree::square_of_distance(const Box& box, const Vec3& p) {
  Vec3 off;
  for (std::size_t d = 0; d < 3; ++d) off[d] = std::max({box.lo[d] - p[d], 0.0, p[d] - box.hi[d]});
  return dot(off, off);
}

bool FacetTree::comes_first(const Vec3& a, const Vec3& b) {
  return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

FacetTree::FacetTree(const FacetMesh& mesh)
    : vertices_(mesh.vertices), triangles_(mesh.triangles), bounds_(bounds_of(mesh)) {
  constexpr double kMargin = 1.01;
  const Vec3 centre = 0.5 * (bounds_.lo + bounds_.hi);
  const double half = 0.5 * kMargin * largest(bounds_.hi - bounds_.lo);
  cube_ = {centre - Vec3{half, half, half}, centre + Vec3{half, half, half}};
  std::vector<LocalId> all(triangles_.size());
  std::iota(all.begin(), all.end(), LocalId{0});
  nodes_.emplace_back();
  divide(0, cube_, all, 0);
  wind(0, cube_);
}

void FacetTree::divide(std::size_t node, const Box& box, std::vector<LocalId>& facets, int depth) {
  if (facets.size() <= kMostInLeaf || depth == kDeepest) {
    nodes_[node].first = static_cast<LocalId>(listed_.size());
    nodes_[node].count = static_cast<std::int32_t>(facets.size());
    listed_.insert(listed_.end(), facets.begin(), facets.end());
    return;
  }
  const std::size_t first = nodes_.size();
  nodes_[node] = {static_cast<LocalId>(first), kInner, 0};
  nodes_.resize(first + 8);
  const double slack = kSlack * (cube_.hi.x - cube_.lo.x);
  std::array<std::vector<LocalId>, 8> of_child;
  for (std::size_t c = 0; c < 8; ++c) {
    Box grown = child_of(box, c);
    grown.lo = grown.lo - Vec3{slack, slack, slack};
    grown.hi = grown.hi + Vec3{slack, slack, slack};
    for (const LocalId f : facets)
      if (reaches(facet(f), grown)) of_child[c].push_back(f);
  }
  facets = {};
  for (std::size_t c = 0; c < 8; ++c) divide(first + c, child_of(box, c), of_child[c], depth + 1);
}

void FacetTree::wind(std::size_t node, const Box& box) {
  if (nodes_[node].count == 0) nodes_[node].winding = winding_by_lines(odd_point(box));
  if (nodes_[node].count != kInner) return;
  for (std::size_t c = 0; c < 8; ++c) wind(at(nodes_[node].first) + c, child_of(box, c));
}

bool FacetTree::is_reached(std::size_t node, const Box& of_node, const Box& box) const {
  if (!touch(of_node, box)) return false;
  const Node& n = nodes_[node];
  if (n.count == kInner) {
    for (std::size_t c = 0; c < 8; ++c)
      if (is_reached(at(n.first) + c, child_of(of_node, c), box)) return true;
    return false;
  }
  const auto first = listed_.begin() + n.first;
  return std::any_of(first, first + n.count, [&](LocalId f) { return reaches(facet(f), box); });
}

void FacetTree::find(const Box& box, std::vector<LocalId>& found) const {
  found.clear();
  find(0, cube_, box, found);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
}

void FacetTree::find(std::size_t node, const Box& of_node, const Box& box,
                     std::vector<LocalId>& found) const {
  if (!touch(of_node, box)) return;
  const Node& n = nodes_[node];
  if (n.count == kInner) {
    for (std::size_t c = 0; c < 8; ++c) find(at(n.first) + c, child_of(of_node, c), box, found);
    return;
  }
  for (LocalId i = n.first; i < n.first + n.count; ++i)
    if (reaches(facet(listed_[at(i)]), box)) found.push_back(listed_[at(i)]);
}

int FacetTree::winding(const Vec3& p) const {
  for (std::size_t d = 0; d < 3; ++d)
    if (!(cube_.lo[d] <= p[d] && p[d] < cube_.hi[d])) return 0;
  std::size_t node = 0;
  for (Box box = cube_; nodes_[node].count == kInner;) {
    std::size_t c = 0;
    for (std::size_t d = 0; d < 3; ++d)
      if (p[d] >= 0.5 * (box.lo[d] + box.hi[d])) c += std::size_t{1} << d;
    node = at(nodes_[node].first) + c;
    box = child_of(box, c);
  }
  return nodes_[node].count == 0 ? nodes_[node].winding : winding_by_lines(p);
}

// Lines in different directions do not all pass the same hole.
int FacetTree::winding_by_lines(const Vec3& p) const {
  std::array<int, 6> along{};
  for (std::size_t axis = 0; axis < 3; ++axis) along[axis] = ahead(0, cube_, axis, p, true);
  if (along[0] == along[1] && along[1] == along[2]) return along[0];
  for (std::size_t axis = 0; axis < 3; ++axis) along[3 + axis] = ahead(0, cube_, axis, p, false);
  std::sort(along.begin(), along.end());
  return along[2];
}

// Exits less entries on the way from p out of the node, along an axis or against it.
int FacetTree::ahead(std::size_t node, const Box& box, std::size_t axis, const Vec3& p, bool forward) const {
  const std::size_t axis_u = (axis + 1) % 3, axis_v = (axis + 2) % 3;
  const Node& n = nodes_[node];
  int sum = 0;
  if (n.count == kInner) {
    for (std::size_t c = 0; c < 8; ++c) {
      const Box part = child_of(box, c);
      if (part.lo[axis_u] <= p[axis_u] && p[axis_u] < part.hi[axis_u] && part.lo[axis_v] <= p[axis_v] &&
          p[axis_v] < part.hi[axis_v] && (forward ? part.hi[axis] > p[axis] : part.lo[axis] <= p[axis]))
        sum += ahead(at(n.first) + c, part, axis, p, forward);
    }
    return sum;
  }
  for (LocalId i = n.first; i < n.first + n.count; ++i) {
    const auto c = cross_line(facet(listed_[at(i)]), axis, p[axis_u], p[axis_v]);
    if (!c || c->t < box.lo[axis] || c->t >= box.hi[axis]) continue;  // another leaf counts it
    if (forward ? c->t > p[axis] : c->t <= p[axis]) sum += forward ? c->exit : -c->exit;
  }
  return sum;
}

Vec3 FacetTree::nearest(const Vec3& p) const {
  const auto found = nearest_of(p, std::numeric_limits<double>::infinity(), [](LocalId) { return true; });
  return found ? found->point : p;
}

}  // namespace sculpt
