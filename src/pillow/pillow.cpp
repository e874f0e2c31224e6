#include "sculpt/pillow/pillow.hpp"

#include <algorithm>
#include <bit>
#include <map>

#include "sculpt/mesh/adjacency.hpp"
#include "sculpt/mesh/edge_walk.hpp"
#include "sculpt/mesh/edit.hpp"

namespace sculpt {
namespace {

constexpr GlobalId kNodeFactor = 64;
constexpr GlobalId kBoxNodeFactor = 2;       // a wrap of the box copies a node once
constexpr GlobalId kExteriorNodeFactor = 4;  // parts of the domain may meet in a node
constexpr int kBottom = 4, kTop = 5;   // faces of a new hex: towards the old hex, where the old face was
constexpr double kLongEdge = 2;        // in the shortest edges at a node: longer ones count as this long
constexpr double kAhead = 0.2;         // cosine: what leads away from a face
constexpr double kLeastOfWay = 0.25;   // what is left of the way of a copy when it is put on the exterior
constexpr std::int32_t kOutside = -1;  // stands for the material of what is not meshed

// The interface that runs through a set at one of its nodes.
struct InterfaceThrough {
  Vec3 normal;  // sum over faces seen from the hexes of the set
  int faces = 0;
  std::vector<std::pair<LocalId, std::int32_t>> beside;  // other end of an edge at the node, material there

  void clear() {
    normal = {};
    faces = 0;
    beside.clear();
  }
};

class Pillower {
 public:
  Pillower(const HexMesh& mesh, const FaceNeighbours& neighbours, std::span<const std::int32_t> label,
           std::span<const std::uint8_t> drop, const PillowRules& rules)
      : mesh_(mesh),
        neighbours_(neighbours),
        label_(label),
        drop_(drop),
        rules_(rules),
        node_factor_(rules.box_sides == 0    ? kNodeFactor
                     : mesh.exterior.empty() ? kBoxNodeFactor
                                             : kExteriorNodeFactor),
        kept_layers_(mesh.ghost_layers - 1) {}

