#include "sculpt/contour/interface_smoothing.hpp"

#include <algorithm>

#include "contour/curve_rules.hpp"
#include "sculpt/contour/quadric.hpp"

namespace sculpt {
namespace {

constexpr double kShrink = 0.5;                // share of the way in the shrinking pass of a pair
constexpr double kFarthest = 0.45;             // from the grid position, in cells per axis
constexpr double kFarthestFromContour = 0.55;  // by smoothing without projection, in cells
constexpr double kFarthestProjected = 0.75;    // the same where nodes are held on the interface
constexpr double kFarthestTied = 1;            // the same of tied nodes
constexpr double kRounding = 1e-12;            // shorter ways to the interface, in cells, are none

class Smoother {
 public:
  Smoother(HexMesh& mesh, const Interfaces& faces, CurveRule rule) : mesh_(mesh), faces_(faces), rule_(rule) {
    std::vector<GlobalId> id, home;
    std::vector<std::int32_t> owner;
    x_.reserve(faces.nodes.size());
    for (std::size_t i = 0; i < faces.nodes.size(); ++i) {
      x_.push_back(mesh.position[at(faces.nodes[i])]);
      id.push_back(mesh.node_id[at(faces.nodes[i])]);
      home.push_back(mesh.node_homes()[at(faces.nodes[i])]);
      owner.push_back(mesh.node_owner[at(faces.nodes[i])]);
      if (mesh.node_owner[at(faces.nodes[i])] == mesh.node_exchange.comm().rank())
        owned_.push_back(static_cast<LocalId>(i));
    }
    exchange_ = GhostExchange(mesh.node_exchange.comm(), id, owner, home);
  }

  // One Jacobi pass: every node goes `factor` of the way to where it wants to be. Rules that keep the shape
  // of a smooth curve by themselves have no part in the growing passes.
  void pass(double factor) {
    moved_ = x_;
    for (const LocalId i : owned_) moved_[at(i)] += held_at(i, x_[at(i)], factor * wish(at(i), factor < 0));
    x_.swap(moved_);
    share_positions(mesh_, exchange_, faces_.nodes, x_);
  }

  void project(const std::vector<Crossing>& crossings, const InterfaceSmoothing& options) {
    for (const LocalId i : owned_) {
      Vec3& p = x_[at(i)];
      std::optional<Vec3> to;
      if (options.tied) to = options.tied(at(i), p);
      if (!to && options.projection == SurfaceProjection::kInterface)
        to = onto_geometry(mesh_, faces_, crossings, options.exact, at(i), p);
      if (!to) continue;
      const Vec3 move = held_at(i, p, *to - p);
      if (largest(scaled(move, mesh_.per_cell(faces_.nodes[at(i)]))) > kRounding) p += move;
    }
    share_positions(mesh_, exchange_, faces_.nodes, x_);
  }

  // A shrinking pass after which nodes of surfaces go back to the quadric of where they and their neighbours
  // stood before it.
  void pass_on_quadrics(double factor) {
    moved_ = x_;
    for (const LocalId i : owned_) {
      Vec3& p = moved_[at(i)];
      p += held_at(i, p, factor * wish(at(i), false));
      if (faces_.kind[at(i)] == NodeClass::kSurface) p += held_at(i, p, onto_quadric(quadric_at(i), p) - p);
    }
    x_.swap(moved_);
    share_positions(mesh_, exchange_, faces_.nodes, x_);
  }

  // The result goes to the mesh, ghosts included.
  void finish() {
    for (std::size_t i = 0; i < x_.size(); ++i) mesh_.position[at(faces_.nodes[i])] = x_[i];
  }

 private:
  [[nodiscard]] const Vec3& position(LocalId i) const { return x_[at(i)]; }
  [[nodiscard]] Vec3 held_at(LocalId i, const Vec3& from, const Vec3& move) const {
    return held(mesh_, faces_.nodes[at(i)], from, move);
  }

  [[nodiscard]] Vec3 towards_mean(std::size_t i, std::span<const LocalId> of) const {
    Vec3 sum;
    for (const LocalId n : of) sum += position(n);
    return of.empty() ? Vec3{}
                      : (1.0 / static_cast<double>(of.size())) * sum - position(static_cast<LocalId>(i));
  }

