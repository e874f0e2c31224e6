#include "sculpt/distribute/conformity.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <tuple>

#include "distribute/face_search.hpp"
#include "distribute/faces.hpp"
#include "distribute/id_index.hpp"
#include "distribute/node_ranks.hpp"
#include "sculpt/mesh/node_directory.hpp"

namespace sculpt {
namespace {

constexpr double kTolerance = 1e-6;
constexpr double kSamePlace = 1e-9;  // farther apart in units of the shortest edge is told as nearly

enum Kind : std::int32_t {
  kNodeTwice,
  kCrowded,
  kSameSide,
  kTwisted,
  kTwoNodes,
  kHanging,
  kHalfShared,
  kFine
};

// What may be told about the mesh; the smallest is.
struct Finding {
  std::int32_t kind = kFine;
  std::array<std::int32_t, 3> block{-1, -1, -1};  // of the elements
  std::array<GlobalId, 3> element{-1, -1, -1};
  std::array<GlobalId, 4> node{-1, -1, -1, -1};
  Vec3 place;
  double distance = 0;

  [[nodiscard]] auto order() const { return std::tie(kind, element, node, distance); }
  void take_smaller(const Finding& other) {
    if (other.order() < order()) *this = other;
  }
};

// Of a face of an element: without its corners.
struct Side {
  FaceNodes nodes;  // outward
  GlobalId element;
  std::int32_t block;
};

// How two faces with the same nodes run through them.
enum class Turn { kSame, kOpposite, kOther };
Turn turn(const FaceNodes& a, const FaceNodes& b) {
  const auto start = static_cast<std::size_t>(std::find(b.begin(), b.end(), a[0]) - b.begin());
  bool same = true, opposite = true;
  for (std::size_t v = 0; v < 4; ++v) {
    same = same && a[v] == b[(start + v) % 4];
    opposite = opposite && a[v] == b[(start + 4 - v) % 4];
  }
  return opposite ? Turn::kOpposite : same ? Turn::kSame : Turn::kOther;
}

// Whether it is one face of two elements as it should be; `best` learns if not. sides: ascending in element.
void judge(std::span<const Side> sides, Finding& best) {
  Finding f;
  f.node = sorted(sides[0].nodes);
  for (std::size_t i = 0; i < std::min<std::size_t>(3, sides.size()); ++i) {
    f.element[i] = sides[i].element;
    f.block[i] = sides[i].block;
  }
  if (sides.size() > 2) {
    f.kind = kCrowded;
  } else if (sides.size() == 2) {
    const Turn t = turn(sides[0].nodes, sides[1].nodes);
    f.kind = t == Turn::kOpposite ? kFine : t == Turn::kSame ? kSameSide : kTwisted;
  }
  if (f.kind != kFine) best.take_smaller(f);
}

class Conformity {
 public:
  Conformity(const Comm& comm, const ElementShare& share, const std::vector<std::int64_t>& block_ids)
      : comm_(comm), share_(share), block_ids_(block_ids) {}

  void run() {
    Finding best;
    look_for_repeated_nodes(best);
    agree(best);
    std::vector<LoneFace> exterior = match_faces(best);
    agree(best);
    place_corners(exterior);
    look_for_touches(exterior, best);
    agree(best);
    look_for_half_shared(exterior, best);
    agree(best);
  }

 private:
  void look_for_repeated_nodes(Finding& best) const {
    for (std::size_t e = 0; e < share_.corner.size(); ++e) {
      std::array<GlobalId, 8> nodes = share_.corner[e];
      std::sort(nodes.begin(), nodes.end());
      const auto twice = std::adjacent_find(nodes.begin(), nodes.end());
      if (twice == nodes.end()) continue;
      Finding f;
      f.kind = kNodeTwice;
      f.element[0] = share_.element[e];
      f.block[0] = share_.block[e];
      f.node[0] = *twice;
      best.take_smaller(f);
    }
  }

