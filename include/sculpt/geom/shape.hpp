#pragma once
// Analytic solids: what the sampling of volume fractions asks of a shape. Pure geometry; lengths in the units
// of the input. Lines run parallel to an axis a; a line is given by its coordinates u on axis (a+1)%3 and v
// on axis (a+2)%3.
#include <cstddef>
#include <optional>
#include <span>

#include "sculpt/base/vec3.hpp"

namespace sculpt {

// A closed box with faces normal to the axes.
struct Box {
  Vec3 lo, hi;
};

// A convex solid.
class Shape {
 public:
  virtual ~Shape() = default;

  [[nodiscard]] virtual Box bounds() const = 0;
  // The whole box lies in the solid.
  [[nodiscard]] virtual bool contains(const Box& box) const = 0;
  // The box and the solid share no volume; may be false although they do not.
  [[nodiscard]] virtual bool misses(const Box& box) const = 0;
  // The axis whose lines cross the surface near this point most steeply; the lowest one when several do.
  [[nodiscard]] virtual std::size_t steepest_axis(const Vec3& point) const = 0;
  // The pieces [lo, hi] that the solid cuts from the lines u, v[0], v[1], ... along an axis; lo >= hi: none.
  // The three spans are equally long.
  virtual void chords(std::size_t axis, double u, std::span<const double> v, std::span<double> lo,
                      std::span<double> hi) const = 0;
  // The same of any lines: the pieces lo <= t <= hi of from + t * step. A line whose step has no length has
  // no piece. The four spans are equally long.
  virtual void line_chords(std::span<const Vec3> from, std::span<const Vec3> step, std::span<double> lo,
                           std::span<double> hi) const = 0;
  // The point of the surface nearest to p, where the shape can tell it in closed form.
  [[nodiscard]] virtual std::optional<Vec3> nearest_on_surface(const Vec3& p) const {
    (void)p;
    return std::nullopt;
  }
};

}  // namespace sculpt
