// The set of hexes that a curve pillow wraps.
#include <algorithm>
#include <bit>

#include "sculpt/mesh/adjacency.hpp"
#include "sculpt/mesh/edge_walk.hpp"
#include "sculpt/pillow/pillow.hpp"

namespace sculpt {
namespace {

constexpr std::array<std::array<int, 2>, 12> kEdges{
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

class CurveSetFinder {
 public:
  CurveSetFinder(const Comm& comm, const HexMesh& mesh, std::span<const std::uint8_t> curve_node)
      : comm_(comm), mesh_(mesh), curve_node_(curve_node), around_(mesh) {}

  CurveSet run(double threshold, int layers) {
    CurveSet set;
    set.poor = comm_.sum(mark_poor_edges(threshold));
    if (set.poor == 0) return set;
    neighbours_ = face_neighbours(mesh_);
    label_.assign(mesh_.hexes.size(), -1);
    for (int layer = 0; layer < layers; ++layer) {
      if (layer > 0) mark_nodes_of_set();
      add_hexes_at_marked_nodes();
    }
    while (comm_.sum(complete()) > 0) {
    }
    std::int64_t wrapped = 0;
    for (LocalId h = 0; h < mesh_.size(); ++h) wrapped += mesh_.layer[at(h)] == 0 && in(h);
    set.wrapped = comm_.sum(wrapped);
    set.label = std::move(label_);
    return set;
  }

 private:
  [[nodiscard]] bool in(LocalId h) const { return label_[at(h)] >= 0; }

  // Marks the nodes of curve edges with a poor hex; answers how many owned hexes are.
  std::int64_t mark_poor_edges(double threshold) {
    marked_.assign(mesh_.position.size(), 0);
    std::int64_t poor = 0;
    for (LocalId h = 0; h < mesh_.size(); ++h) {
      if (mesh_.layer[at(h)] != 0) continue;
      const Hex& hex = mesh_.hexes[at(h)];
      if (std::count_if(hex.begin(), hex.end(), [&](LocalId n) { return curve_node_[at(n)] != 0; }) < 2)
        continue;
      if (scaled_jacobian(mesh_.corners(h)) >= threshold) continue;
      bool at_curve = false;
      for (const auto& edge : kEdges) {
        const LocalId a = hex[static_cast<std::size_t>(edge[0])], b = hex[static_cast<std::size_t>(edge[1])];
        if (!curve_node_[at(a)] || !curve_node_[at(b)] || !is_curve(a, b)) continue;
        marked_[at(a)] = marked_[at(b)] = 1;
        at_curve = true;
      }
      poor += at_curve;
    }
    mesh_.node_exchange.reduce_to_owners(
        std::span<std::uint8_t>(marked_),
        [](std::uint8_t x, std::uint8_t y) { return static_cast<std::uint8_t>(x | y); });
    mesh_.node_exchange.copy_to_ghosts(marked_);
    return poor;
  }

  // Whether at least three materials meet at an edge of an owned hex.
  [[nodiscard]] bool is_curve(LocalId a, LocalId b) {
    materials_.clear();
    thirds_.clear();
    for (const std::int32_t item : around_[a]) {
      const LocalId h = item / 8;
      const Hex& hex = mesh_.hexes[at(h)];
      if (std::find(hex.begin(), hex.end(), b) == hex.end()) continue;
      materials_.push_back(mesh_.material[at(h)]);
      for (const int f : kCornerFaces[static_cast<std::size_t>(item % 8)])
        if (face_has(mesh_, {h, f}, b)) thirds_.push_back(third_node({h, f}, a, b));
    }
    std::sort(materials_.begin(), materials_.end());
    materials_.erase(std::unique(materials_.begin(), materials_.end()), materials_.end());
    return static_cast<int>(materials_.size()) + (faces_what_is_left_out(a, b) ? 1 : 0) >= 3;
  }
  // The node of the face that an edge joins to a, other than b.
  [[nodiscard]] LocalId third_node(HexFace face, LocalId a, LocalId b) const {
    const auto nodes = face_nodes(mesh_, face);
    const auto i = static_cast<std::size_t>(std::find(nodes.begin(), nodes.end(), a) - nodes.begin());
    const LocalId next = nodes[(i + 1) % 4];
    return next == b ? nodes[(i + 3) % 4] : next;
  }
  // Whether a face at the edge has one hex only and is not on the box: third nodes that occur once.
  [[nodiscard]] bool faces_what_is_left_out(LocalId a, LocalId b) {
    std::sort(thirds_.begin(), thirds_.end());
    const auto sides = static_cast<std::uint8_t>(mesh_.box_sides[at(a)] & mesh_.box_sides[at(b)]);
    for (std::size_t i = 0; i < thirds_.size();) {
      const bool single = i + 1 == thirds_.size() || thirds_[i + 1] != thirds_[i];
      if (single && (sides & mesh_.box_sides[at(thirds_[i])]) == 0) return true;
      i += single ? 1 : 2;
    }
    return false;
  }

  void mark_nodes_of_set() {
    for (LocalId h = 0; h < mesh_.size(); ++h)
      if (in(h))
        for (const LocalId n : mesh_.hexes[at(h)]) marked_[at(n)] = 1;
    mesh_.node_exchange.copy_to_ghosts(marked_);  // the owner sees all hexes of a node
  }

  // Answers how many owned hexes are new.
  std::int64_t add_hexes_at_marked_nodes() {
    std::int64_t added = 0;
    for (LocalId h = 0; h < mesh_.size(); ++h) {
      if (mesh_.layer[at(h)] != 0 || in(h)) continue;
      const Hex& hex = mesh_.hexes[at(h)];
      if (std::none_of(hex.begin(), hex.end(), [&](LocalId n) { return marked_[at(n)] != 0; })) continue;
      label_[at(h)] = 0;
      ++added;
    }
    mesh_.hex_exchange.copy_to_ghosts(label_);
    return added;
  }

  // One step towards a set whose boundary is a surface that cuts interfaces; the set only grows. Answers by
  // how many owned hexes.
  std::int64_t complete() {
    std::fill(marked_.begin(), marked_.end(), std::uint8_t{0});
    for (LocalId n = 0; n < mesh_.nodes(); ++n)
      marked_[at(n)] = mesh_.node_owner[at(n)] == comm_.rank() && !is_clean(n);
    for (LocalId h = 0; h < mesh_.size(); ++h) {
      if (mesh_.layer[at(h)] != 0 || in(h)) continue;
      for (const LocalId other : neighbours_[at(h)])
        if (other != kNone && in(other) && mesh_.material[at(other)] != mesh_.material[at(h)])
          both_.push_back(h);
    }
    mesh_.node_exchange.copy_to_ghosts(marked_);
    std::int64_t added = 0;
    for (const LocalId h : both_) {
      added += !in(h);
      label_[at(h)] = 0;
    }
    both_.clear();
    return added + add_hexes_at_marked_nodes();
  }

  // Whether at a node the set and the rest each hang together by faces, and every material comes out of the
  // set at one place at most.
  [[nodiscard]] bool is_clean(LocalId node) {
    const auto items = around_[node];
    const auto inside = std::count_if(items.begin(), items.end(), [&](std::int32_t i) { return in(i / 8); });
    if (inside == 0 || inside == static_cast<std::ptrdiff_t>(items.size())) return true;
    return hangs_together(items, true) && hangs_together(items, false) && cuts_interfaces(node, items);
  }

  [[nodiscard]] bool hangs_together(std::span<const std::int32_t> items, bool inside) {
    done_.assign(items.size(), 0);
    queue_.clear();
    std::size_t wanted = 0;
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (in(items[i] / 8) != inside) continue;
      ++wanted;
      if (!queue_.empty()) continue;
      done_[i] = 1;
      queue_.push_back(items[i]);
    }
    for (std::size_t q = 0; q < queue_.size(); ++q)
      for (const int f : kCornerFaces[static_cast<std::size_t>(queue_[q] % 8)]) {
        const LocalId other = neighbours_[at(queue_[q] / 8)][static_cast<std::size_t>(f)];
        if (other == kNone || in(other) != inside) continue;
        for (std::size_t i = 0; i < items.size(); ++i)
          if (!done_[i] && items[i] / 8 == other) {
            done_[i] = 1;
            queue_.push_back(items[i]);
          }
      }
    return queue_.size() == wanted;
  }

  // Goes from each face of the set's boundary at the node to the next, around their edges within the set:
  // at most one interface lies between two, none before a face without a hex beyond, and a material that was
  // left does not come again. No hex gets two faces on one surface, or two edges on one edge of the box.
  [[nodiscard]] bool cuts_interfaces(LocalId node, std::span<const std::int32_t> items) {
    materials_.clear();
    int changes = 0;
    bool open = false;
    const unsigned kept_sides = sides_of_set(items);
    for (const std::int32_t item : items) {
      const LocalId h = item / 8;
      if (!in(h)) continue;
      for (const int f : kCornerFaces[static_cast<std::size_t>(item % 8)]) {
        const LocalId other = neighbours_[at(h)][static_cast<std::size_t>(f)];
        if (other == kNone || in(other)) continue;
        materials_.push_back(mesh_.material[at(h)]);
        const auto nodes = face_nodes(mesh_, {h, f});
        const auto i = static_cast<std::size_t>(std::find(nodes.begin(), nodes.end(), node) - nodes.begin());
        const LocalId one = nodes[(i + 1) % 4], two = nodes[(i + 3) % 4];
        const Way a = way_around({h, f}, node, one), b = way_around({h, f}, node, two);
        if (!is_cut(a) || !is_cut(b) || meet_one_surface(a, b)) return false;
        for (const auto& [way, end] : {std::pair{a, one}, std::pair{b, two}})
          if (way.open != 0 &&
              std::popcount(kept_sides & mesh_.box_sides[at(node)] & mesh_.box_sides[at(end)]) > 1)
            return false;
        open = open || a.open != 0 || b.open != 0;
        changes += a.interfaces + b.interfaces;
      }
    }
    std::sort(materials_.begin(), materials_.end());
    const auto distinct = std::unique(materials_.begin(), materials_.end()) - materials_.begin();
    // Each change was met from both its ends.
    return changes / 2 == (open || distinct == 1 ? distinct - 1 : distinct);
  }

  struct Way {
    int interfaces;  // on the way
    unsigned open;   // sides of the face without a hex beyond that ends it; 0 = at a face of the boundary
    std::int32_t material;  // of the last hex
  };
  static constexpr unsigned kNoBox = 0x40;  // stands for the sides of a face inside the box

  [[nodiscard]] Way way_around(HexFace from, LocalId a, LocalId b) const {
    int interfaces = 0;
    for (HexFace face = across_edge(mesh_, from, a, b);; face = across_edge(mesh_, face, a, b)) {
      const HexFace next = other_side(mesh_, neighbours_, face);
      if (next.hex == kNone) {
        const unsigned sides = face_sides(mesh_, face.hex, face.face);
        return {interfaces, sides != 0 ? sides : kNoBox, mesh_.material[at(face.hex)]};
      }
      if (!in(next.hex)) return {interfaces, 0, mesh_.material[at(face.hex)]};
      interfaces += mesh_.material[at(next.hex)] != mesh_.material[at(face.hex)];
      face = next;
    }
  }
  [[nodiscard]] static bool is_cut(const Way& way) { return way.interfaces <= (way.open != 0 ? 0 : 1); }
  // Whether the hex on a boundary face would have two faces on one surface.
  [[nodiscard]] static bool meet_one_surface(const Way& a, const Way& b) {
    return (a.open & b.open) != 0 || (a.interfaces == 1 && b.interfaces == 1 && a.material == b.material);
  }
  // The sides of the box on which hexes of the set have faces at a node.
  [[nodiscard]] unsigned sides_of_set(std::span<const std::int32_t> items) const {
    unsigned sides = 0;
    for (const std::int32_t item : items)
      for (const int f : kCornerFaces[static_cast<std::size_t>(item % 8)])
        if (in(item / 8) && neighbours_[at(item / 8)][static_cast<std::size_t>(f)] == kNone)
          sides |= face_sides(mesh_, item / 8, f);
    return sides;
  }

  const Comm& comm_;
  const HexMesh& mesh_;
  std::span<const std::uint8_t> curve_node_;
  NodeHexes around_;
  FaceNeighbours neighbours_;
  std::vector<std::int32_t> label_;
  std::vector<std::uint8_t> marked_;  // per node
  std::vector<LocalId> both_;
  std::vector<std::int32_t> materials_;
  std::vector<LocalId> thirds_;
  std::vector<std::uint8_t> done_;
  std::vector<std::int32_t> queue_;
};

}  // namespace

CurveSet poor_curves(const Comm& comm, const HexMesh& mesh, std::span<const std::uint8_t> curve_node,
                     double threshold, int layers) {
  return CurveSetFinder(comm, mesh, curve_node).run(threshold, layers);
}

}  // namespace sculpt