  [[nodiscard]] Vec3 wish(std::size_t i, bool growing) const {
    if (faces_.kind[i] == NodeClass::kSurface) return towards_mean(i, faces_.neighbours[i]);
    if (rule_ == CurveRule::kOff) return {};
    if (faces_.kind[i] == NodeClass::kVertex) return 0.5 * towards_mean(i, faces_.curve_neighbours[i]);
    if (rule_ == CurveRule::kLinear || ends_surface(i)) return towards_mean(i, faces_.curve_neighbours[i]);
    return growing ? Vec3{} : curve_wish(i);
  }

  // Whether the curve is but the edge of one surface, on the box: it is smoothed as the surface is. Both its
  // edges have one quad then, the others, which are all but two, have two, and every quad has two edges at
  // the node.
  [[nodiscard]] bool ends_surface(std::size_t i) const {
    return faces_.node_quads[i].size() + 1 == faces_.neighbours[i].size();
  }

  // The next node of the curve beyond b, coming from i; b itself at the end of the curve.
  [[nodiscard]] LocalId beyond(LocalId i, LocalId b) const {
    if (faces_.kind[at(b)] != NodeClass::kCurve) return b;
    const auto next = faces_.curve_neighbours[at(b)];
    return next[0] == i ? next[1] : next[0];
  }

  [[nodiscard]] Vec3 curve_wish(std::size_t node) const {
    const auto i = static_cast<LocalId>(node);
    const LocalId a = faces_.curve_neighbours[node][0], b = faces_.curve_neighbours[node][1];
    const LocalId before = beyond(i, a), after = beyond(i, b);
    if (rule_ == CurveRule::kNeighbourSurfaceNormal)
      return towards_surfaces(node, 0.5 * (position(a) + position(b)) - position(i));
    return curve_move(rule_, {position(before), position(a), position(i), position(b), position(after),
                              before == a, after == b});
  }

  // Mean of the projections to the tangent planes of the surface nodes beside the curve.
  [[nodiscard]] Vec3 towards_surfaces(std::size_t i, const Vec3& otherwise) const {
    Vec3 sum;
    int count = 0;
    for (const LocalId n : faces_.neighbours[i]) {
      if (faces_.kind[at(n)] != NodeClass::kSurface) continue;
      const Vec3 normal = normal_at(n);
      sum += dot(position(n) - position(static_cast<LocalId>(i)), normal) * normal;
      ++count;
    }
    return count > 0 ? (1.0 / count) * sum : otherwise;
  }
  [[nodiscard]] Vec3 normal_at(LocalId i) const {
    Vec3 sum;
    for (const LocalId item : faces_.node_quads[at(i)]) {
      const auto& n = faces_.quads[at(item / 4)].node;
      std::array<Vec3, 4> p;
      for (std::size_t v = 0; v < 4; ++v) p[v] = position(faces_.index_of[at(n[v])]);
      sum += unit(cross(p[2] - p[0], p[3] - p[1]));
    }
    return unit(sum);
  }
  [[nodiscard]] Quadric quadric_at(LocalId i) const {
    return surface_quadric(mesh_, faces_, at(i), [this](LocalId n) { return position(n); });
  }