  Pillowed run(const Comm& comm) {
    find_wrapped_faces();
    number_nodes();
    make_hexes();
    follow_exterior();
    forget_unused_nodes();
    if (rules_.with_neighbours) connect();
    HexMesh& out = result_.mesh;
    out.colours = mesh_.colours;
    result_.node_factor = node_factor_;
    out.ghost_layers = kept_layers_;
    out.cell_size = mesh_.cell_size;
    out.period = mesh_.period;
    out.quantum = mesh_.quantum;
    connect_ranks(comm, out);
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool kept(LocalId h) const {
    return mesh_.layer[at(h)] <= kept_layers_ && (drop_.empty() || !drop_[at(h)]);
  }
  // Whether a new hex goes on this face.
  [[nodiscard]] bool wrapped(LocalId h, int face) const { return wrapped_[at(h)] >> face & 1; }

  void find_wrapped_faces() {
    wrapped_.assign(mesh_.hexes.size(), 0);
    on_boundary_.assign(mesh_.position.size(), 0);
    for (LocalId h = 0; h < mesh_.size(); ++h) {
      if (label_[at(h)] < 0) continue;
      for (int f = 0; f < 6; ++f) {
        const LocalId other = neighbours_[at(h)][static_cast<std::size_t>(f)];
        const bool wrap = other != kNone ? label_[at(other)] != label_[at(h)] : wraps_boundary({h, f});
        if (!wrap) continue;
        wrapped_[at(h)] |= static_cast<std::uint8_t>(1 << f);
        for (const LocalId n : face_nodes(mesh_, {h, f})) on_boundary_[at(n)] = 1;
      }
    }
  }

  // Whether a face without a neighbour is to be wrapped.
  [[nodiscard]] bool wraps_boundary(HexFace face) const {
    if (mesh_.exterior.empty()) return (rules_.box_sides & face_sides(mesh_, face.hex, face.face)) != 0;
    const LocalId facet = mesh_.exterior.facet_at(face.hex, face.face);
    if (facet == kNone) return false;
    return rules_.box_sides != 0 || mesh_.exterior.facets[at(facet)].whole != 0;
  }

  void add_node(LocalId from, GlobalId copy, const Vec3& position, std::uint8_t sides) {
    HexMesh& out = result_.mesh;
    out.position.push_back(position);
    out.node_id.push_back(node_factor_ * mesh_.node_id[at(from)] + copy);
    out.node_owner.push_back(mesh_.node_owner[at(from)]);
    out.box_sides.push_back(sides);
    out.colour.push_back(mesh_.colour[at(from)]);
    if (!mesh_.node_unit.empty()) out.node_unit.push_back(mesh_.node_unit[at(from)]);
    if (!mesh_.exterior.empty()) out.exterior.hold_of.push_back(mesh_.exterior.hold_of[at(from)]);
    if (!mesh_.node_home.empty()) {
      out.node_home.push_back(node_factor_ * mesh_.node_home[at(from)] + copy);
      out.node_image.push_back(mesh_.node_image[at(from)]);
    }
    result_.source.push_back(from);
    result_.copied.push_back(copy != 0);
  }

  // Gives every old node, followed by its copies, a new number; corner_ tells which one a hex takes at a
  // corner.
  void number_nodes() {
    const NodeHexes around(mesh_);
    if (!mesh_.exterior.empty()) {
      result_.mesh.exterior.facets = mesh_.exterior.facets;
      result_.mesh.exterior.holds = mesh_.exterior.holds;
      result_.mesh.exterior.patch = mesh_.exterior.patch;
      result_.mesh.exterior.curved = mesh_.exterior.curved;
      result_.mesh.exterior.slides = mesh_.exterior.slides;
    }
    corner_.resize(mesh_.hexes.size());
    first_.resize(mesh_.position.size());
    result_.mesh.position.reserve(mesh_.position.size());
    for (LocalId n = 0; n < mesh_.nodes(); ++n) {
      first_[at(n)] = static_cast<LocalId>(result_.mesh.position.size());
      add_node(n, 0, mesh_.position[at(n)], mesh_.box_sides[at(n)]);
      const auto items = around[n];
      for (const std::int32_t item : items)
        corner_[at(item / 8)][static_cast<std::size_t>(item % 8)] = first_[at(n)];
      if (!on_boundary_[at(n)]) continue;
      copy_node(n, items);
      if (rules_.box_sides == 0 && mesh_.box_sides[at(n)] != 0) {
        const std::uint8_t left = sides_left(n, items);
        result_.mesh.box_sides[at(first_[at(n)])] = left;
        if (!mesh_.exterior.empty() && left != mesh_.box_sides[at(n)]) leave_exterior(n, items, left);
      }
    }
  }

  // The sides of the domain on which an old node still has a face, now that its copies are known: a wrapped
  // one, one of a hex that did not take a copy, or one of a new hex, where a wrapped face meets the side in
  // an edge at the node. But where the faces on both sides of that edge belong to one group, the layers close
  // over the edge: in meshes that are no lattice a hex may touch the boundary in an edge or a node only, and
  // the node lies inside then.
  [[nodiscard]] std::uint8_t sides_left(LocalId node, std::span<const std::int32_t> items) {
    unsigned left = 0;
    rim_.clear();
    for (const std::int32_t item : items) {
      const LocalId h = item / 8, corner = corner_[at(h)][static_cast<std::size_t>(item % 8)];
      for (const int f : kCornerFaces[static_cast<std::size_t>(item % 8)]) {
        if (neighbours_[at(h)][static_cast<std::size_t>(f)] != kNone) continue;
        const std::uint8_t sides = face_sides(mesh_, h, f);
        if (wrapped(h, f) || corner == first_[at(node)]) left |= sides;
        if (wrapped(h, f)) continue;
        const auto nodes = face_nodes(mesh_, {h, f});
        const auto v = static_cast<std::size_t>(std::find(nodes.begin(), nodes.end(), node) - nodes.begin());
        for (const std::size_t edge : {v, (v + 3) % 4})
          rim_.push_back(
              {nodes[edge == v ? (v + 1) % 4 : edge], corner, sides, layer_at({h, f}, edge).hex != kNone});
      }
    }
    for (const Rim& one : rim_) {
      if (!one.at_layer) continue;
      const bool closed = std::any_of(rim_.begin(), rim_.end(), [&](const Rim& two) {
        return &one != &two && one.end == two.end && one.corner == two.corner;
      });
      if (!closed) left |= one.sides;
    }
    return static_cast<std::uint8_t>(left);
  }

  // The wrapped face on which a layer ends at an edge of a face of the boundary that is not wrapped; hex:
  // kNone when there is none. It may be one of the same hex or of a hex of the same set farther around the
  // edge.
  [[nodiscard]] HexFace layer_at(HexFace face, std::size_t edge) const {
    if (label_[at(face.hex)] < 0) return {kNone, 0};
    const auto nodes = face_nodes(mesh_, face);
    const LocalId a = nodes[edge], b = nodes[(edge + 1) % 4];
    for (;;) {
      face = across_edge(mesh_, face, a, b);
      if (wrapped(face.hex, face.face)) return face;
      face = other_side(mesh_, neighbours_, face);
      if (face.hex == kNone) return face;
    }
  }

  // One copy for every face-connected group of equally labelled hexes at the node that has a wrapped face
  // there.
  void copy_node(LocalId node, std::span<const std::int32_t> items) {
    done_.assign(items.size(), 0);
    GlobalId copies = 0;
    for (std::size_t first = 0; first < items.size(); ++first) {
      if (done_[first] || label_[at(items[first] / 8)] < 0) continue;
      done_[first] = 1;
      group_.assign(1, items[first]);
      bool wanted = false;
      std::uint8_t sides = 0;  // those that the group keeps a face on
      for (std::size_t g = 0; g < group_.size(); ++g) {
        const LocalId h = group_[g] / 8;
        for (const int f : kCornerFaces[static_cast<std::size_t>(group_[g] % 8)]) {
          const LocalId other = neighbours_[at(h)][static_cast<std::size_t>(f)];
          wanted = wanted || wrapped(h, f);
          if (other == kNone && !wrapped(h, f)) sides |= face_sides(mesh_, h, f);
          if (other == kNone || label_[at(other)] != label_[at(h)]) continue;
          for (std::size_t i = 0; i < items.size(); ++i)
            if (!done_[i] && items[i] / 8 == other) {
              done_[i] = 1;
              group_.push_back(items[i]);
            }
        }
      }
      if (!wanted) continue;
      check(++copies < node_factor_, "a node needs too many pillow copies");
      std::sort(group_.begin(), group_.end());
      const LocalId copy = result_.mesh.nodes();
      const Vec3 way = rules_.offset * inwards(node, copy);
      if (mesh_.exterior.empty())
        add_node(node, copies, mesh_.position[at(node)] + held_on_box(way, sides), sides);
      else
        add_held(node, items, copies, way, sides);
      for (const std::int32_t item : group_) corner_[at(item / 8)][static_cast<std::size_t>(item % 8)] = copy;
    }
  }

  // A face of the boundary at a node: the ends of its edges there, the one that comes first by the right-hand
  // rule and the other one.
  struct Piece {
    LocalId facet, next, previous;
  };
  void add_pieces(LocalId node, std::span<const std::int32_t> items, std::vector<Piece>& pieces) const {
    pieces.clear();
    for (const std::int32_t item : items)
      for (const int f : kCornerFaces[static_cast<std::size_t>(item % 8)]) {
        const HexFace face{item / 8, f};
        const LocalId facet = mesh_.exterior.facet_at(face.hex, face.face);
        if (facet == kNone || wrapped(face.hex, face.face)) continue;
        const auto nodes = face_nodes(mesh_, face);
        const auto v = static_cast<std::size_t>(std::find(nodes.begin(), nodes.end(), node) - nodes.begin());
        pieces.push_back({facet, nodes[(v + 1) % 4], nodes[(v + 3) % 4]});
      }
  }
  // Puts the faces around a node in the order in which they follow each other; false when they are no fan.
  static bool order(std::vector<Piece>& pieces) {
    const auto follows = [&](const Piece& p) {
      return std::find_if(pieces.begin(), pieces.end(),
                          [&](const Piece& q) { return q.previous == p.next; }) != pieces.end();
    };
    const auto start =
        std::find_if(pieces.begin(), pieces.end(), [&](const Piece& p) { return !follows(p); });
    if (start != pieces.end()) std::iter_swap(pieces.begin(), start);
    for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
      const auto next = std::find_if(pieces.begin() + static_cast<std::ptrdiff_t>(i) + 1, pieces.end(),
                                     [&](const Piece& q) { return q.next == pieces[i].previous; });
      if (next == pieces.end()) return false;
      std::iter_swap(pieces.begin() + static_cast<std::ptrdiff_t>(i) + 1, next);
    }
    return true;
  }

