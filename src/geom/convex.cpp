#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geom/analytic_solid.hpp"
#include "geom/solid_input.hpp"
#include "sculpt/base/error.hpp"

namespace sculpt {
namespace {

constexpr double kTolerance = 1e-9;  // of the size; of sines
constexpr double kSharpest = 1e-6;   // sine: sharper corners tell the plane of a face too roughly

struct Face {
  Vec3 normal;                // outward unit vector
  double offset;              // of the plane: dot(normal, p) there
  std::vector<Vec3> corners;  // counter-clockwise, seen from outside
};

Box bounds_of(std::span<const Vec3> points) {
  Box box{points[0], points[0]};
  for (const Vec3& p : points)
    for (std::size_t d = 0; d < 3; ++d) {
      box.lo[d] = std::min(box.lo[d], p[d]);
      box.hi[d] = std::max(box.hi[d], p[d]);
    }
  return box;
}

Vec3 nearest_on_segment(const Vec3& a, const Vec3& b, const Vec3& p) {
  const double t = dot(p - a, b - a) / dot(b - a, b - a);
  return a + std::clamp(t, 0.0, 1.0) * (b - a);
}

class Convex final : public AnalyticSolid {
 public:
  Convex(std::vector<Face> faces, const Box& bounds) : AnalyticSolid(bounds), faces_(std::move(faces)) {}

  [[nodiscard]] bool contains(const Box& box) const override {
    return std::all_of(faces_.begin(), faces_.end(),
                       [&](const Face& face) { return farthest(face, box.lo, box.hi) <= face.offset; });
  }
  // Whether a plane of the solid or an axis parts them.
  [[nodiscard]] bool misses(const Box& box) const override {
    return std::any_of(faces_.begin(), faces_.end(),
                       [&](const Face& face) { return farthest(face, box.hi, box.lo) >= face.offset; }) ||
           AnalyticSolid::misses(box);
  }

 private:
  // The height of the corner of a box that is farthest along the normal; with the corners swapped, of the one
  // that is farthest back.
  [[nodiscard]] static double farthest(const Face& face, const Vec3& lo, const Vec3& hi) {
    Vec3 corner;
    for (std::size_t d = 0; d < 3; ++d) corner[d] = face.normal[d] > 0 ? hi[d] : lo[d];
    return dot(face.normal, corner);
  }

  void cut(const Vec3& from, const Vec3& direction, std::vector<Interval>& pieces) const override {
    Interval piece{-2 * radius(), 2 * radius()};
    for (const Face& face : faces_) {
      const double depth = face.offset - dot(face.normal, from), rate = dot(face.normal, direction);
      if (rate > 0)
        piece.hi = std::min(piece.hi, depth / rate);
      else if (rate < 0)
        piece.lo = std::max(piece.lo, depth / rate);
      else if (depth < 0)
        return;
    }
    if (piece.lo < piece.hi) pieces.push_back(piece);
  }

  [[nodiscard]] bool inside(const Vec3& p) const override { return contains({p, p}); }

  [[nodiscard]] Vec3 nearest(const Vec3& p) const override {
    Vec3 best;
    double least = std::numeric_limits<double>::infinity();
    for (const Face& face : faces_) {
      const Vec3 q = nearest_on(face, p);
      if (!(norm(q - p) < least)) continue;
      least = norm(q - p);
      best = q;
    }
    return best;
  }

  [[nodiscard]] static Vec3 nearest_on(const Face& face, const Vec3& p) {
    const Vec3 foot = p + (face.offset - dot(face.normal, p)) * face.normal;
    bool beside = false;
    for_sides(face, [&](const Vec3& a, const Vec3& b) {
      beside = beside || dot(cross(b - a, foot - a), face.normal) < 0;
    });
    return beside ? nearest_on_rim(face, p) : foot;
  }

  [[nodiscard]] static Vec3 nearest_on_rim(const Face& face, const Vec3& p) {
    Vec3 best = face.corners[0];
    for_sides(face, [&](const Vec3& a, const Vec3& b) {
      const Vec3 q = nearest_on_segment(a, b, p);
      if (norm(q - p) < norm(best - p)) best = q;
    });
    return best;
  }

  template <class Visit>
  static void for_sides(const Face& face, const Visit& visit) {
    const std::vector<Vec3>& corners = face.corners;
    for (std::size_t i = 0; i < corners.size(); ++i)
      visit(corners[i], corners[i + 1 < corners.size() ? i + 1 : 0]);
  }