  // Answers with faces of one element; each is on one rank, which need not be that of the element.
  std::vector<LoneFace> match_faces(Finding& best) const {
    const IdIndex nodes(share_.corner);
    std::vector<std::uint8_t> elsewhere(nodes.ids().size(), 0);  // other ranks have elements there
    for (const NodeHolder& holder : NodeRanks(comm_, share_, nodes).others(nodes.ids()))
      elsewhere[at(holder.item)] = 1;
    const EvenParts ranges{share_.nodes, comm_.size()};
    std::vector<std::vector<Side>> out(static_cast<std::size_t>(comm_.size()));
    std::vector<Side> sides, exterior;
    const auto settle = [&](std::span<const Side> group) {
      judge(group, best);
      if (group.size() == 1) exterior.push_back(group[0]);
    };
    for_each_face(share_, nodes, [&](std::span<const LocalFace> faces) {
      sides.clear();
      for (const LocalFace& face : faces)
        sides.push_back({face_nodes(share_.corner[face.element()], face.face()),
                         share_.element[face.element()], share_.block[face.element()]});
      const FaceNodes& key = faces[0].key;
      const bool shared =
          std::all_of(key.begin(), key.end(), [&](GlobalId n) { return elsewhere[at(nodes.index(n))] != 0; });
      if (!shared) return settle(sides);
      auto& to = out[ranges.part_of(key[0])];
      to.insert(to.end(), sides.begin(), sides.end());
    });
    struct Met {
      FaceNodes key;
      Side side;
    };
    std::vector<Met> met;
    for (const auto& from : comm_.all_to_all(out))
      for (const Side& side : from) met.push_back({sorted(side.nodes), side});
    out = {};
    std::sort(met.begin(), met.end(), [](const Met& a, const Met& b) {
      return std::tie(a.key, a.side.element) < std::tie(b.key, b.side.element);
    });
    for (std::size_t i = 0; i < met.size();) {
      const std::size_t first = i;
      for (sides.clear(); i < met.size() && met[i].key == met[first].key; ++i) sides.push_back(met[i].side);
      settle(sides);
    }
    std::vector<LoneFace> faces;
    for (const Side& side : exterior) faces.push_back({side.nodes, side.element, side.block, 0, {}});
    return faces;
  }

  void place_corners(std::vector<LoneFace>& faces) const {
    std::vector<GlobalId> nodes;
    for (const LoneFace& face : faces) nodes.insert(nodes.end(), face.nodes.begin(), face.nodes.end());
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    const std::vector<Vec3> position = positions_of(comm_, share_, nodes);
    for (LoneFace& face : faces)
      for (std::size_t v = 0; v < 4; ++v)
        face.corner[v] = position[static_cast<std::size_t>(
            std::lower_bound(nodes.begin(), nodes.end(), face.nodes[v]) - nodes.begin())];
  }

  void look_for_touches(std::span<const LoneFace> exterior, Finding& best) const {
    for (const Touch& touch : touching_nodes(comm_, exterior, kTolerance)) {
      Finding f;
      f.place = touch.place;
      f.distance = touch.distance;
      if (touch.other >= 0) {
        f.kind = kTwoNodes;
        f.node[0] = std::min(touch.node, touch.other);
        f.node[1] = std::max(touch.node, touch.other);
      } else {
        f.kind = kHanging;
        f.node[0] = touch.node;
        f.element[0] = touch.element;
        f.block[0] = touch.block;
      }
      best.take_smaller(f);
    }
  }

  void look_for_half_shared(std::span<const LoneFace> exterior, Finding& best) const {
    struct Diagonal {
      GlobalId lo, hi;
      LoneFace face;
    };
    const EvenParts ranges{share_.nodes, comm_.size()};
    std::vector<std::vector<Diagonal>> out(static_cast<std::size_t>(comm_.size()));
    for (const LoneFace& face : exterior)
      for (std::size_t v = 0; v < 2; ++v) {
        const auto [lo, hi] = std::minmax(face.nodes[v], face.nodes[v + 2]);
        out[ranges.part_of(lo)].push_back({lo, hi, face});
      }
    std::vector<Diagonal> met;
    for (const auto& from : comm_.all_to_all(out)) met.insert(met.end(), from.begin(), from.end());
    const auto key = [](const Diagonal& d) { return std::pair(d.lo, d.hi); };
    std::sort(met.begin(), met.end(), [&](const Diagonal& a, const Diagonal& b) {
      return std::pair(key(a), a.face.element) < std::pair(key(b), b.face.element);
    });
    for (std::size_t i = 0; i < met.size(); ++i)
      for (std::size_t j = i + 1; j < met.size() && key(met[j]) == key(met[i]); ++j) {
        const LoneFace &a = met[i].face, &b = met[j].face;
        const Vec3 na = cross(a.corner[2] - a.corner[0], a.corner[3] - a.corner[1]),
                   nb = cross(b.corner[2] - b.corner[0], b.corner[3] - b.corner[1]);
        if (dot(na, nb) > -0.5 * norm(na) * norm(nb)) continue;
        Finding f;
        f.kind = kHalfShared;
        f.element = {a.element, b.element, -1};
        f.block = {a.block, b.block, -1};
        f.node = {met[i].lo, met[i].hi, -1, -1};
        f.place = a.corner[0];
        for (std::size_t v = 0; v < 4; ++v)
          if (a.nodes[v] == met[i].lo) f.place = a.corner[v];
        best.take_smaller(f);
      }
  }