  // A copy in a mesh with an exterior. It stays on the faces that its group keeps there. Between faces of
  // different surfaces it keeps to their edge. Where the faces of one surface do not lie in one plane,
  // nothing that it could do there leaves the shape quite as it is: the middle one of its faces, or the edge
  // between the two middle ones, does least harm and leaves the angles wide.
  void add_held(LocalId node, std::span<const std::int32_t> items, GlobalId copy, const Vec3& way,
                std::uint8_t sides) {
    const Vec3& p = mesh_.position[at(node)];
    Exterior& exterior = result_.mesh.exterior;
    add_pieces(node, group_, pieces_);
    add_node(node, copy, p + way, pieces_.empty() ? std::uint8_t{0} : sides);
    exterior.hold_of.back() = kNone;
    if (pieces_.empty()) return;
    add_pieces(node, items, all_pieces_);
    const LocalId of_node = mesh_.exterior.hold_of[at(node)];
    if (all_pieces_.size() == pieces_.size() && of_node != Exterior::kKept && !at_whole_face(items)) {
      exterior.hold_of.back() = of_node;  // it takes the node's place
      result_.mesh.position.back() = p;
      return;
    }
    const LocalId hold = hold_for_pieces();
    exterior.hold_of.back() = hold;
    Vec3 q = exterior.nearest(hold, p + way);
    if (norm(q - p) < kLeastOfWay * norm(way)) {  // the way leads across the surface
      const Hold& h = exterior.holds[at(hold)];
      Vec3 there;
      if (h.kind == Hold::Kind::kLine) {
        there = norm(h.line[0] - p) > norm(h.line[2] - p) ? h.line[0] : h.line[2];
      } else {
        for (auto i = h.first; i < h.last; ++i)
          for (const Vec3& corner : exterior.facets[at(exterior.patch[static_cast<std::size_t>(i)])].corner)
            there += (0.25 / (h.last - h.first)) * corner;
      }
      q = exterior.nearest(hold, p + (0.5 * rules_.offset) * (there - p));
    }
    result_.mesh.position.back() = q;
  }
  // Whether a face of the boundary is wrapped at the node, so that the node stays there.
  [[nodiscard]] bool at_whole_face(std::span<const std::int32_t> items) const {
    for (const std::int32_t item : items)
      for (const int f : kCornerFaces[static_cast<std::size_t>(item % 8)])
        if (neighbours_[at(item / 8)][static_cast<std::size_t>(f)] == kNone && wrapped(item / 8, f))
          return true;
    return false;
  }
  LocalId hold_for_pieces() {
    Exterior& exterior = result_.mesh.exterior;
    const auto facet = [&](std::size_t i) -> const Facet& { return exterior.facets[at(pieces_[i].facet)]; };
    const auto on_surface = [&](std::size_t first, std::size_t last) {
      patch_.clear();
      for (std::size_t i = first; i < last; ++i) patch_.push_back(pieces_[i].facet);
      std::sort(patch_.begin(), patch_.end());
      patch_.erase(std::unique(patch_.begin(), patch_.end()), patch_.end());
      return exterior.add_surface(patch_);
    };
    const auto on_edge = [&](std::size_t i) {
      std::array<Vec3, 2> ends;
      return common_edge(facet(i), facet(i + 1), ends) ? exterior.add_line({ends[0], ends[0], ends[1]})
                                                       : on_surface(0, pieces_.size());
    };
    const std::size_t n = pieces_.size();
    if (!order(pieces_)) return on_surface(0, n);
    bool flat = true;
    std::size_t edges = 0, edge = 0;  // between surfaces; the last of them
    for (std::size_t i = 0; i + 1 < n; ++i) {
      if (facet(i).surface != facet(i + 1).surface) {
        ++edges;
        edge = i;
      }
      flat = flat && (pieces_[i].facet == pieces_[i + 1].facet || coplanar(facet(i), facet(i + 1)));
    }
    if (edges == 1) return on_edge(edge);
    if (edges == 0 && (flat || exterior.slides)) return on_surface(0, n);
    if (n % 2 == 1) return on_surface(n / 2, n / 2 + 1);
    const std::size_t middle = n / 2 - 1;
    const bool level =
        pieces_[middle].facet == pieces_[middle + 1].facet || coplanar(facet(middle), facet(middle + 1));
    return level ? on_surface(middle, middle + 2) : on_edge(middle);
  }
  // An old node whose faces on some surfaces went to a copy keeps to the others; without any it goes inside,
  // towards the hexes that keep it.
  void leave_exterior(LocalId node, std::span<const std::int32_t> items, std::uint8_t left) {
    const LocalId old = first_[at(node)];
    LocalId& hold = result_.mesh.exterior.hold_of[at(old)];
    if (hold == kNone || hold == Exterior::kKept) return;
    if (left != 0) {
      patch_.clear();
      for (const std::int32_t item : items)
        for (const int f : kCornerFaces[static_cast<std::size_t>(item % 8)]) {
          const LocalId facet = mesh_.exterior.facet_at(item / 8, f);
          if (facet != kNone && (face_sides(mesh_, item / 8, f) & left) != 0) patch_.push_back(facet);
        }
      std::sort(patch_.begin(), patch_.end());
      patch_.erase(std::unique(patch_.begin(), patch_.end()), patch_.end());
      if (!patch_.empty()) hold = result_.mesh.exterior.add_surface(patch_);
      return;
    }
    hold = kNone;
    const auto keeps = [&](std::int32_t item) {
      return corner_[at(item / 8)][static_cast<std::size_t>(item % 8)] == old;
    };
    const bool some_keep = std::any_of(items.begin(), items.end(), keeps);
    Vec3 sum;
    int count = 0;
    for (const std::int32_t item : items) {
      if (some_keep && !keeps(item)) continue;
      for (const LocalId n : mesh_.hexes[at(item / 8)]) sum += mesh_.position[at(n)];
      count += 8;
    }
    result_.mesh.position[at(old)] += rules_.offset * ((1.0 / count) * sum - mesh_.position[at(node)]);
  }
  // The faces of the new hexes that are parts of the old ones on the exterior.
  void follow_exterior() {
    Exterior& exterior = result_.mesh.exterior;
    for (const auto& [hex, face, facet] : mesh_.exterior.faces) {
      if (wrapped(hex, face)) {
        add_part({on_face({hex, face}), kTop}, facet);
        continue;
      }
      add_part({start_[at(hex)], face}, facet);
      const auto nodes = face_nodes(mesh_, {hex, face});
      for (std::size_t v = 0; v < 4; ++v) {
        const HexFace layer = layer_at({hex, face}, v);
        if (layer.hex == kNone) continue;
        const auto base = face_nodes(mesh_, layer);
        int side = 0;
        while (!is_edge(base, side, nodes[v], nodes[(v + 1) % 4])) ++side;
        add_part({on_face(layer), side}, facet);
      }
    }
    std::sort(exterior.faces.begin(), exterior.faces.end(), [](const ExteriorFace& a, const ExteriorFace& b) {
      return std::pair(a.hex, a.face) < std::pair(b.hex, b.face);
    });
  }

