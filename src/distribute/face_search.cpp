#include "distribute/face_search.hpp"

#include <cmath>
#include <limits>

#include "sculpt/base/lot.hpp"

namespace sculpt {
namespace {

// Cubes of a hierarchy of grids; the cubes of depth d are 2^-d times as large as those of depth 0. A face
// lies in the cubes that are just larger than it, so in eight at most; a node looks into one cube of every
// depth in use. Faces of any mixture of sizes are found in this way.
constexpr int kDepths = 48;

struct Cubes {
  Vec3 lo;
  double size = 1;  // at depth 0

  [[nodiscard]] int depth(double extent) const {
    int depth = 0;
    for (double s = size / 2; depth + 1 < kDepths && s >= extent; s /= 2) ++depth;
    return depth;
  }
  [[nodiscard]] std::array<std::int64_t, 3> index(const Vec3& p, int depth) const {
    std::array<std::int64_t, 3> i;
    for (std::size_t d = 0; d < 3; ++d)
      i[d] = static_cast<std::int64_t>(std::floor(std::ldexp((p[d] - lo[d]) / size, depth)));
    return i;
  }
  // Two cubes may have one key: more is compared then.
  static std::uint64_t key(const std::array<std::int64_t, 3>& index, int depth) {
    std::uint64_t k = lot_of(depth);
    for (const std::int64_t i : index) k = lot_of(static_cast<std::int64_t>(k) + i);
    return k;
  }
};

struct FaceEntry {
  std::uint64_t key;
  LoneFace face;
};
struct NodeEntry {
  std::uint64_t key;
  GlobalId node;
  Vec3 place;
};

struct Extent {
  Vec3 lo, hi;
  double shortest, longest;  // edge
};
Extent extent_of(const LoneFace& face) {
  Extent e{face.corner[0], face.corner[0], std::numeric_limits<double>::max(), 0};
  for (std::size_t v = 0; v < 4; ++v) {
    const Vec3& p = face.corner[v];
    for (std::size_t d = 0; d < 3; ++d) {
      e.lo[d] = std::min(e.lo[d], p[d]);
      e.hi[d] = std::max(e.hi[d], p[d]);
    }
    const double edge = norm(face.corner[(v + 1) % 4] - p);
    e.shortest = std::min(e.shortest, edge);
    e.longest = std::max(e.longest, edge);
  }
  return e;
}

Cubes cubes_around(const Comm& comm, std::span<const LoneFace> faces) {
  Vec3 lo, hi;
  for (std::size_t d = 0; d < 3; ++d) {
    double least = std::numeric_limits<double>::max(), greatest = std::numeric_limits<double>::lowest();
    for (const LoneFace& face : faces)
      for (const Vec3& p : face.corner) {
        least = std::min(least, p[d]);
        greatest = std::max(greatest, p[d]);
      }
    lo[d] = comm.min(least);
    hi[d] = comm.max(greatest);
  }
  const double size = largest(hi - lo);
  return {lo, size > 0 ? 2 * size : 1};
}

void compare(const NodeEntry& node, const LoneFace& face, double tolerance, std::vector<Touch>& touches) {
  if (std::find(face.nodes.begin(), face.nodes.end(), node.node) != face.nodes.end()) return;
  const Extent extent = extent_of(face);
  for (std::size_t v = 0; v < 4; ++v) {
    const double distance = norm(node.place - face.corner[v]);
    if (distance > tolerance * extent.shortest) continue;
    const double part = distance > 0 ? distance / extent.shortest : 0;
    const Vec3& place = node.node < face.nodes[v] ? node.place : face.corner[v];
    touches.push_back({node.node, place, face.nodes[v], part, face.element, face.block});
    return;
  }
  const auto& c = face.corner;
  const double distance = std::min(distance_to_triangle(node.place, c[0], c[1], c[2]),
                                   distance_to_triangle(node.place, c[0], c[2], c[3]));
  if (distance <= tolerance * std::sqrt(extent.shortest * extent.longest))
    touches.push_back({node.node, node.place, -1, distance, face.element, face.block});
}

template <class Entry>
std::vector<Entry> gathered(const Comm& comm, const std::vector<std::vector<Entry>>& out) {
  std::vector<Entry> all;
  for (const auto& from : comm.all_to_all(out)) all.insert(all.end(), from.begin(), from.end());
  std::sort(all.begin(), all.end(), [](const Entry& a, const Entry& b) { return a.key < b.key; });
  return all;
}

}  // namespace

double distance_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto to_edge = [&p](const Vec3& from, const Vec3& to) {
    const Vec3 along = to - from;
    const double length2 = dot(along, along);
    const double t = length2 > 0 ? std::fmin(1, std::fmax(0, dot(p - from, along) / length2)) : 0;
    return norm(p - from - t * along);
  };
  const double edges = std::fmin(to_edge(a, b), std::fmin(to_edge(b, c), to_edge(c, a)));
  const Vec3 normal = cross(b - a, c - a);
  const double area = norm(normal);
  if (!(area > 0)) return edges;
  const auto inside = [&](const Vec3& from, const Vec3& to) {
    return dot(cross(to - from, p - from), normal) >= 0;
  };
  if (!inside(a, b) || !inside(b, c) || !inside(c, a)) return edges;
  return std::fmin(edges, std::fabs(dot(p - a, normal)) / area);
}

