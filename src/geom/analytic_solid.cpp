#include "geom/analytic_solid.hpp"

#include <algorithm>
#include <cmath>

#include "geom/largest_axis.hpp"
#include "geom/sheet_share.hpp"

namespace sculpt {
namespace {

Vec3 middle_of(const Box& box) { return 0.5 * (box.lo + box.hi); }
double half_diagonal(const Box& box) { return 0.5 * norm(box.hi - box.lo); }

bool apart(const Box& a, const Box& b) {
  for (std::size_t d = 0; d < 3; ++d)
    if (a.hi[d] <= b.lo[d] || b.hi[d] <= a.lo[d]) return true;
  return false;
}

}  // namespace

AnalyticSolid::AnalyticSolid(const Box& bounds)
    : bounds_(bounds), middle_(middle_of(bounds)), radius_(half_diagonal(bounds)) {}

bool AnalyticSolid::contains(const Box& box) const {
  const Vec3 middle = middle_of(box);
  return inside(middle) && norm(nearest(middle) - middle) >= half_diagonal(box);
}

bool AnalyticSolid::misses(const Box& box) const {
  if (apart(box, bounds_)) return true;
  const Vec3 middle = middle_of(box);
  return !inside(middle) && norm(nearest(middle) - middle) >= half_diagonal(box);
}

bool AnalyticSolid::is_gentle(const Box& box) const {
  constexpr double kBoxes = 2;  // in the least radius of curvature
  return turns_little(middle_of(box), half_diagonal(box), kBoxes * largest(box.hi - box.lo));
}

std::optional<double> AnalyticSolid::share_of(const Box& box) const {
  return has_edges(box) ? std::nullopt : sheet_share(*this, box);
}

bool AnalyticSolid::has_edges(const Box& box) const {
  return edge_distance(middle_of(box)) <= half_diagonal(box);
}

std::size_t AnalyticSolid::steepest_axis(const Vec3& point) const {
  Vec3 normal = nearest(point) - point;
  if (largest(normal) < 1e-9 * radius_) {  // on the surface: seen from a point beside it
    const Vec3 beside = point + 1e-6 * radius_ * Vec3{0.61, 0.57, 0.55};
    normal = nearest(beside) - beside;
  }
  return largest_axis(normal);
}

void AnalyticSolid::chords(std::size_t axis, double u, std::span<const double> v, ChordRow& row) const {
  Vec3 from, step;
  step[axis] = 1;
  from[(axis + 1) % 3] = u;
  const auto line = [&](std::size_t l, LinePieces& pieces) {
    from[(axis + 2) % 3] = v[l];
    cut_line(from, step, pieces);
  };
  cut_lines(v.size(), line, row);
}

void AnalyticSolid::line_chords(std::span<const Vec3> from, std::span<const Vec3> step, ChordRow& row) const {
  const auto line = [&](std::size_t l, LinePieces& pieces) { cut_line(from[l], step[l], pieces); };
  cut_lines(from.size(), line, row);
}

std::vector<double>& AnalyticSolid::places_for_this_thread() {
  thread_local std::vector<double> places;
  places.clear();
  return places;
}

template <class CutLine>
void AnalyticSolid::cut_lines(std::size_t lines, const CutLine& cut_one, ChordRow& row) const {
  thread_local LinePieces pieces;
  pieces.clear();
  for (std::size_t l = 0; l < lines; ++l) {
    cut_one(l, pieces);
    pieces.end_line();
  }
  pieces.append_to(row);
}

void AnalyticSolid::cut_line(const Vec3& from, const Vec3& step, LinePieces& pieces) const {
  const double length = norm(step);
  if (!(length > 0)) return;
  const Vec3 direction = (1 / length) * step;
  const double along = dot(middle_ - from, direction);
  const Vec3 near = from + along * direction;
  if (norm(near - middle_) > radius_) return;
  cut(near, direction, pieces.pieces());
  for (std::size_t i = pieces.line_begin(); i < pieces.pieces().size(); ++i) {
    Interval& piece = pieces.pieces()[i];
    piece = {(piece.lo + along) / length, (piece.hi + along) / length};
  }
}

void AnalyticSolid::add_inside(const Vec3& from, const Vec3& direction, std::vector<double>& places,
                               std::vector<Interval>& pieces) const {
  std::sort(places.begin(), places.end());
  bool open = false;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const double lo = places[i], hi = places[i + 1];
    if (!(lo < hi)) continue;
    const bool in = inside(from + 0.5 * (lo + hi) * direction);
    if (in && open) pieces.back().hi = hi;
    if (in && !open) pieces.push_back({lo, hi});
    open = in;
  }
}

}  // namespace sculpt
