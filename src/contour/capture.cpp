#include "sculpt/contour/capture.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>
#include <utility>

namespace sculpt {
namespace {

constexpr double kReach = 1.5;  // in cells: what is farther away is not what the interface stands for
constexpr int kTidyRounds = 10;

class Capturer {
 public:
  Capturer(const HexMesh& mesh, Interfaces& faces, std::shared_ptr<const GeometryFeatures> geometry,
           std::int32_t only)
      : mesh_(mesh), faces_(faces), comm_(mesh.node_exchange.comm()), only_(only) {
    capture_.geometry = std::move(geometry);
    std::vector<GlobalId> ids;
    std::vector<std::int32_t> owner;
    for (const InterfaceQuad& q : faces.quads) {
      ids.push_back(8 * mesh.hex_id[at(q.cell[0])] + q.face);
      home_.push_back(8 * mesh.hex_homes()[at(q.cell[0])] + q.face);
      owner.push_back(mesh.hex_owner[at(q.cell[0])]);
    }
    exchange_ = GhostExchange(comm_, ids, owner, home_);
  }

  Capture run() {
    assign_surfaces();
    find_beside();
    for (int round = 0; round < kTidyRounds; ++round)
      if (!tidy()) break;
    divide_surfaces(mesh_, faces_, std::move(part_));
    tie_nodes();
    return std::move(capture_);
  }

 private:
  [[nodiscard]] bool owned(std::size_t quad) const {
    return mesh_.layer[at(faces_.quads[quad].cell[0])] == 0;
  }
  [[nodiscard]] bool near(const Vec3& p, const Vec3& q, LocalId node) const {
    return norm(scaled(q - p, mesh_.per_cell(node))) <= kReach;
  }

  void assign_surfaces() {
    part_.assign(faces_.quads.size(), kNone);
    for (std::size_t i = 0; i < part_.size(); ++i) {
      if (!owned(i)) continue;
      const InterfaceQuad& q = faces_.quads[i];
      Vec3 middle;
      for (const LocalId n : q.node) middle += 0.25 * mesh_.position[at(n)];
      const auto [a, b] = Interfaces::materials(mesh_, q);
      const auto found = capture_.geometry->nearest(middle, a, b);
      if (found && near(middle, found->point, q.node[0]) && (only_ == kNone || found->surface == only_))
        part_[i] = found->surface;
    }
    exchange_.copy_to_ghosts(part_);
  }

  // The quads beyond the edges of a quad, of the same two materials; kNone where there is not just one.
  void find_beside() {
    beside_.assign(faces_.quads.size(), {kNone, kNone, kNone, kNone});
    for (std::size_t i = 0; i < beside_.size(); ++i) {
      if (!owned(i)) continue;
      const auto& node = faces_.quads[i].node;
      for (std::size_t v = 0; v < 4; ++v) beside_[i][v] = across(i, node[v], node[(v + 1) % 4]);
    }
  }
  [[nodiscard]] LocalId across(std::size_t quad, LocalId a, LocalId b) const {
    LocalId other = kNone;
    for (const LocalId item : faces_.node_quads[at(faces_.index_of[at(a)])]) {
      const auto& node = faces_.quads[at(item / 4)].node;
      if (at(item / 4) == quad || std::find(node.begin(), node.end(), b) == node.end()) continue;
      if (other != kNone) return kNone;
      other = item / 4;
    }
    if (other == kNone) return kNone;
    const bool same = Interfaces::materials(mesh_, faces_.quads[at(other)]) ==
                      Interfaces::materials(mesh_, faces_.quads[quad]);
    return same ? other : kNone;
  }

  // A quad that juts out into another surface goes to it. Of two neighbours that want to go the one with the
  // smaller id does. Whether any quad of any rank wanted to.
  bool tidy() {
    std::vector<std::int32_t> wish(part_);
    std::int64_t wishes = 0;
    for (std::size_t i = 0; i < wish.size(); ++i)
      if (owned(i)) wishes += (wish[i] = wish_of(i)) != part_[i];
    if (comm_.sum(wishes) == 0) return false;
    exchange_.copy_to_ghosts(wish);
    std::vector<std::int32_t> next(part_);
    for (std::size_t i = 0; i < wish.size(); ++i) {
      if (!owned(i) || wish[i] == part_[i]) continue;
      const bool first = std::none_of(beside_[i].begin(), beside_[i].end(), [&](LocalId o) {
        return o != kNone && wish[at(o)] != part_[at(o)] && home_[at(o)] < home_[i];
      });
      if (first) next[i] = wish[i];
    }
    part_ = std::move(next);
    exchange_.copy_to_ghosts(part_);
    return true;
  }
  [[nodiscard]] std::int32_t wish_of(std::size_t quad) const {
    const std::int32_t own = part_[quad];
    const auto beside = [&](std::int32_t part) {
      return std::count_if(beside_[quad].begin(), beside_[quad].end(),
                           [&](LocalId o) { return o != kNone && part_[at(o)] == part; });
    };
    std::int32_t best = own;
    for (const LocalId o : beside_[quad]) {
      if (o == kNone || part_[at(o)] == kNone) continue;
      const auto count = beside(part_[at(o)]), most = beside(best);
      if (count > most || (count == most && best != own && part_[at(o)] < best)) best = part_[at(o)];
    }
    return beside(best) >= 3 && beside(own) <= 1 ? best : own;
  }

