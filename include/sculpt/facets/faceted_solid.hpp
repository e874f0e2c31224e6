#pragma once
// The inside of a surface of facets as a Shape: where the surface goes round a point at least once. Parts of
// the surface may overlap; one inside another with its normals inwards makes the solid hollow. Where the
// surface has a hole, only what is near the hole suffers.
#include <array>
#include <memory>

#include "sculpt/facets/facet_mesh.hpp"
#include "sculpt/geom/shape.hpp"

namespace sculpt {

class FacetTree;

class FacetedSolid final : public Shape {
 public:
  // Of a repaired surface that is not empty.
  explicit FacetedSolid(const FacetMesh& mesh);
  // Only the bounds are known, until become() is called.
  explicit FacetedSolid(const Box& bounds) : bounds_(bounds) {}

  // What answers all questions within a region, as bytes for another process.
  [[nodiscard]] std::vector<char> part(const Box& region) const;
  // Takes on what part() gave. Nobody may ask meanwhile.
  void become(std::span<const char> part);

  // Turns the solid about the origin: a point p comes to (p . axes[0], p . axes[1], p . axes[2]). All its
  // facets are known. Nobody may ask meanwhile.
  void turn(const std::array<Vec3, 3>& axes);

  [[nodiscard]] Box bounds() const override { return bounds_; }
  [[nodiscard]] bool contains(const Box& box) const override;
  [[nodiscard]] bool misses(const Box& box) const override;
  [[nodiscard]] bool is_gentle(const Box& box) const override;
  [[nodiscard]] bool has_edges(const Box& box) const override;
  [[nodiscard]] std::size_t steepest_axis(const Vec3& point) const override;
  // Use within(): this looks for the facets at every call.
  void chords(std::size_t axis, double u, std::span<const double> v, ChordRow& row) const override;
  // Pieces of 0 <= t <= 1 only.
  void line_chords(std::span<const Vec3> from, std::span<const Vec3> step, ChordRow& row) const override;
  [[nodiscard]] std::optional<Vec3> nearest_on_surface(const Vec3& p) const override;
  [[nodiscard]] const Shape& within(const Box& box, std::unique_ptr<Shape>& storage) const override;

 private:
  Box bounds_;
  std::shared_ptr<const FacetTree> tree_;
};

}  // namespace sculpt
