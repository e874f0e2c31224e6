#pragma once
// The facets of a solid within a box, as the solid's Shape there.
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "facets/facet_tree.hpp"
#include "sculpt/geom/shape.hpp"

namespace sculpt {

class FacetPatch final : public Shape {
 public:
  // Looks at another box, maybe of another solid.
  void look(const FacetTree& tree, const Box& box);

  [[nodiscard]] Box bounds() const override { return bounds_; }
  [[nodiscard]] bool contains(const Box& box) const override;
  [[nodiscard]] bool misses(const Box& box) const override;
  // All facets face about the same way.
  [[nodiscard]] bool is_gentle(const Box& box) const override;
  [[nodiscard]] bool has_edges(const Box& box) const override { return !is_gentle(box); }
  [[nodiscard]] std::size_t steepest_axis(const Vec3& point) const override;
  // Of the box that was looked at, unless parts of the surface overlap there.
  [[nodiscard]] std::optional<double> share_of(const Box& box) const override;
  // Pieces within the box.
  void chords(std::size_t axis, double u, std::span<const double> v, ChordRow& row) const override;
  // Pieces of 0 <= t <= 1; lines from there to there lie within the box.
  void line_chords(std::span<const Vec3> from, std::span<const Vec3> step, ChordRow& row) const override;
  [[nodiscard]] std::optional<Vec3> nearest_on_surface(const Vec3& p) const override;

 private:
  template <class Visit>
  void visit_lines(std::size_t axis, double u, std::span<const double> v, const Visit& visit) const;
  [[nodiscard]] bool overlaps_itself() const;
  [[nodiscard]] int change_along(const Vec3& from, const Vec3& to) const;
  [[nodiscard]] bool is_empty_within(const Box& box) const;

  Box box_, bounds_;
  std::vector<LocalId> found_;
  std::vector<Triangle> facets_;
  std::array<std::vector<FacetCrossing>, 3> beside_;  // along each axis, on the line through start_
  Vec3 start_;                                        // a point of the box
  int winding_ = 0;                                   // there
};

}  // namespace sculpt