  void tie_nodes() {
    capture_.tie.resize(faces_.nodes.size());
    for (std::size_t i = 0; i < faces_.nodes.size(); ++i)
      if (mesh_.node_owner[at(faces_.nodes[i])] == comm_.rank()) tie_node(i);
    settle_claims();
    std::int64_t curves = 0, corners = 0;
    for (const Tie& tie : capture_.tie) {
      curves += tie.kind == Tie::Kind::kCurve;
      corners += tie.kind == Tie::Kind::kCorner;
    }
    capture_.curve_nodes = comm_.sum(curves);
    capture_.corner_nodes = comm_.sum(corners);
  }

  // The surfaces at a node, ascending; none where quads of several pairs of materials or quads without a
  // surface meet.
  [[nodiscard]] std::vector<std::int32_t> surfaces_at(std::size_t i) const {
    std::vector<std::int32_t> surfaces;
    const auto items = faces_.node_quads[i];
    const auto pair = Interfaces::materials(mesh_, faces_.quads[at(items[0] / 4)]);
    for (const LocalId item : items) {
      const std::int32_t part = faces_.part[at(item / 4)];
      if (part == kNone || Interfaces::materials(mesh_, faces_.quads[at(item / 4)]) != pair) return {};
      surfaces.push_back(part);
    }
    std::sort(surfaces.begin(), surfaces.end());
    surfaces.erase(std::unique(surfaces.begin(), surfaces.end()), surfaces.end());
    return surfaces;
  }

  void tie_node(std::size_t i) {
    const std::vector<std::int32_t> surfaces = surfaces_at(i);
    if (surfaces.empty()) return;
    const LocalId node = faces_.nodes[i];
    const Vec3& p = mesh_.position[at(node)];
    capture_.tie[i] = without_corner(surfaces, node);
    if (surfaces.size() < 3) return;
    const auto corner = capture_.geometry->at_corner(surfaces, p);
    if (corner && near(p, corner->point, node))
      claims_.push_back({corner->corner, norm(corner->point - p), mesh_.node_homes()[at(node)],
                         static_cast<LocalId>(i), corner->point});
  }
  // The nearest curve of two of the surfaces, or else the nearest surface.
  [[nodiscard]] Tie without_corner(const std::vector<std::int32_t>& surfaces, LocalId node) const {
    const Vec3& p = mesh_.position[at(node)];
    Tie tie;
    double least = std::numeric_limits<double>::infinity();
    const auto consider = [&](const std::optional<Vec3>& point, const Tie& as) {
      if (!point || !near(p, *point, node) || !(norm(*point - p) < least)) return;
      least = norm(*point - p);
      tie = as;
    };
    for (std::size_t a = 0; a < surfaces.size(); ++a)
      for (std::size_t b = a + 1; b < surfaces.size(); ++b)
        consider(capture_.geometry->on_curve(surfaces[a], surfaces[b], p),
                 {Tie::Kind::kCurve, surfaces[a], surfaces[b]});
    if (tie.kind != Tie::Kind::kFree) return tie;
    for (const std::int32_t s : surfaces)
      consider(capture_.geometry->on_surface(s, p), {Tie::Kind::kSurface, s});
    return tie;
  }

  // A node that wants a corner.
  struct Claim {
    std::int32_t corner;
    double distance;
    GlobalId node;
    LocalId index;  // interface node of the rank that made the claim
    Vec3 point;
    [[nodiscard]] auto order() const { return std::tuple(corner, distance, node); }
  };
  // Each corner goes to the nearest of the nodes that want it.
  void settle_claims() {
    std::vector<Claim> all = comm_.concatenate(claims_);
    std::sort(all.begin(), all.end(), [](const Claim& a, const Claim& b) { return a.order() < b.order(); });
    for (const Claim& mine : claims_) {
      const auto first =
          std::lower_bound(all.begin(), all.end(), mine.corner,
                           [](const Claim& c, std::int32_t corner) { return c.corner < corner; });
      if (first->node == mine.node)
        capture_.tie[at(mine.index)] = {Tie::Kind::kCorner, kNone, kNone, mine.point};
    }
  }

  const HexMesh& mesh_;
  Interfaces& faces_;
  const Comm& comm_;
  std::int32_t only_;
  std::vector<GlobalId> home_;  // per quad: its id, of images that of the original
  GhostExchange exchange_;      // of quads
  std::vector<std::int32_t> part_;
  std::vector<std::array<LocalId, 4>> beside_;  // per quad
  std::vector<Claim> claims_;
  Capture capture_;
};

}  // namespace

std::optional<Vec3> Capture::onto(std::size_t interface_node, const Vec3& p) const {
  const Tie& to = tie[interface_node];
  switch (to.kind) {
    case Tie::Kind::kSurface:
      return geometry->on_surface(to.a, p);
    case Tie::Kind::kCurve:
      return geometry->on_curve(to.a, to.b, p);
    case Tie::Kind::kCorner:
      return to.corner;
    default:
      return std::nullopt;
  }
}

Capture capture_geometry(const HexMesh& mesh, Interfaces& faces,
                         std::shared_ptr<const GeometryFeatures> geometry, std::int32_t only) {
  return Capturer(mesh, faces, std::move(geometry), only).run();
}

}  // namespace sculpt