  [[nodiscard]] double edge_distance(const Vec3& p) const override {
    double least = std::numeric_limits<double>::infinity();
    for (const Face& face : faces_) least = std::min(least, norm(nearest_on_rim(face, p) - p));
    return least;
  }

  [[nodiscard]] bool turns_little(const Vec3& p, double reach, double) const override {
    return std::count_if(faces_.begin(), faces_.end(),
                         [&](const Face& face) { return norm(nearest_on(face, p) - p) <= reach; }) <= 1;
  }

  std::vector<Face> faces_;
};

// Without the rounding of a direction along an axis.
Vec3 cleaned(const Vec3& normal) {
  constexpr double kRounding = 1e-14;
  Vec3 clean = normal;
  for (std::size_t d = 0; d < 3; ++d)
    if (std::fabs(clean[d]) < kRounding) clean[d] = 0;
  return direction_of(clean);
}

// The faces of the convex hull of a few points, and how many faces have each point.
class Hull {
 public:
  explicit Hull(std::span<const Vec3> points) : points_(points), faces_at_(points.size()) {
    const Box box = bounds_of(points);
    size_ = largest(box.hi - box.lo);
    for (std::size_t a = 0; a < points.size(); ++a)
      for (std::size_t b = a + 1; b < points.size(); ++b)
        for (std::size_t c = b + 1; c < points.size(); ++c) {
          const Vec3 normal = cross(points[b] - points[a], points[c] - points[a]);
          if (norm(normal) <= kSharpest * norm(points[b] - points[a]) * norm(points[c] - points[a])) continue;
          add_face(direction_of(normal), a);
          add_face(-direction_of(normal), a);
        }
  }

  // None when the points lie in a plane.
  [[nodiscard]] std::vector<Face>& faces() { return faces_; }
  // Euler: corners + faces = edges + 2, and every edge belongs to two faces.
  [[nodiscard]] bool is_closed() const {
    std::size_t sides = 0;
    for (const Face& face : faces_) sides += face.corners.size();
    return 2 * (points_.size() + faces_.size()) == sides + 4;
  }
  [[nodiscard]] std::size_t faces_at(std::size_t point) const { return faces_at_[point]; }

 private:
  // That through point a, if all points lie behind it and it is new.
  void add_face(const Vec3& normal, std::size_t a) {
    std::vector<std::size_t> members;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const double height = dot(normal, points_[i] - points_[a]);
      if (height > kTolerance * size_) return;
      if (height >= -kTolerance * size_) members.push_back(i);
    }
    if (members.size() == points_.size() || std::find(found_.begin(), found_.end(), members) != found_.end())
      return;
    for (const std::size_t i : members) ++faces_at_[i];
    faces_.push_back(face_of(cleaned(normal), members));
    found_.push_back(std::move(members));
  }

  [[nodiscard]] Face face_of(const Vec3& normal, std::span<const std::size_t> members) const {
    Face face{normal, dot(normal, points_[members[0]]), {}};
    Vec3 middle;
    for (const std::size_t i : members) {
      face.offset = std::max(face.offset, dot(normal, points_[i]));
      middle += points_[i];
      face.corners.push_back(points_[i]);
    }
    middle = (1 / static_cast<double>(members.size())) * middle;
    const Vec3 u = face.corners[0] - middle, v = cross(normal, u);
    const auto angle = [&](const Vec3& p) { return std::atan2(dot(v, p - middle), dot(u, p - middle)); };
    std::sort(face.corners.begin(), face.corners.end(),
              [&](const Vec3& p, const Vec3& q) { return angle(p) < angle(q); });
    return face;
  }