  void add_part(HexFace face, LocalId facet) {
    if (face.hex != kNone) result_.mesh.exterior.faces.push_back({face.hex, face.face, facet});
  }
  static bool is_edge(const std::array<LocalId, 4>& nodes, int v, LocalId a, LocalId b) {
    const LocalId p = nodes[static_cast<std::size_t>(v)], q = nodes[static_cast<std::size_t>(v + 1) % 4];
    return (p == a && q == b) || (p == b && q == a);
  }

  // The way from the node into its group or, where an interface runs through the group, along that, to the
  // middle of the hexes, faces or edges there.
  Vec3 inwards(LocalId node, LocalId copy) {
    const Vec3 p = mesh_.position[at(node)];
    find_interface(node);
    if (through_.faces == 0) return rules_.along_edges ? way_along_edges(node) : way_inside(node);
    if (!through_curve()) {
      result_.on_interface.push_back({copy, label_[at(group_[0] / 8)], false, unit(through_.normal)});
      return way_along_edges(node);
    }
    // Along the curve: the ends of its edges in the group.
    const std::vector<LocalId> ends = curve_ends();
    if (ends.empty()) {
      result_.on_interface.push_back({copy, label_[at(group_[0] / 8)], true, {}});
      return way_along_edges(node);
    }
    Vec3 sum, tangent;
    for (const LocalId n : ends) {
      const Vec3 way = mesh_.position[at(n)] - p;
      sum += way;
      tangent += dot(way, tangent) < 0 ? -way : way;
    }
    result_.on_interface.push_back(
        {copy, label_[at(group_[0] / 8)], true, ends.size() <= 2 ? unit(tangent) : Vec3{}});
    return (0.5 / static_cast<double>(ends.size())) * sum;
  }

