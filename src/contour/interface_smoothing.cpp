#include "sculpt/contour/interface_smoothing.hpp"

#include <algorithm>

namespace sculpt {
namespace {

constexpr double kShrink = 0.5;              // share of the way in the shrinking pass of a pair
constexpr double kFarthest = 0.45;           // from the grid position, in cells per axis
constexpr double kFarthestProjected = 0.75;  // the same where nodes are held on the interface
constexpr double kSliding = 0.1;             // weight of a tangential deviation

class Smoother {
 public:
  Smoother(HexMesh& mesh, const Interfaces& faces, CurveRule rule) : mesh_(mesh), faces_(faces), rule_(rule) {
    std::vector<GlobalId> id;
    std::vector<std::int32_t> owner;
    x_.reserve(faces.nodes.size());
    for (std::size_t i = 0; i < faces.nodes.size(); ++i) {
      x_.push_back(mesh.position[at(faces.nodes[i])]);
      id.push_back(mesh.node_id[at(faces.nodes[i])]);
      owner.push_back(mesh.node_owner[at(faces.nodes[i])]);
      if (mesh.node_owner[at(faces.nodes[i])] == mesh.node_exchange.comm().rank())
        owned_.push_back(static_cast<LocalId>(i));
    }
    exchange_ = GhostExchange(mesh.node_exchange.comm(), id, owner);
  }

  // One Jacobi pass: every node goes `factor` of the way to where it wants to be. Rules that keep the shape
  // of a smooth curve by themselves have no part in the growing passes.
  void pass(double factor) {
    moved_ = x_;
    for (const LocalId i : owned_) moved_[at(i)] += factor * held_on_box(wish(at(i), factor < 0), sides(i));
    x_.swap(moved_);
    exchange_.copy_to_ghosts(x_);
  }

  void project(const std::vector<Crossing>& crossings) {
    for (const LocalId i : owned_) {
      Vec3& p = x_[at(i)];
      p += held_on_box(onto_interface(mesh_, faces_, crossings, at(i), p) - p, sides(i));
    }
    exchange_.copy_to_ghosts(x_);
  }

  // The result goes to the mesh, ghosts included.
  void finish() {
    for (std::size_t i = 0; i < x_.size(); ++i) mesh_.position[at(faces_.nodes[i])] = x_[i];
  }

 private:
  [[nodiscard]] const Vec3& position(LocalId i) const { return x_[at(i)]; }
  [[nodiscard]] std::uint8_t sides(LocalId i) const { return mesh_.box_sides[at(faces_.nodes[at(i)])]; }

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

  // Whether the curve is but the edge of one surface, on the box: it is smoothed as the surface is.
  [[nodiscard]] bool ends_surface(std::size_t i) const { return faces_.node_quads[i].size() == 2; }

  // The next node of the curve beyond b, coming from i; b itself at the end of the curve.
  [[nodiscard]] LocalId beyond(LocalId i, LocalId b) const {
    if (faces_.kind[at(b)] != NodeClass::kCurve) return b;
    const auto next = faces_.curve_neighbours[at(b)];
    return next[0] == i ? next[1] : next[0];
  }

  [[nodiscard]] Vec3 curve_wish(std::size_t node) const {
    const auto i = static_cast<LocalId>(node);
    const LocalId ia = faces_.curve_neighbours[node][0], ib = faces_.curve_neighbours[node][1];
    const Vec3 x = position(i), a = position(ia), b = position(ib);
    const Vec3 middle = 0.5 * (a + b);
    switch (rule_) {
      case CurveRule::kOff:
        return {};
      case CurveRule::kLinear:
        return middle - x;
      case CurveRule::kHermite: {
        // Hermite midpoint with tangents of one edge length (the report's 2.25, signs by orientation a to b).
        const LocalId pa = beyond(i, ia), pb = beyond(i, ib);
        const Vec3 da = pa == ia ? x - a : 0.5 * (x - position(pa)),
                   db = pb == ib ? b - x : 0.5 * (position(pb) - x);
        return middle + 0.25 * (da - db) - x;
      }
      case CurveRule::kAverageTangent: {
        // Mean of the two straight continuations over half the chord.
        const LocalId pa = beyond(i, ia), pb = beyond(i, ib);
        const double half = 0.5 * norm(b - a);
        const Vec3 ta = pa == ia ? unit(x - a) : unit(a - position(pa)),
                   tb = pb == ib ? unit(x - b) : unit(b - position(pb));
        return 0.5 * (a + half * ta + b + half * tb) - x;
      }
      case CurveRule::kCircle:
        return middle_of_arc(a, x, b) - x;
      case CurveRule::kNeighbourSurfaceNormal:
        return towards_surfaces(node, middle - x);
      case CurveRule::kVfrac: {
        const Vec3 along = unit(b - a);
        return dot(middle - x, along) * along;
      }
    }
    return {};
  }

  // The point of the circle through a, x, b halfway between a and b, on the side of x.
  [[nodiscard]] static Vec3 middle_of_arc(const Vec3& a, const Vec3& x, const Vec3& b) {
    const Vec3 chord = b - a, middle = 0.5 * (a + b);
    const double length = norm(chord);
    const Vec3 along = unit(chord), off = (x - middle) - dot(x - middle, along) * along;
    const double height = norm(off), s = dot(x - middle, along);
    if (height < 1e-12 * length) return middle;
    // Centre at middle + c * up, equidistant from a and x.
    const double c = (s * s + height * height - 0.25 * length * length) / (2 * height);
    return middle + (c + std::sqrt(c * c + 0.25 * length * length)) * unit(off);
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
    smoother.pass(kShrink);
    if (options.project)
      smoother.project(crossings);
    else
      smoother.pass(options.grow);
  }
  smoother.finish();
  const Vec3 in_cells{1 / mesh.cell_size.x, 1 / mesh.cell_size.y, 1 / mesh.cell_size.z};
  for (std::size_t i = 0; i < faces.nodes.size(); ++i) {
    Vec3& p = mesh.position[at(faces.nodes[i])];
    // On the box a node cannot follow a surface that ends short of it: there the side may not close up.
    const bool held = mesh.box_sides[at(faces.nodes[i])] != 0;
    const double farthest = options.project && !held ? kFarthestProjected : kFarthest;
    const Vec3 move = p - grid_position[i];
    const double most = largest(scaled(move, in_cells));
    if (most > farthest)
      p = grid_position[i] + held_on_box((farthest / most) * move, mesh.box_sides[at(faces.nodes[i])]);
  }
  mesh.node_exchange.copy_to_ghosts(mesh.position);
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
