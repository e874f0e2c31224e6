#pragma once
// What solids with simple formulas have in common: all answers follow from the pieces of one line, the
// nearest point of the surface, and the distance to the edges.
#include <cmath>
#include <vector>

#include "geom/line_pieces.hpp"
#include "sculpt/geom/shape.hpp"

namespace sculpt {

class AnalyticSolid : public Shape {
 public:
  [[nodiscard]] Box bounds() const final { return bounds_; }
  [[nodiscard]] bool contains(const Box& box) const override;
  [[nodiscard]] bool misses(const Box& box) const override;
  [[nodiscard]] bool is_gentle(const Box& box) const final;
  [[nodiscard]] bool has_edges(const Box& box) const final;
  [[nodiscard]] std::size_t steepest_axis(const Vec3& point) const final;
  [[nodiscard]] bool is_costly() const final { return true; }
  [[nodiscard]] std::optional<double> share_of(const Box& box) const final;
  void chords(std::size_t axis, double u, std::span<const double> v, ChordRow& row) const final;
  void line_chords(std::span<const Vec3> from, std::span<const Vec3> step, ChordRow& row) const final;
  [[nodiscard]] std::optional<Vec3> nearest_on_surface(const Vec3& p) const final { return nearest(p); }

 protected:
  explicit AnalyticSolid(const Box& bounds);

  // Adds the pieces of the line from + s * direction. The direction is a unit vector; `from` is the point of
  // the line nearest to the middle of the bounds, at most radius() away from it.
  virtual void cut(const Vec3& from, const Vec3& direction, std::vector<Interval>& pieces) const = 0;
  [[nodiscard]] virtual bool inside(const Vec3& p) const = 0;
  // The point of the surface nearest to p.
  [[nodiscard]] virtual Vec3 nearest(const Vec3& p) const = 0;
  // To the nearest edge or corner; infinite when there is none.
  [[nodiscard]] virtual double edge_distance(const Vec3& p) const = 0;
  // At most one face comes within `reach` of p, and it has no radius of curvature below `least_radius` there.
  [[nodiscard]] virtual bool turns_little(const Vec3& p, double reach, double least_radius) const = 0;

  // An empty list that keeps its storage from call to call.
  [[nodiscard]] static std::vector<double>& places_for_this_thread();
  // Of the ball around the bounds.
  [[nodiscard]] double radius() const { return radius_; }
  // How far beyond a face its crossings may lie: rounding.
  [[nodiscard]] double slack() const { return 1e-9 * radius_; }
  // Adds s if it is a number and not far outside.
  void add_place(double s, std::vector<double>& places) const {
    if (std::fabs(s) <= 2 * radius_) places.push_back(s);
  }
  // Adds what is inside between these places on a line, which include all its crossings with the surface and
  // may include others.
  void add_inside(const Vec3& from, const Vec3& direction, std::vector<double>& places,
                  std::vector<Interval>& pieces) const;

 private:
  template <class CutLine>
  void cut_lines(std::size_t lines, const CutLine& cut_one, ChordRow& row) const;
  void cut_line(const Vec3& from, const Vec3& step, LinePieces& pieces) const;

  Box bounds_;
  Vec3 middle_;
  double radius_;
};

}  // namespace sculpt
