#pragma once
// Where a solid stands: scaled, turned and moved from where its numbers put it.
#include "sculpt/geom/solids.hpp"

namespace sculpt {

// Point p goes to origin + scale * (p.x axis[0] + p.y axis[1] + p.z axis[2]).
struct Placement {
  double scale = 1;  // > 0
  Frame frame;

  [[nodiscard]] Vec3 turned(const Vec3& direction) const {
    const auto& a = frame.axis;
    return direction.x * a[0] + direction.y * a[1] + direction.z * a[2];
  }
  [[nodiscard]] Vec3 placed(const Vec3& p) const { return frame.origin + turned(scale * p); }
  [[nodiscard]] bool turns() const { return frame.axis != Frame{}.axis; }
  // This placement of what `inner` has placed.
  [[nodiscard]] Placement after(const Placement& inner) const;
};

// About an axis, which has a length, through a point; quarter turns about the axes of the coordinates are
// exact.
[[nodiscard]] Placement rotation(double degrees, const Vec3& axis, const Vec3& through);
[[nodiscard]] Placement translation(const Vec3& by);
// About the origin of the coordinates.
[[nodiscard]] Placement magnification(double factor);

}  // namespace sculpt