  // Throws on all ranks when any of them found anything.
  void agree(Finding& best) const {
    for (const Finding& f : comm_.gather_all(best)) best.take_smaller(f);
    if (best.kind == kFine) return;
    if (best.kind <= kTwisted) best.place = place_of(best);
    throw AgreedError(text(best));
  }

  // The first node of the finding; the centre of its face when it has one.
  [[nodiscard]] Vec3 place_of(const Finding& f) const {
    const std::size_t count = f.node[3] >= 0 ? 4 : 1;
    const std::vector<Vec3> corner = positions_of(comm_, share_, std::span(f.node.data(), count));
    Vec3 sum;
    for (const Vec3& p : corner) sum += p;
    return (1 / static_cast<double>(count)) * sum;
  }

  [[nodiscard]] std::string element(const Finding& f, std::size_t i) const {
    const auto block = static_cast<std::size_t>(f.block[i]);
    return block < block_ids_.size() ? fmt::format("{} (block {})", f.element[i] + 1, block_ids_[block])
                                     : fmt::format("{}", f.element[i] + 1);
  }
  [[nodiscard]] std::string text(const Finding& f) const {
    const std::string place = fmt::format("({:.9g}, {:.9g}, {:.9g})", f.place.x, f.place.y, f.place.z);
    const std::string face = fmt::format("the face of nodes {}, {}, {}, {} around {}", f.node[0] + 1,
                                         f.node[1] + 1, f.node[2] + 1, f.node[3] + 1, place);
    switch (f.kind) {
      case kNodeTwice:
        return fmt::format("element {} uses node {} at {} twice; expected eight different nodes",
                           element(f, 0), f.node[0] + 1, place);
      case kCrowded:
        return fmt::format("elements {}, {} and {} share {}; expected two elements at most", element(f, 0),
                           element(f, 1), element(f, 2), face);
      case kSameSide:
        return fmt::format(
            "elements {} and {} lie on the same side of {}: they overlap, or one of them is "
            "inside out",
            element(f, 0), element(f, 1), face);
      case kTwisted:
        return fmt::format("elements {} and {} run through {} in different orders: one of them is twisted",
                           element(f, 0), element(f, 1), face);
      case kTwoNodes:
        return fmt::format("nodes {} and {} lie at {}the same place {} but are two nodes; merge them",
                           f.node[0] + 1, f.node[1] + 1, f.distance > kSamePlace ? "nearly " : "", place);
      case kHanging:
        return fmt::format(
            "node {} at {} lies in a face or on an edge of element {} but is no node of that "
            "face (a hanging node); the faces of neighbours must have the same four nodes",
            f.node[0] + 1, place, element(f, 0));
      default:
        return fmt::format(
            "elements {} and {} share opposite corners of a face, nodes {} and {} at {}, but "
            "not the whole face; the faces of neighbours must have the same four nodes",
            element(f, 0), element(f, 1), f.node[0] + 1, f.node[1] + 1, place);
    }
  }

  const Comm& comm_;
  const ElementShare& share_;
  const std::vector<std::int64_t>& block_ids_;
};

}  // namespace

void check_conformity(const Comm& comm, const ElementShare& share,
                      const std::vector<std::int64_t>& block_ids) {
  Conformity(comm, share, block_ids).run();
}

}  // namespace sculpt