std::vector<Touch> touching_nodes(const Comm& comm, std::span<const LoneFace> faces, double tolerance) {
  const Cubes cubes = cubes_around(comm, faces);
  const auto ranks = static_cast<std::uint64_t>(comm.size());
  std::vector<std::vector<FaceEntry>> faces_out(ranks);
  std::vector<std::vector<NodeEntry>> nodes_out(ranks);
  std::array<std::uint64_t, 1> depths{0};
  for (const LoneFace& face : faces) {
    const Extent extent = extent_of(face);
    const double margin = 2 * tolerance * extent.longest;
    const Vec3 more{margin, margin, margin};
    const int depth = cubes.depth(largest(extent.hi - extent.lo) + 2 * margin);
    depths[0] |= std::uint64_t{1} << depth;
    const auto lo = cubes.index(extent.lo - more, depth), hi = cubes.index(extent.hi + more, depth);
    for (std::int64_t i = lo[0]; i <= hi[0]; ++i)
      for (std::int64_t j = lo[1]; j <= hi[1]; ++j)
        for (std::int64_t k = lo[2]; k <= hi[2]; ++k) {
          const std::uint64_t key = Cubes::key({i, j, k}, depth);
          faces_out[key % ranks].push_back({key, face});
        }
  }
  comm.bit_or(depths);
  std::vector<std::pair<GlobalId, Vec3>> nodes;
  for (const LoneFace& face : faces)
    for (std::size_t v = 0; v < 4; ++v) nodes.push_back({face.nodes[v], face.corner[v]});
  std::sort(nodes.begin(), nodes.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  nodes.erase(std::unique(nodes.begin(), nodes.end(),
                          [](const auto& a, const auto& b) { return a.first == b.first; }),
              nodes.end());
  for (const auto& [node, place] : nodes)
    for (int depth = 0; depth < kDepths; ++depth) {
      if ((depths[0] >> depth & 1) == 0) continue;
      const std::uint64_t key = Cubes::key(cubes.index(place, depth), depth);
      nodes_out[key % ranks].push_back({key, node, place});
    }
  const std::vector<FaceEntry> there = gathered(comm, faces_out);
  std::vector<Touch> touches;
  auto begin = there.begin();
  for (const NodeEntry& node : gathered(comm, nodes_out)) {
    while (begin != there.end() && begin->key < node.key) ++begin;
    for (auto f = begin; f != there.end() && f->key == node.key; ++f)
      compare(node, f->face, tolerance, touches);
  }
  return touches;
}

}  // namespace sculpt