  // Into the group and away from all its wrapped faces. Where the boundary of an input mesh bends inwards
  // long hexes on one side may outweigh the others: there the edges that leave the wrapped faces lead away.
  [[nodiscard]] Vec3 way_inside(LocalId node) {
    const Vec3 way = way_into_group(node);
    if (mesh_.exterior.empty()) return way;
    const double ahead = least_ahead(node, way);
    if (ahead > kAhead) return way;
    const Vec3 other = way_along_edges(node);
    if (least_ahead(node, other) <= ahead) return way;
    const double longest = 0.5 * kLongEdge * mesh_.unit(node) * mesh_.cell_size.x, length = norm(other);
    return length > longest ? (longest / length) * other : other;
  }
  // Smallest cosine between a way and the inward normals of the wrapped faces at the node.
  [[nodiscard]] double least_ahead(LocalId node, const Vec3& way) const {
    double least = 1;
    for (const std::int32_t item : group_)
      for (const int f : kCornerFaces[static_cast<std::size_t>(item % 8)]) {
        if (!wrapped(item / 8, f)) continue;
        const auto nodes = face_nodes(mesh_, {item / 8, f});
        const auto v = static_cast<std::size_t>(std::find(nodes.begin(), nodes.end(), node) - nodes.begin());
        const Vec3& p = mesh_.position[at(node)];
        const Vec3 outward = unit(
            cross(mesh_.position[at(nodes[(v + 1) % 4])] - p, mesh_.position[at(nodes[(v + 3) % 4])] - p));
        least = std::min(least, -dot(outward, unit(way)));
      }
    return least;
  }

