#pragma once
// The trilinear map of a hex: lines through it and boxes in its guise. Pure.
#include <array>
#include <optional>

#include "sculpt/geom/hex.hpp"
#include "sculpt/geom/shape.hpp"

namespace sculpt {

// The lines of a hex along which one of its parameters, all of them in [0,1], varies and the other two stay.
// They are straight.
class HexLines {
 public:
  // axis: the parameter that varies. Parameter 0 leads from corner 0 to 1, 1 from 0 to 3, 2 from 0 to 4.
  HexLines(const HexCorners& p, std::size_t axis);

  // The point from + t * step, where the Jacobian determinant is a + b t + c t^2.
  struct Line {
    Vec3 from, step;
    double a, b, c;
    // Of the hex between 0 and t, per unit of the parameters that stay. Ascends where the Jacobian is
    // positive.
    [[nodiscard]] double volume(double t) const { return t * (a + t * (b / 2 + t * (c / 3))); }
  };
  // u: parameter (axis+1)%3, v: parameter (axis+2)%3.
  [[nodiscard]] Line at(double u, double v) const;

 private:
  std::array<Vec3, 4> from_, step_;  // coefficients of 1, u, v, u v
};

// The edges of the parallelepiped that is closest to the hex: the derivatives at its centre.
[[nodiscard]] std::array<Vec3, 3> mean_edges(const HexCorners& p);
[[nodiscard]] Vec3 centre_of(const HexCorners& p);  // average of the corners
[[nodiscard]] Box bounds_of(const HexCorners& p);
// Whether the hex is a box with faces normal to the axes, whichever of its corners comes first: no coordinate
// is farther from those of the bounds than the tolerance of its axis.
[[nodiscard]] bool is_box(const HexCorners& p, const Box& bounds, const Vec3& tolerance);

}  // namespace sculpt