  std::span<const Vec3> points_;
  double size_;
  std::vector<std::vector<std::size_t>> found_;  // the points of each face
  std::vector<Face> faces_;
  std::vector<std::size_t> faces_at_;
};

std::unique_ptr<Shape> hull_of(std::string_view what, std::span<const Vec3> points) {
  if (points.size() < 4)
    throw Error(fmt::format("{} has {} corners, expected at least 4", what, points.size()));
  for (const Vec3& p : points) expect_finite(what, p);
  Hull hull(points);
  if (hull.faces().empty())
    throw Error(fmt::format("the corners of {} lie in one plane, expected a solid with volume", what));
  for (std::size_t i = 0; i < points.size(); ++i)
    if (hull.faces_at(i) < 3)
      throw Error(
          fmt::format("point {} of {}, ({} {} {}), is no corner of the convex hull of its points, "
                      "expected a convex solid",
                      i + 1, what, points[i].x, points[i].y, points[i].z));
  if (!hull.is_closed())
    throw Error(
        fmt::format("{} is too flat or has corners too close together to tell its faces, expected a "
                    "solid with distinct corners",
                    what));
  return std::make_unique<Convex>(std::move(hull.faces()), bounds_of(points));
}

// No direction leads to infinity within all half spaces. If one does, so does one along two of their planes,
// unless all of them are parallel to a line or a plane.
bool is_bounded(std::span<const HalfSpace> sides) {
  bool any = false;
  for (const HalfSpace& a : sides)
    for (const HalfSpace& b : sides) {
      const Vec3 along = cross(a.outward, b.outward);
      if (norm(along) <= kSharpest) continue;
      const auto stops = [&](const HalfSpace& s) { return dot(s.outward, along) > kTolerance * norm(along); };
      if (std::none_of(sides.begin(), sides.end(), stops)) return false;
      any = true;
    }
  return any;
}

// The corners of what all half spaces have in common, which is about as large as `size` and not far from
// `around`.
std::vector<Vec3> corners_of(std::span<const HalfSpace> sides, const Vec3& around, double size) {
  std::vector<double> heights;
  for (const HalfSpace& side : sides) heights.push_back(dot(side.outward, side.point - around));
  std::vector<Vec3> corners;
  const auto add = [&](const Vec3& p) {
    for (std::size_t i = 0; i < sides.size(); ++i)
      if (dot(sides[i].outward, p) > heights[i] + kTolerance * size) return;
    const auto same = [&](const Vec3& q) { return largest(q - (around + p)) <= 10 * kTolerance * size; };
    if (std::none_of(corners.begin(), corners.end(), same)) corners.push_back(around + p);
  };
  for (std::size_t a = 0; a < sides.size(); ++a)
    for (std::size_t b = a + 1; b < sides.size(); ++b)
      for (std::size_t c = b + 1; c < sides.size(); ++c) {
        const Vec3 bc = cross(sides[b].outward, sides[c].outward),
                   ca = cross(sides[c].outward, sides[a].outward),
                   ab = cross(sides[a].outward, sides[b].outward);
        const double volume = dot(sides[a].outward, bc);
        if (std::fabs(volume) > kSharpest)
          add((1 / volume) * (heights[a] * bc + heights[b] * ca + heights[c] * ab));
      }
  return corners;
}

}  // namespace

std::unique_ptr<Shape> box(const Vec3& p1, const Vec3& p2) {
  expect_finite("a corner of a box", p1);
  expect_finite("a corner of a box", p2);
  for (std::size_t d = 0; d < 3; ++d) expect_positive("a side of a box", std::fabs(p2[d] - p1[d]));
  std::vector<Vec3> corners;
  for (const double x : {p1.x, p2.x})
    for (const double y : {p1.y, p2.y})
      for (const double z : {p1.z, p2.z}) corners.push_back({x, y, z});
  return hull_of("a box", corners);
}

std::unique_ptr<Shape> polyhedron(std::span<const Vec3> points) { return hull_of("a polyhedron", points); }

std::unique_ptr<Shape> planes(std::span<const HalfSpace> sides) {
  std::vector<HalfSpace> unit_sides(sides.begin(), sides.end());
  double size = 0;
  for (HalfSpace& side : unit_sides) {
    expect_finite("a point of a plane", side.point);
    expect_finite("the normal of a plane", side.outward);
    if (!(norm(side.outward) > 0)) throw Error("the normal of a plane is (0 0 0), expected a direction");
    side.outward = direction_of(side.outward);
    size = std::max(size, largest(side.point - sides[0].point));
  }
  if (!is_bounded(unit_sides))
    throw Error(fmt::format("{} planes leave a way to infinity open, expected planes that enclose a solid",
                            sides.size()));
  // The points of the planes may lie far from the solid: a first look tells where it is.
  const std::vector<Vec3> rough = corners_of(unit_sides, sides[0].point, size);
  std::vector<Vec3> corners;
  if (!rough.empty()) {
    const Box bounds = bounds_of(rough);
    corners = corners_of(unit_sides, 0.5 * (bounds.lo + bounds.hi), largest(bounds.hi - bounds.lo));
  }
  if (corners.size() < 4)
    throw Error(
        fmt::format("{} planes enclose no volume, expected planes that enclose a solid", sides.size()));
  return hull_of("a solid between planes", corners);
}

}  // namespace sculpt
