#include "facets/facet_tree.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

#include "facets/facet_box.hpp"
#include "sculpt/base/error.hpp"

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

// Whether lines along an axis that pass one box may pass the other.
bool share_column(const Box& a, const Box& b) {
  int apart = 0;
  for (std::size_t d = 0; d < 3; ++d) apart += a.hi[d] < b.lo[d] || b.hi[d] < a.lo[d];
  return apart <= 1;
}

bool holds(const Box& box, const Vec3& p) {
  for (std::size_t d = 0; d < 3; ++d)
    if (p[d] < box.lo[d] || p[d] > box.hi[d]) return false;
  return true;
}

template <class T>
void append(const std::vector<T>& items, std::vector<char>& bytes) {
  const std::uint64_t count = items.size();
  const std::size_t begin = bytes.size();
  bytes.resize(begin + sizeof count + items.size() * sizeof(T));
  std::memcpy(bytes.data() + begin, &count, sizeof count);
  if (count > 0) std::memcpy(bytes.data() + begin + sizeof count, items.data(), items.size() * sizeof(T));
}

template <class T>
std::vector<T> take(std::span<const char>& bytes) {
  std::uint64_t count = 0;
  check(bytes.size() >= sizeof count, "a packed facet tree is cut off");
  std::memcpy(&count, bytes.data(), sizeof count);
  bytes = bytes.subspan(sizeof count);
  check(bytes.size() >= count * sizeof(T), "a packed facet tree is cut off");
  std::vector<T> items(count);
  if (count > 0) std::memcpy(items.data(), bytes.data(), items.size() * sizeof(T));
  bytes = bytes.subspan(items.size() * sizeof(T));
  return items;
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
  winding_.assign(nodes_.size(), kUnknown);
}

FacetTree::FacetTree(std::span<const char> packed) {
  vertices_ = take<Vec3>(packed);
  triangles_ = take<std::array<LocalId, 3>>(packed);
  nodes_ = take<Node>(packed);
  listed_ = take<LocalId>(packed);
  winding_ = take<std::int32_t>(packed);
  const std::vector<Box> boxes = take<Box>(packed);
  bounds_ = boxes.at(0);
  cube_ = boxes.at(1);
}

std::vector<char> FacetTree::pack(const Box& region) const {
  FacetTree part;
  part.nodes_.emplace_back();
  part.winding_.push_back(kUnknown);
  copy_part(0, cube_, region, part, 0);
  part.number_facets(*this);
  std::vector<char> bytes;
  append(part.vertices_, bytes);
  append(part.triangles_, bytes);
  append(part.nodes_, bytes);
  append(part.listed_, bytes);
  append(part.winding_, bytes);
  append(std::vector<Box>{bounds_, cube_}, bytes);
  return bytes;
}

// Copies what the part needs below a node; facets keep their numbers.
void FacetTree::copy_part(std::size_t node, const Box& box, const Box& region, FacetTree& part,
                          std::size_t to) const {
  const Node& n = nodes_[node];
  if (!share_column(box, region)) return;  // an empty leaf that nobody asks for
  if (n.count == kInner) {
    const std::size_t first = part.nodes_.size();
    part.nodes_[to] = {static_cast<LocalId>(first), kInner};
    part.nodes_.resize(first + 8);
    part.winding_.resize(first + 8, kUnknown);
    for (std::size_t c = 0; c < 8; ++c) copy_part(at(n.first) + c, child_of(box, c), region, part, first + c);
    return;
  }
  part.nodes_[to] = {static_cast<LocalId>(part.listed_.size()), n.count};
  const auto first = listed_.begin() + n.first;
  part.listed_.insert(part.listed_.end(), first, first + n.count);
  // The part may lack what lines from outside the region meet.
  if (n.count == 0 && touch(box, region) && !holds(region, odd_point(box)))
    part.winding_[to] = winding_of_leaf(node, box);
}

