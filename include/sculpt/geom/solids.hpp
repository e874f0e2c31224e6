#pragma once
// The analytic solids of diatom files (docs/shapes.md has their keywords). Lengths in the units of the input,
// angles in degrees. Solids without volume, and input that is no solid, throw Error, whose text says what was
// found and what is expected.
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "sculpt/base/vec3.hpp"
#include "sculpt/geom/shape.hpp"

namespace sculpt {

// A rotation and then a translation: local point p lies at origin + p.x axis[0] + p.y axis[1] + p.z axis[2].
struct Frame {
  Vec3 origin;
  std::array<Vec3, 3> axis{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  // unit vectors at right angles, right-handed
};

// The shape at another place: what is at p in the shape is where the frame puts the local point p.
[[nodiscard]] std::unique_ptr<Shape> moved(std::unique_ptr<Shape> shape, const Frame& frame);
// Without what lies in any of the others. Its nearest_on_surface() tells nothing where the nearest of all
// their surfaces is one that the others take away or cover.
[[nodiscard]] std::unique_ptr<Shape> difference(std::unique_ptr<Shape> from,
                                                std::vector<std::shared_ptr<const Shape>> removed);

[[nodiscard]] std::unique_ptr<Shape> ellipsoid(const Vec3& center, const Vec3& radii);
// Two opposite corners.
[[nodiscard]] std::unique_ptr<Shape> box(const Vec3& p1, const Vec3& p2);
// Between the ends of its axis; inner_radius > 0: a tube.
[[nodiscard]] std::unique_ptr<Shape> cylinder(const Vec3& end1, const Vec3& end2, double radius,
                                              double inner_radius);
// A cone or frustum with these radii at its ends; one of them may be 0.
[[nodiscard]] std::unique_ptr<Shape> cone(const Vec3& end1, const Vec3& end2, double radius1, double radius2);
// Around the axis through the center; major > minor: distance of the tube's middle from the center, and the
// tube's radius.
[[nodiscard]] std::unique_ptr<Shape> torus(const Vec3& center, const Vec3& axis, double major, double minor);
// The convex hull of at least four points that do not lie in one plane; every point must be a corner of it.
[[nodiscard]] std::unique_ptr<Shape> polyhedron(std::span<const Vec3> points);
struct HalfSpace {
  Vec3 point, outward;  // inside: behind the point, seen along the normal
};
// What is in all half spaces; it must be bounded.
[[nodiscard]] std::unique_ptr<Shape> planes(std::span<const HalfSpace> sides);
// A polygon without crossings in the half plane of an axis, turned around it: corners (distance from the
// axis, height above end1 along end1 - end2).
[[nodiscard]] std::unique_ptr<Shape> revolution(const Vec3& end1, const Vec3& end2,
                                                std::span<const std::array<double, 2>> polygon);
// A polygon without crossings, pushed along an axis from end1 to end2: corners (u, v) in the plane at end1
// across the axis, u along `u_axis` as far as that is across.
[[nodiscard]] std::unique_ptr<Shape> extrusion(const Vec3& end1, const Vec3& end2, const Vec3& u_axis,
                                               std::span<const std::array<double, 2>> polygon);

}  // namespace sculpt
