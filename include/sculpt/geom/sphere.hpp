#pragma once
// The ball as a Shape.
#include "sculpt/geom/shape.hpp"

namespace sculpt {

class Sphere final : public Shape {
 public:
  // radius > 0
  Sphere(const Vec3& center, double radius) : center_(center), radius_(radius) {}

  [[nodiscard]] Box bounds() const override;
  [[nodiscard]] bool contains(const Box& box) const override;
  [[nodiscard]] bool misses(const Box& box) const override;
  [[nodiscard]] std::size_t steepest_axis(const Vec3& point) const override;
  [[nodiscard]] bool is_gentle(const Box& box) const override;
  [[nodiscard]] bool has_edges(const Box&) const override { return false; }
  void chords(std::size_t axis, double u, std::span<const double> v, ChordRow& row) const override;
  void line_chords(std::span<const Vec3> from, std::span<const Vec3> step, ChordRow& row) const override;
  // Nothing at the centre.
  [[nodiscard]] std::optional<Vec3> nearest_on_surface(const Vec3& p) const override;

 private:
  Vec3 center_;
  double radius_;
};

}  // namespace sculpt