  // Hexes of an input mesh may be much longer than wide. Towards their middle the copy would be so far ahead
  // of the node along a face that the layer there is sheared: long edges count as short ones.
  [[nodiscard]] Vec3 way_into_group(LocalId node) const {
    if (mesh_.exterior.empty()) return middle_of_group() - mesh_.position[at(node)];
    const double longest = kLongEdge * mesh_.unit(node) * mesh_.cell_size.x;
    Vec3 sum;
    for (const std::int32_t item : group_) {
      const Hex& hex = mesh_.hexes[at(item / 8)];
      for (const int c : kCornerNeighbours[static_cast<std::size_t>(item % 8)]) {
        const Vec3 edge = mesh_.position[at(hex[static_cast<std::size_t>(c)])] - mesh_.position[at(node)];
        const double length = norm(edge);
        sum += length > longest ? (longest / length) * edge : edge;
      }
    }
    return (0.5 / static_cast<double>(group_.size())) * sum;
  }
  [[nodiscard]] Vec3 middle_of_group() const {
    Vec3 sum;
    for (const std::int32_t item : group_)
      for (const LocalId n : mesh_.hexes[at(item / 8)]) sum += mesh_.position[at(n)];
    return (1.0 / (8.0 * static_cast<double>(group_.size()))) * sum;
  }

  // To the middle of the edges that leave the wrapped faces at the node; where there are none, to the middle
  // of the faces that are not wrapped. Of the interface only, where one runs through.
  [[nodiscard]] Vec3 way_along_edges(LocalId node) {
    inner_.clear();
    outer_.clear();
    Vec3 middle;
    int faces = 0;
    for (const std::int32_t item : group_)
      for (const int f : kCornerFaces[static_cast<std::size_t>(item % 8)]) {
        const HexFace face{item / 8, f};
        const bool outside = wrapped(face.hex, face.face);
        if (!outside && through_.faces > 0 && !on_interface(face)) continue;
        const auto nodes = face_nodes(mesh_, face);
        const auto v = static_cast<std::size_t>(std::find(nodes.begin(), nodes.end(), node) - nodes.begin());
        auto& ends = outside ? outer_ : inner_;
        ends.insert(ends.end(), {nodes[(v + 1) % 4], nodes[(v + 3) % 4]});
        if (outside) continue;
        for (const LocalId n : nodes) middle += 0.25 * mesh_.position[at(n)];
        ++faces;
      }
    const Vec3 p = mesh_.position[at(node)];
    std::sort(inner_.begin(), inner_.end());
    Vec3 sum;
    int edges = 0;
    for (std::size_t i = 0; i < inner_.size(); ++i) {
      if (i > 0 && inner_[i] == inner_[i - 1]) continue;
      if (std::find(outer_.begin(), outer_.end(), inner_[i]) != outer_.end()) continue;
      sum += mesh_.position[at(inner_[i])] - p;
      ++edges;
    }
    if (edges > 0) return (0.5 / edges) * sum;
    return (faces > 0 ? (1.0 / faces) * middle : middle_of_group()) - p;
  }

  // Whether a face that is not wrapped lies on an interface.
  [[nodiscard]] bool on_interface(HexFace face) const {
    const LocalId other = neighbours_[at(face.hex)][static_cast<std::size_t>(face.face)];
    if (other == kNone && !mesh_.exterior.empty())
      return mesh_.exterior.facet_at(face.hex, face.face) == kNone;
    return other == kNone ? face_sides(mesh_, face.hex, face.face) == 0
                          : mesh_.material[at(other)] != mesh_.material[at(face.hex)];
  }

