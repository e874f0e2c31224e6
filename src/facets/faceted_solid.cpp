#include "sculpt/facets/faceted_solid.hpp"

#include <algorithm>

#include "facets/facet_box.hpp"
#include "facets/facet_patch.hpp"
#include "facets/facet_tree.hpp"

namespace sculpt {

FacetedSolid::FacetedSolid(const FacetMesh& mesh)
    : bounds_(bounds_of(mesh)), tree_(std::make_shared<const FacetTree>(mesh)) {}

std::vector<char> FacetedSolid::part(const Box& region) const { return tree_->pack(region); }

void FacetedSolid::become(std::span<const char> part) { tree_ = std::make_shared<const FacetTree>(part); }

void FacetedSolid::turn(const std::array<Vec3, 3>& axes) {
  FacetMesh mesh = tree_->mesh();
  turn_facets(mesh, axes);
  tree_ = std::make_shared<const FacetTree>(mesh);
  bounds_ = tree_->bounds();
}

bool FacetedSolid::contains(const Box& box) const {
  return !tree_->is_reached(box) && tree_->winding(odd_point(box)) > 0;
}

bool FacetedSolid::misses(const Box& box) const {
  return !tree_->is_reached(box) && tree_->winding(odd_point(box)) <= 0;
}

bool FacetedSolid::is_gentle(const Box& box) const {
  std::unique_ptr<Shape> storage;
  return within(box, storage).is_gentle(box);
}

bool FacetedSolid::has_edges(const Box& box) const { return !is_gentle(box); }

std::size_t FacetedSolid::steepest_axis(const Vec3& point) const {
  const Vec3 normal = tree_->nearest(point) - point;
  std::size_t axis = 0;
  for (std::size_t d = 1; d < 3; ++d)
    if (std::fabs(normal[d]) > std::fabs(normal[axis])) axis = d;
  return axis;
}

void FacetedSolid::chords(std::size_t axis, double u, std::span<const double> v, ChordRow& row) const {
  if (v.empty()) return;
  const std::size_t axis_u = (axis + 1) % 3, axis_v = (axis + 2) % 3;
  const double margin = largest(bounds().hi - bounds().lo);
  const auto [least, most] = std::minmax_element(v.begin(), v.end());
  Box box = tree_->cube();
  box.lo[axis_u] = u - margin;
  box.hi[axis_u] = u + margin;
  box.lo[axis_v] = *least - margin;
  box.hi[axis_v] = *most + margin;
  std::unique_ptr<Shape> storage;
  within(box, storage).chords(axis, u, v, row);
}

void FacetedSolid::line_chords(std::span<const Vec3> from, std::span<const Vec3> step, ChordRow& row) const {
  if (from.empty()) return;
  Box box{from[0], from[0]};
  for (std::size_t l = 0; l < from.size(); ++l)
    for (std::size_t d = 0; d < 3; ++d) {
      box.lo[d] = std::min({box.lo[d], from[l][d], from[l][d] + step[l][d]});
      box.hi[d] = std::max({box.hi[d], from[l][d], from[l][d] + step[l][d]});
    }
  const double margin = largest(bounds().hi - bounds().lo);
  box.lo = box.lo - Vec3{margin, margin, margin};
  box.hi = box.hi + Vec3{margin, margin, margin};
  std::unique_ptr<Shape> storage;
  within(box, storage).line_chords(from, step, row);
}

std::optional<Vec3> FacetedSolid::nearest_on_surface(const Vec3& p) const { return tree_->nearest(p); }

const Shape& FacetedSolid::within(const Box& box, std::unique_ptr<Shape>& storage) const {
  auto* patch = dynamic_cast<FacetPatch*>(storage.get());
  if (patch == nullptr) {
    auto made = std::make_unique<FacetPatch>();
    patch = made.get();
    storage = std::move(made);
  }
  patch->look(*tree_, box);
  return *patch;
}

}  // namespace sculpt
