#include "pipeline/interface_geometry.hpp"

namespace sculpt {
namespace {

constexpr double kSliding = 0.1;  // weight of a tangential deviation

// On a surface the normal deviation counts, on a curve all but the tangential one, at a vertex everything.
Weight weight_of(const InterfaceCopy& copy) {
  const double all = copy.on_curve ? 1 : kSliding, along = copy.on_curve ? kSliding - 1 : 1 - kSliding;
  const Vec3& v = copy.direction;
  return {all + along * v.x * v.x, along * v.x * v.y, along * v.x * v.z,
          all + along * v.y * v.y, along * v.y * v.z, all + along * v.z * v.z};
}

void add(Geometry& g, std::size_t node, const Vec3& target, const Weight& weight, bool on_curve) {
  g.index[node] = static_cast<LocalId>(g.target.size());
  g.target.push_back(target);
  g.weight.push_back(weight);
  g.on_curve.push_back(on_curve);
}

}  // namespace

Geometry interface_geometry(const Pillowed& pillowed, const Interfaces& faces,
                            const std::vector<Weight>& weights) {
  Geometry g;
  g.index.assign(pillowed.source.size(), kNone);
  for (std::size_t n = 0; n < pillowed.source.size(); ++n) {
    const LocalId entry = faces.index_of[at(pillowed.source[n])];
    if (entry == kNone || pillowed.copied[n]) continue;
    add(g, n, pillowed.mesh.position[n], weights[at(entry)], faces.kind[at(entry)] != NodeClass::kSurface);
  }
  return g;
}

Geometry followed(const Geometry& before, const Pillowed& pillowed) {
  Geometry g;
  g.index.assign(pillowed.source.size(), kNone);
  auto copy = pillowed.on_interface.begin();
  for (std::size_t n = 0; n < pillowed.source.size(); ++n) {
    if (copy != pillowed.on_interface.end() && at(copy->node) == n) {
      add(g, n, pillowed.mesh.position[n], weight_of(*copy), copy->on_curve);
      ++copy;
      continue;
    }
    const LocalId entry = before.index[at(pillowed.source[n])];
    if (entry == kNone || pillowed.copied[n]) continue;
    add(g, n, before.target[at(entry)], before.weight[at(entry)], before.on_curve[at(entry)] != 0);
  }
  return g;
}

}  // namespace sculpt