// Copies the facets that are listed and numbers them and their vertices anew, in the same order.
void FacetTree::number_facets(const FacetTree& whole) {
  std::vector<LocalId> facet(whole.triangles_.size(), kNone), vertex(whole.vertices_.size(), kNone);
  for (const LocalId f : listed_) facet[at(f)] = 0;
  for (std::size_t f = 0; f < facet.size(); ++f) {
    if (facet[f] == kNone) continue;
    facet[f] = static_cast<LocalId>(triangles_.size());
    triangles_.push_back(whole.triangles_[f]);
    for (LocalId& v : triangles_.back()) {
      if (vertex[at(v)] == kNone) {
        vertex[at(v)] = static_cast<LocalId>(vertices_.size());
        vertices_.push_back(whole.vertices_[at(v)]);
      }
      v = vertex[at(v)];
    }
  }
  for (LocalId& f : listed_) f = facet[at(f)];
}

void FacetTree::divide(std::size_t node, const Box& box, std::vector<LocalId>& facets, int depth) {
  if (facets.size() <= kMostInLeaf || depth == kDeepest) {
    nodes_[node].first = static_cast<LocalId>(listed_.size());
    nodes_[node].count = static_cast<std::int32_t>(facets.size());
    listed_.insert(listed_.end(), facets.begin(), facets.end());
    return;
  }
  const std::size_t first = nodes_.size();
  nodes_[node] = {static_cast<LocalId>(first), kInner};
  nodes_.resize(first + 8);
  const double slack = kSlack * (cube_.hi.x - cube_.lo.x);
  const Vec3 middle = 0.5 * (box.lo + box.hi);
  std::array<Box, 8> grown;
  for (std::size_t c = 0; c < 8; ++c) {
    grown[c] = child_of(box, c);
    grown[c].lo = grown[c].lo - Vec3{slack, slack, slack};
    grown[c].hi = grown[c].hi + Vec3{slack, slack, slack};
  }
  std::array<std::vector<LocalId>, 8> of_child;
  for (const LocalId f : facets) {
    const Triangle triangle = facet(f);
    // By its bounds: bit c of those children that it may reach.
    unsigned may = 0xff;
    for (std::size_t d = 0; d < 3; ++d) {
      constexpr std::array<unsigned, 3> kHigh{0xaa, 0xcc, 0xf0};
      const double x = triangle[0][d], y = triangle[1][d], z = triangle[2][d];
      if (std::min(x, std::min(y, z)) > middle[d] + slack) may &= kHigh[d];
      if (std::max(x, std::max(y, z)) < middle[d] - slack) may &= ~kHigh[d];
    }
    for (std::size_t c = 0; c < 8; ++c)
      if ((may >> c & 1U) != 0 && (std::has_single_bit(may) || reaches(triangle, grown[c])))
        of_child[c].push_back(f);
  }
  facets = {};
  for (std::size_t c = 0; c < 8; ++c) divide(first + c, child_of(box, c), of_child[c], depth + 1);
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
  Box box = cube_;
  while (nodes_[node].count == kInner) {
    std::size_t c = 0;
    for (std::size_t d = 0; d < 3; ++d)
      if (p[d] >= 0.5 * (box.lo[d] + box.hi[d])) c += std::size_t{1} << d;
    node = at(nodes_[node].first) + c;
    box = child_of(box, c);
  }
  if (nodes_[node].count > 0) return winding_by_lines(p);
  return winding_of_leaf(node, box);
}

// Several threads may find the same out.
std::int32_t FacetTree::winding_of_leaf(std::size_t node, const Box& box) const {
  const std::atomic_ref<std::int32_t> known(winding_[node]);
  std::int32_t winding = known.load(std::memory_order_relaxed);
  if (winding == kUnknown) {
    winding = winding_by_lines(odd_point(box));
    known.store(winding, std::memory_order_relaxed);
  }
  return winding;
}

// Along the three axes by the shorter way out; where holes make them disagree, by the longer ways as well.
int FacetTree::winding_by_lines(const Vec3& p) const {
  std::array<int, 6> along{};
  const auto look = [&](std::size_t axis, bool shorter) {
    const bool forward = (2 * p[axis] > cube_.lo[axis] + cube_.hi[axis]) == shorter;
    return ahead(0, cube_, axis, p, forward);
  };
  for (std::size_t axis = 0; axis < 3; ++axis) along[axis] = look(axis, true);
  if (along[0] == along[1] && along[1] == along[2]) return along[0];
  for (std::size_t axis = 0; axis < 3; ++axis) along[3 + axis] = look(axis, false);
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
