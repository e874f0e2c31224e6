#pragma once
// Solids: what the sampling of volume fractions asks of a shape. Pure geometry; lengths in the units of the
// input. Lines run parallel to an axis a; a line is given by its coordinates u on axis (a+1)%3 and v on axis
// (a+2)%3.
#include <cstddef>
#include <memory>
#include <optional>
#include <span>

#include "sculpt/base/vec3.hpp"
#include "sculpt/geom/chord_row.hpp"

namespace sculpt {

// A closed box with faces normal to the axes.
struct Box {
  Vec3 lo, hi;
};

// A closed solid. Immutable: several threads may ask at once.
class Shape {
 public:
  virtual ~Shape() = default;

  [[nodiscard]] virtual Box bounds() const = 0;
  // The whole box lies in the solid; may be false although it does, where the surface is within a diagonal of
  // the box. A box may be a point.
  [[nodiscard]] virtual bool contains(const Box& box) const = 0;
  // The box and the solid share no volume; may be false although they do not.
  [[nodiscard]] virtual bool misses(const Box& box) const = 0;
  // Whether few lines measure what lies in the box: the surface there turns little and has no edge.
  [[nodiscard]] virtual bool is_gentle(const Box& box) const = 0;
  // Whether the surface has edges or corners that reach the box; may be true although none does.
  [[nodiscard]] virtual bool has_edges(const Box& box) const = 0;
  // Whether lines through it take so long that boxes are better halved until it is gentle in them.
  [[nodiscard]] virtual bool is_costly() const { return false; }
  // The axis whose lines cross the surface near this point most steeply; the lowest one when several do.
  [[nodiscard]] virtual std::size_t steepest_axis(const Vec3& point) const = 0;
  // Adds to the row, in which as many lines are asked for as v is long, the pieces that the solid cuts from
  // the lines u, v[0], v[1], ... along an axis.
  virtual void chords(std::size_t axis, double u, std::span<const double> v, ChordRow& row) const = 0;
  // The same of any lines: pieces lo <= t <= hi of from + t * step. A line whose step has no length has no
  // piece. Both spans are as long as there are lines.
  virtual void line_chords(std::span<const Vec3> from, std::span<const Vec3> step, ChordRow& row) const = 0;
  // The point of the surface nearest to p, where the shape can tell it.
  [[nodiscard]] virtual std::optional<Vec3> nearest_on_surface(const Vec3& p) const {
    (void)p;
    return std::nullopt;
  }
  // The share of the box that lies in the solid, within 5e-4, where the shape can tell it faster than lines.
  [[nodiscard]] virtual std::optional<double> share_of(const Box& box) const {
    (void)box;
    return std::nullopt;
  }
  // A solid that is the same within the box and tells its chords there without a search: this one, or one
  // that is put into `storage` (which may hold what an earlier call has put there).
  [[nodiscard]] virtual const Shape& within(const Box& box, std::unique_ptr<Shape>& storage) const {
    (void)box;
    (void)storage;
    return *this;
  }
};

}  // namespace sculpt