  // Faces of the group at the node that are on an interface and not wrapped.
  void find_interface(LocalId node) {
    through_.clear();
    for (const std::int32_t item : group_) {
      const LocalId h = item / 8;
      for (const int f : kCornerFaces[static_cast<std::size_t>(item % 8)]) {
        if (wrapped(h, f) || !on_interface({h, f})) continue;
        const LocalId other = neighbours_[at(h)][static_cast<std::size_t>(f)];
        add_face(node, {h, f}, other == kNone ? kOutside : mesh_.material[at(other)]);
      }
    }
  }
  void add_face(LocalId node, HexFace face, std::int32_t beyond) {
    const auto nodes = face_nodes(mesh_, face);
    std::array<Vec3, 4> p;
    for (std::size_t v = 0; v < 4; ++v) p[v] = mesh_.position[at(nodes[v])];
    const std::int32_t here = mesh_.material[at(face.hex)];
    const Vec3 normal = unit(cross(p[2] - p[0], p[3] - p[1]));
    through_.normal += beyond == kOutside || here < beyond ? normal : -normal;
    ++through_.faces;
    for (std::size_t v = 0; v < 4; ++v)
      if (nodes[v] == node)
        for (const LocalId end : {nodes[(v + 1) % 4], nodes[(v + 3) % 4]}) {
          through_.beside.emplace_back(end, here);
          through_.beside.emplace_back(end, beyond);
        }
  }
  // Whether at least three materials meet at the node within the group.
  [[nodiscard]] bool through_curve() const {
    const std::int32_t a = through_.beside[0].second, b = through_.beside[1].second;
    return std::any_of(through_.beside.begin(), through_.beside.end(),
                       [&](const auto& entry) { return entry.second != a && entry.second != b; });
  }
  // Other ends of the edges where at least three materials meet, ascending.
  std::vector<LocalId> curve_ends() {
    auto& beside = through_.beside;
    std::sort(beside.begin(), beside.end());
    beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
    std::vector<LocalId> ends;
    for (std::size_t i = 0; i + 2 < beside.size(); ++i)
      if (beside[i].first == beside[i + 2].first && (ends.empty() || ends.back() != beside[i].first))
        ends.push_back(beside[i].first);
    return ends;
  }

  void make_hexes() {
    std::size_t count = 0;
    for (LocalId h = 0; h < mesh_.size(); ++h)
      if (kept(h)) count += 1 + static_cast<std::size_t>(std::popcount(wrapped_[at(h)]));
    HexMesh& out = result_.mesh;
    out.hexes.reserve(count);
    out.hex_id.reserve(count);
    out.hex_owner.reserve(count);
    out.layer.reserve(count);
    out.material.reserve(count);
    start_.assign(mesh_.hexes.size(), kNone);
    for (LocalId h = 0; h < mesh_.size(); ++h) {
      if (!kept(h)) continue;
      start_[at(h)] = out.size();
      add_hex(h, 0, corner_[at(h)]);
      for (int f = 0; f < 6; ++f) {
        if (!wrapped(h, f)) continue;
        Hex hex;  // bottom: the copies; top: the old quad
        for (std::size_t v = 0; v < 4; ++v) {
          const auto c = static_cast<std::size_t>(kFaces[static_cast<std::size_t>(f)][v]);
          hex[v] = corner_[at(h)][c];
          hex[v + 4] = first_[at(mesh_.hexes[at(h)][c])];
        }
        add_hex(h, f + 1, hex);
      }
    }
  }
  void add_hex(LocalId from, GlobalId which, const Hex& hex) {
    HexMesh& out = result_.mesh;
    out.hexes.push_back(hex);
    out.hex_id.push_back(kHexFactor * mesh_.hex_id[at(from)] + which);
    out.hex_owner.push_back(mesh_.hex_owner[at(from)]);
    out.layer.push_back(mesh_.layer[at(from)]);
    out.material.push_back(mesh_.material[at(from)]);
    if (!mesh_.hex_home.empty()) {
      out.hex_home.push_back(kHexFactor * mesh_.hex_home[at(from)] + which);
      out.hex_image.push_back(mesh_.hex_image[at(from)]);
    }
  }

  void forget_unused_nodes() {
    const std::vector<LocalId> index = drop_unused_nodes(result_.mesh);
    compact(result_.source, index);
    compact(result_.copied, index);
    for (InterfaceCopy& copy : result_.on_interface) copy.node = index[at(copy.node)];
    std::erase_if(result_.on_interface, [](const InterfaceCopy& copy) { return copy.node == kNone; });
  }