  HexMesh& mesh_;
  const Interfaces& faces_;
  CurveRule rule_;
  std::vector<Vec3> x_,
      moved_;               // positions by interface node: close together in memory, unlike those of the mesh
  GhostExchange exchange_;  // of interface nodes
  std::vector<LocalId> owned_;  // interface nodes of this rank
};

}  // namespace

void smooth_interface(HexMesh& mesh, const Interfaces& faces, const std::vector<Crossing>& crossings,
                      const std::vector<Vec3>& grid_position, const InterfaceSmoothing& options) {
  Smoother smoother(mesh, faces, options.curve);
  for (int pair = 0; pair < options.pairs; ++pair) {
    switch (options.projection) {
      case SurfaceProjection::kOff:
        smoother.pass(kShrink);
        smoother.pass(options.grow);
        break;
      case SurfaceProjection::kQuadric:
        smoother.pass_on_quadrics(kShrink);
        break;
      case SurfaceProjection::kInterface:
        smoother.pass(kShrink);
        smoother.project(crossings, options);
        break;
    }
    if (options.tied && options.projection != SurfaceProjection::kInterface)
      smoother.project(crossings, options);
  }
  std::vector<Vec3> placed;
  for (const LocalId n : faces.nodes) placed.push_back(mesh.position[at(n)]);
  smoother.finish();
  for (std::size_t i = 0; i < faces.nodes.size(); ++i) {
    const Vec3 in_cells = mesh.per_cell(faces.nodes[i]);
    Vec3& p = mesh.position[at(faces.nodes[i])];
    const bool tied = options.tied && options.tied(i, p);
    if (options.projection == SurfaceProjection::kOff && !tied) {
      const Vec3 way = p - placed[i];
      const double length = norm(scaled(way, in_cells));
      if (length > kFarthestFromContour)
        p = placed[i] + held(mesh, faces.nodes[i], placed[i], (kFarthestFromContour / length) * way);
    }
    // On the box a node cannot follow a surface that ends short of it: there the side may not close up.
    const bool on_side = mesh.box_sides[at(faces.nodes[i])] != 0;
    const double farthest = on_side                                               ? kFarthest
                            : tied                                                ? kFarthestTied
                            : options.projection == SurfaceProjection::kInterface ? kFarthestProjected
                                                                                  : kFarthest;
    const Vec3 move = p - grid_position[i];
    const double most = largest(scaled(move, in_cells));
    if (most > farthest)
      p = grid_position[i] + held(mesh, faces.nodes[i], grid_position[i], (farthest / most) * move);
  }
  share_positions(mesh);
}

Quadric surface_quadric(const HexMesh& mesh, const Interfaces& faces, std::size_t i,
                        const std::function<Vec3(LocalId)>& position) {
  const auto self = static_cast<LocalId>(i);
  Vec3 normal;
  std::vector<LocalId> ring;
  for (const LocalId item : faces.node_quads[i]) {
    const InterfaceQuad& q = faces.quads[at(item / 4)];
    std::array<Vec3, 4> p;
    for (std::size_t v = 0; v < 4; ++v) {
      const LocalId n = faces.index_of[at(q.node[v])];
      p[v] = position(n);
      if (n != self) ring.push_back(n);
    }
    const Vec3 across = unit(cross(p[2] - p[0], p[3] - p[1]));
    normal += mesh.material[at(q.cell[0])] < mesh.material[at(q.cell[1])] ? across : -across;
  }
  std::sort(ring.begin(), ring.end());  // ascending in global id
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  std::vector<Vec3> around;
  for (const LocalId n : ring) around.push_back(position(n));
  return fit_quadric(position(self), unit(normal), around);
}

std::vector<Weight> deviation_weights(const HexMesh& mesh, const Interfaces& faces) {
  std::vector<Weight> weights(faces.nodes.size());
  for (std::size_t i = 0; i < faces.nodes.size(); ++i) {
    double all = 1, along = 0;  // W = all I + along (v v^T)
    Vec3 v;
    if (faces.kind[i] == NodeClass::kSurface) {
      all = kSliding;
      along = 1 - kSliding;
      for (const LocalId item : faces.node_quads[i]) {
        const InterfaceQuad& q = faces.quads[at(item / 4)];
        const Vec3 normal = unit(cross(mesh.position[at(q.node[2])] - mesh.position[at(q.node[0])],
                                       mesh.position[at(q.node[3])] - mesh.position[at(q.node[1])]));
        v += mesh.material[at(q.cell[0])] < mesh.material[at(q.cell[1])] ? normal : -normal;
      }
      v = unit(v);
    } else if (faces.kind[i] == NodeClass::kCurve) {
      along = kSliding - 1;
      v = unit(mesh.position[at(faces.nodes[at(faces.curve_neighbours[i][1])])] -
               mesh.position[at(faces.nodes[at(faces.curve_neighbours[i][0])])]);
    }
    weights[i] = {all + along * v.x * v.x, along * v.x * v.y, along * v.x * v.z,
                  all + along * v.y * v.y, along * v.y * v.z, all + along * v.z * v.z};
  }
  return weights;
}

}  // namespace sculpt
