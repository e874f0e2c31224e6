#include "pipeline/interface_geometry.hpp"

#include <memory>
#include <utility>

namespace sculpt {
namespace {

static_assert(kSliding == Geometry::kSliding, "the smoother reads the weights of the contour");

// On a surface the normal deviation counts, on a curve all but the tangential one, at a vertex everything.
Weight weight_of(const InterfaceCopy& copy) {
  const double all = copy.on_curve ? 1 : kSliding, along = copy.on_curve ? kSliding - 1 : 1 - kSliding;
  const Vec3& v = copy.direction;
  return {all + along * v.x * v.x, along * v.x * v.y, along * v.x * v.z,
          all + along * v.y * v.y, along * v.y * v.z, all + along * v.z * v.z};
}

void add(Geometry& g, std::size_t node, const Vec3& target, const Weight& weight, bool on_curve,
         LocalId origin, std::int32_t surface) {
  g.index[node] = static_cast<LocalId>(g.target.size());
  g.target.push_back(target);
  g.weight.push_back(weight);
  g.on_curve.push_back(on_curve);
  g.origin.push_back(origin);
  g.surface.push_back(surface);
}

}  // namespace

Geometry interface_geometry(const Pillowed& pillowed, const Interfaces& faces,
                            const std::vector<Weight>& weights) {
  Geometry g;
  g.index.assign(pillowed.source.size(), kNone);
  for (std::size_t n = 0; n < pillowed.source.size(); ++n) {
    const LocalId entry = faces.index_of[at(pillowed.source[n])];
    if (entry == kNone || pillowed.copied[n]) continue;
    add(g, n, pillowed.mesh.position[n], weights[at(entry)], faces.kind[at(entry)] != NodeClass::kSurface,
        entry, kNone);
  }
  return g;
}

Geometry followed(const Geometry& before, const Pillowed& pillowed, std::span<const std::int32_t> captured) {
  Geometry g;
  g.contour = before.contour;
  g.on_surface = before.on_surface;
  g.index.assign(pillowed.source.size(), kNone);
  auto copy = pillowed.on_interface.begin();
  for (std::size_t n = 0; n < pillowed.source.size(); ++n) {
    if (copy != pillowed.on_interface.end() && at(copy->node) == n) {
      const bool tied = !captured.empty() && !copy->on_curve;
      add(g, n, pillowed.mesh.position[n], weight_of(*copy), copy->on_curve, kNone,
          tied ? captured[at(copy->label)] : kNone);
      ++copy;
      continue;
    }
    const LocalId entry = before.index[at(pillowed.source[n])];
    if (entry == kNone || pillowed.copied[n]) continue;
    add(g, n, before.target[at(entry)], before.weight[at(entry)], before.on_curve[at(entry)] != 0,
        before.origin[at(entry)], before.surface[at(entry)]);
  }
  return g;
}

void hold(Geometry& geometry, HeldInterface interface) {
  geometry.on_surface = [features = interface.capture.geometry](std::int32_t surface, const Vec3& p) {
    return features->on_surface(surface, p).value_or(p);
  };
  const auto held = std::make_shared<const HeldInterface>(std::move(interface));
  const auto quadrics = std::make_shared<std::vector<Quadric>>();
  if (held->quadrics)
    for (std::size_t i = 0; i < held->faces.nodes.size(); ++i)
      quadrics->push_back(surface_quadric(held->cells, held->faces, i, [&](LocalId other) {
        return held->cells.position[at(held->faces.nodes[at(other)])];
      }));
  geometry.contour = [held, quadrics](LocalId i, const Vec3& target, const Vec3& p) {
    if (held->capture.geometry)
      if (const std::optional<Vec3> tied = held->capture.onto(at(i), p)) return *tied;
    const bool on_surface = held->faces.kind[at(i)] == NodeClass::kSurface;
    if (held->quadrics) return on_surface ? onto_quadric((*quadrics)[at(i)], p) : target;
    const Vec3 point = onto_geometry(held->cells, held->faces, held->crossings, held->exact, at(i), p);
    // Planes that hardly cut each other meet far away.
    return on_surface
               ? point
               : within_reach(held->cells, held->faces.nodes[at(i)], held->grid_position[at(i)], point);
  };
}

}  // namespace sculpt