  // Neighbours of the new hexes, from those of the old ones.
  void connect() {
    FaceNeighbours& out = result_.neighbours;
    out.resize(result_.mesh.hexes.size());
    for (LocalId h = 0; h < mesh_.size(); ++h) {
      if (start_[at(h)] == kNone) continue;
      for (int f = 0; f < 6; ++f) {
        auto& of_old = out[at(start_[at(h)])][static_cast<std::size_t>(f)];
        if (!wrapped(h, f)) {
          const LocalId other = neighbours_[at(h)][static_cast<std::size_t>(f)];
          of_old = other == kNone                       ? kNone
                   : label_[at(other)] == label_[at(h)] ? start_[at(other)]
                                                        : beyond({h, f});
          continue;
        }
        of_old = on_face({h, f});
        auto& of_new = out[at(of_old)];
        for (int side = 0; side < 4; ++side)
          of_new[static_cast<std::size_t>(side)] = beside(h, f, static_cast<std::size_t>(side));
        of_new[kBottom] = start_[at(h)];
        of_new[kTop] = beyond({h, f});
      }
    }
  }
  // The new hex on a wrapped face; kNone where it is no part of the result.
  [[nodiscard]] LocalId on_face(HexFace face) const {
    if (start_[at(face.hex)] == kNone) return kNone;
    const unsigned before = wrapped_[at(face.hex)] & ((1U << face.face) - 1);
    return start_[at(face.hex)] + 1 + std::popcount(before);
  }
  // What lies beyond an old face.
  [[nodiscard]] LocalId beyond(HexFace face) const {
    const HexFace there = other_side(mesh_, neighbours_, face);
    if (there.hex == kNone) return kNone;
    return wrapped(there.hex, there.face) ? on_face(there) : start_[at(there.hex)];
  }
  // What it meets at its side over an edge of the old face: the new hex on the next wrapped face around the
  // edge.
  [[nodiscard]] LocalId beside(LocalId h, int face, std::size_t side) const {
    const auto nodes = face_nodes(mesh_, {h, face});
    const LocalId a = nodes[side], b = nodes[(side + 1) % 4];
    for (HexFace next = across_edge(mesh_, {h, face}, a, b);; next = across_edge(mesh_, next, a, b)) {
      if (wrapped(next.hex, next.face)) return on_face(next);
      next = other_side(mesh_, neighbours_, next);
      if (next.hex == kNone) return kNone;
    }
  }

  const HexMesh& mesh_;
  const FaceNeighbours& neighbours_;
  std::span<const std::int32_t> label_;
  std::span<const std::uint8_t> drop_;
  const PillowRules& rules_;
  GlobalId node_factor_;
  int kept_layers_;
  std::vector<std::uint8_t> wrapped_;      // per old hex: bit f where a new hex goes on face f
  std::vector<std::uint8_t> on_boundary_;  // per old node: on a wrapped face
  std::vector<LocalId> first_;             // per old node: its new number
  std::vector<Hex> corner_;                // per old hex: new node at each corner
  std::vector<LocalId> start_;  // per old hex: its new number, followed by those of the hexes on its faces
  std::vector<std::int32_t> group_;
  std::vector<LocalId> inner_, outer_;
  // An edge at a node of a face on the boundary: its other end, the new node that the hex takes there, the
  // sides that hold the face, whether a new hex has a face there over the edge.
  struct Rim {
    LocalId end, corner;
    std::uint8_t sides;
    bool at_layer;
  };
  std::vector<Rim> rim_;
  std::vector<Piece> pieces_, all_pieces_;
  std::vector<LocalId> patch_;
  std::vector<std::uint8_t> done_;
  InterfaceThrough through_;
  Pillowed result_;
};

}  // namespace

Pillowed pillow(const Comm& comm, const HexMesh& mesh, const FaceNeighbours& neighbours,
                std::span<const std::int32_t> label, std::span<const std::uint8_t> drop,
                const PillowRules& rules) {
  return Pillower(mesh, neighbours, label, drop, rules).run(comm);
}

std::vector<std::int32_t> surface_labels(const HexMesh& mesh, const FaceNeighbours& neighbours) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> pairs;
  std::vector<std::int32_t> label(mesh.hexes.size(), -1);
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h)
    for (const LocalId other : neighbours[h]) {
      if (other == kNone || mesh.material[at(other)] == mesh.material[h]) continue;
      const auto materials = std::minmax(mesh.material[h], mesh.material[at(other)]);
      label[h] = pairs.try_emplace(materials, static_cast<std::int32_t>(pairs.size())).first->second;
    }
  return label;
}

std::uint8_t sides_with_flat_hexes(const Comm& comm, const HexMesh& mesh) {
  unsigned found = 0;
  for (LocalId h = 0; h < mesh.size(); ++h) {
    if (mesh.layer[at(h)] != 0) continue;
    unsigned once = 0;
    for (int f = 0; f < 6; ++f) {
      const unsigned sides = face_sides(mesh, h, f);
      found |= once & sides;
      once |= sides;
    }
  }
  std::uint8_t sides = 0;
  for (unsigned bit = 1; bit <= kZmax; bit <<= 1)
    if (comm.max(std::int64_t{(found & bit) != 0}) == 1) sides |= static_cast<std::uint8_t>(bit);
  return sides;
}

}  // namespace sculpt
