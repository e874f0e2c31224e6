#include "input/diatom_shapes.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sculpt/base/error.hpp"
#include "sculpt/geom/sphere.hpp"

namespace sculpt {
namespace {

using enum ParameterKind;
using enum ParameterNeed;

constexpr double kLargest = 1e50;  // of coordinates: their cubes are numbers, too

Vec3 point(std::span<const double> numbers, std::size_t at = 0) {
  return {numbers[at], numbers[at + 1], numbers[at + 2]};
}

std::vector<Vec3> points(const ShapeValues& values) {
  std::vector<Vec3> all;
  for (const std::vector<double>& value : values) all.push_back(point(value));
  return all;
}

std::vector<std::array<double, 2>> pairs(const std::vector<double>& numbers) {
  std::vector<std::array<double, 2>> all;
  for (std::size_t n = 0; n < numbers.size(); n += 2) all.push_back({numbers[n], numbers[n + 1]});
  return all;
}

std::unique_ptr<Shape> make_sphere(const ShapeValues& v) {
  return std::make_unique<Sphere>(point(v[0]), v[1][0]);
}
std::unique_ptr<Shape> make_ellipsoid(const ShapeValues& v) { return ellipsoid(point(v[0]), point(v[1])); }
std::unique_ptr<Shape> make_box(const ShapeValues& v) { return box(point(v[0]), point(v[1])); }
std::unique_ptr<Shape> make_cylinder(const ShapeValues& v) {
  return cylinder(point(v[0]), point(v[1]), v[2][0], v[3].empty() ? 0 : v[3][0]);
}
std::unique_ptr<Shape> make_cone(const ShapeValues& v) {
  return cone(point(v[0]), point(v[1]), v[2][0], v[3][0]);
}
std::unique_ptr<Shape> make_torus(const ShapeValues& v) {
  return torus(point(v[0]), point(v[1]), v[2][0], v[3][0]);
}
std::unique_ptr<Shape> make_polyhedron(const ShapeValues& v) { return polyhedron(points(v)); }
std::unique_ptr<Shape> make_parallelepiped(const ShapeValues& v) {
  const Vec3 corner = point(v[0]);
  std::vector<Vec3> corners{corner};
  for (std::size_t edge = 1; edge <= 3; ++edge) {
    const Vec3 along = point(v[edge]) - corner;
    for (std::size_t c = corners.size(); c-- > 0;) corners.push_back(corners[c] + along);
  }
  return polyhedron(corners);
}
std::unique_ptr<Shape> make_planes(const ShapeValues& v) {
  std::vector<HalfSpace> sides;
  for (std::size_t n = 0; n < v[0].size(); n += 6) sides.push_back({point(v[0], n), point(v[0], n + 3)});
  return planes(sides);
}
std::unique_ptr<Shape> make_revolution(const ShapeValues& v) {
  return revolution(point(v[0]), point(v[1]), pairs(v[2]));
}
std::unique_ptr<Shape> make_extrusion(const ShapeValues& v) {
  return extrusion(point(v[0]), point(v[1]), point(v[2]), pairs(v[3]));
}

std::vector<ShapeParameter> corner_points(std::span<const std::string_view> names) {
  std::vector<ShapeParameter> all;
  for (const std::string_view name : names) all.push_back({{name}, kPoint});
  return all;
}

std::vector<ShapeKind> table() {
  constexpr std::array<std::string_view, 9> kCorner{"p0", "p1", "p2", "p3", "p4", "p5", "p6", "p7", "p8"};
  const auto corners = std::span(kCorner);
  const ShapeParameter center{{"center", "centre", "ce"}, kPoint};
  const ShapeParameter end1{{"ce1"}, kPoint}, end2{{"ce2"}, kPoint};
  const ShapeParameter polygon{{"p", "point"}, kPair, kRepeated};
  return {
      {{"sphere"}, {center, {{"radius", "r"}, kLength}}, make_sphere},
      {{"ellipsoid"}, {center, {{"radii", "radius", "r"}, kRadii}}, make_ellipsoid, true},
      {{"box"}, {{{"p1"}, kPoint}, {{"p2"}, kPoint}}, make_box, true},
      {{"parallelepiped"}, corner_points(corners.first(4)), make_parallelepiped},
      {{"planes"}, {{{"plane"}, kPlane, kRepeated}}, make_planes},
      {{"cylinder"},
       {end1, end2, {{"radius", "r"}, kLength}, {{"ri"}, kLengthOrZero, kPerhaps}},
       make_cylinder},
      {{"cone"}, {end1, end2, {{"rad1", "r1"}, kLengthOrZero}, {{"rad2", "r2"}, kLengthOrZero}}, make_cone},
      {{"torus"},
       {center,
        {{"axis", "normal"}, kDirection},
        {{"major", "r1", "rad1"}, kLength},
        {{"minor", "r2", "rad2"}, kLength}},
       make_torus},
      {{"tet", "tetrahedron"}, corner_points(corners.subspan(1, 4)), make_polyhedron},
      {{"wedge"}, corner_points(corners.subspan(1, 6)), make_polyhedron},
      {{"hex", "hexahedron"}, corner_points(corners.subspan(1, 8)), make_polyhedron},
      {{"revolution", "r2d"}, {end1, end2, polygon}, make_revolution},
      {{"extrusion", "polygon"}, {end1, end2, {{"u", "uaxis"}, kDirection}, polygon}, make_extrusion},
      {{"stl"}, {{{"file"}, kFile}}},
  };
}

struct Layout {
  std::size_t count;
  std::string_view expected;
};

Layout layout(ParameterKind kind) {
  switch (kind) {
    case kLength:
    case kLengthOrZero:
      return {1, "1 number"};
    case kPair:
      return {2, "2 numbers (the coordinates of a corner)"};
    case kRadii:
      return {3, "3 numbers (the radii along x, y and z)"};
    case kPlane:
      return {6, "6 numbers (a point and a direction outwards)"};
    case kRotation:
      return {4, "4 or 7 numbers (degrees, a direction and perhaps a point of the axis)"};
    case kScale:
      return {1, "1 number"};
    case kFile:
      return {0, "the name of an STL file"};
    case kPoint:
    case kDirection:
    case kTranslation:
      break;
  }
  return {3, "3 numbers (x y z)"};
}

void expect_direction(std::string_view name, const Vec3& direction) {
  if (unit(direction) == Vec3{})
    throw Error(fmt::format("found direction {:g} {:g} {:g} after '{}', expected one with a length",
                            direction.x, direction.y, direction.z, name));
}

// One run of numbers of a parameter, in place.
void place(ParameterKind kind, const Placement& placement, std::span<double> numbers) {
  const auto put = [&](std::size_t at, const Vec3& p) {
    for (std::size_t d = 0; d < 3; ++d) numbers[at + d] = p[d];
  };
  if (kind == kPoint || kind == kPlane) put(0, placement.placed(point(numbers)));
  if (kind == kDirection) put(0, placement.turned(point(numbers)));
  if (kind == kPlane) put(3, placement.turned(point(numbers, 3)));
  if (kind == kLength || kind == kLengthOrZero || kind == kRadii || kind == kPair)
    for (double& number : numbers) number *= placement.scale;
}

}  // namespace

std::span<const ShapeKind> shape_kinds() {
  static const std::vector<ShapeKind> kinds = table();
  return kinds;
}

std::span<const ShapeParameter> placing_parameters() {
  static const std::vector<ShapeParameter> parameters{{{"rotate"}, kRotation, kRepeated},
                                                      {{"translate"}, kTranslation, kRepeated},
                                                      {{"scale"}, kScale, kRepeated}};
  return parameters;
}

std::string_view expected_numbers(ParameterKind kind) { return layout(kind).expected; }

bool takes(ParameterKind kind, std::size_t count) {
  return count == layout(kind).count || (kind == kRotation && count == 7);
}

void check_numbers(ParameterKind kind, std::string_view name, std::span<const double> numbers) {
  for (const double number : numbers)
    if (!std::isfinite(number))
      throw Error(fmt::format("found {} after '{}', expected finite numbers", number, name));
  if (kind == kLength || kind == kRadii || kind == kScale)
    for (const double number : numbers)
      if (!(number > 0)) throw Error(fmt::format("found {} {}, expected a value > 0", name, number));
  if (kind == kLengthOrZero && numbers[0] < 0)
    throw Error(fmt::format("found {} {}, expected a value >= 0", name, numbers[0]));
  if (kind == kDirection) expect_direction(name, point(numbers));
  if (kind == kPlane) expect_direction(name, point(numbers, 3));
  if (kind == kRotation) expect_direction(name, point(numbers, 1));
}

Placement placement_of(ParameterKind kind, std::span<const double> numbers) {
  if (kind == kTranslation) return translation(point(numbers));
  if (kind == kScale) return magnification(numbers[0]);
  return rotation(numbers[0], point(numbers, 1), numbers.size() > 4 ? point(numbers, 4) : Vec3{});
}

void check_placement(const Placement& placement) {
  if (!(placement.scale <= kLargest && placement.scale >= 1 / kLargest))
    throw Error(fmt::format("found scale {:g} in all, expected {:g} to {:g}", placement.scale, 1 / kLargest,
                            kLargest));
  if (!(largest(placement.frame.origin) <= kLargest))
    throw Error(fmt::format("found a move by {:g} in all, expected up to {:g}",
                            largest(placement.frame.origin), kLargest));
}

std::unique_ptr<Shape> make_solid(const ShapeKind& kind, ShapeValues values, const Placement& placement) {
  const bool from_elsewhere = kind.along_axes && placement.turns();
  const Placement before = from_elsewhere ? magnification(placement.scale) : placement;
  for (std::size_t p = 0; p < values.size(); ++p) {
    const std::size_t run = layout(kind.parameters[p].kind).count;
    for (std::size_t at = 0; at < values[p].size(); at += run)
      place(kind.parameters[p].kind, before, std::span(values[p]).subspan(at, run));
    for (const double number : values[p])
      if (!(std::fabs(number) <= kLargest))
        throw Error(fmt::format("found {:g}, expected coordinates and lengths up to {:g}", number, kLargest));
  }
  std::unique_ptr<Shape> solid = kind.make(values);
  return from_elsewhere ? moved(std::move(solid), placement.frame) : std::move(solid);
}

}  // namespace sculpt
