#include "facets/facet_patch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "facets/facet_box.hpp"
#include "facets/facet_share.hpp"

namespace sculpt {
namespace {

constexpr double kOneWay = 0.985;  // cosine of 10 degrees, between a facet and the mean of all
constexpr double kOddShare = 0.38196601125010515;  // of a line: a point that is hardly on a surface

struct Piece {
  std::size_t line;
  double lo, hi;
};

// Leaves the crossings between lo and hi, ascending.
void keep_between(std::vector<FacetCrossing>& crossings, double lo, double hi) {
  crossings.erase(std::remove_if(crossings.begin(), crossings.end(),
                                 [&](const FacetCrossing& c) { return !(lo < c.t && c.t < hi); }),
                  crossings.end());
  std::sort(crossings.begin(), crossings.end(), [](const FacetCrossing& a, const FacetCrossing& b) {
    return a.t != b.t ? a.t < b.t : a.exit < b.exit;
  });
}

// The pieces of one line between lo and hi whose winding number, `winding` at t = `from`, is positive.
void add_pieces(std::vector<FacetCrossing>& crossings, double from, int winding, const Piece& whole,
                std::vector<Piece>& pieces) {
  const auto [line, lo, hi] = whole;
  keep_between(crossings, lo, hi);
  for (const FacetCrossing& c : crossings) winding += change(c, from, lo);
  double start = lo;
  for (const FacetCrossing& c : crossings) {
    const bool was_inside = winding > 0;
    winding -= c.exit;
    const bool is_inside = winding > 0;
    if (was_inside && !is_inside && start < c.t) pieces.push_back({line, start, c.t});
    if (!was_inside && is_inside) start = c.t;
  }
  if (winding > 0 && start < hi) pieces.push_back({line, start, hi});
}

// Pieces, by ascending line, as layers of a row.
void add_layers(std::span<const Piece> pieces, std::size_t lines, ChordRow& row) {
  std::vector<std::size_t> next(lines + 1, 0);  // of each line
  for (const Piece& p : pieces) ++next[p.line + 1];
  std::size_t most = 0;
  for (std::size_t l = 0; l < lines; ++l) {
    most = std::max(most, next[l + 1]);
    next[l + 1] += next[l];
  }
  const std::vector<std::size_t> first = next;
  for (std::size_t n = 0; n < most; ++n) {
    const ChordRow::Layer layer = row.add_layer();
    for (std::size_t l = 0; l < lines; ++l) {
      const bool has = first[l] + n < first[l + 1];
      layer.lo[l] = has ? pieces[first[l] + n].lo : 0;
      layer.hi[l] = has ? pieces[first[l] + n].hi : 0;
    }
  }
}

// Calls visit(crossing) for the facets that a line from p with a direction meets, at its coordinate on the
// axis along which the direction is longest: the facets are pushed along the line onto a plane.
template <class Visit>
void cross_all(std::span<const Triangle> facets, std::size_t axis, const Vec3& p, const Vec3& direction,
               const Visit& visit) {
  const std::size_t axis_u = (axis + 1) % 3, axis_v = (axis + 2) % 3;
  const double per_u = direction[axis_u] / direction[axis], per_v = direction[axis_v] / direction[axis];
  for (Triangle facet : facets) {
    for (Vec3& corner : facet) {
      const double along = corner[axis] - p[axis];
      corner[axis_u] -= per_u * along;
      corner[axis_v] -= per_v * along;
    }
    if (const auto c = cross_line(facet, axis, p[axis_u], p[axis_v])) visit(*c);
  }
}

std::size_t longest_axis(const Vec3& a) {
  std::size_t axis = 0;
  for (std::size_t d = 1; d < 3; ++d)
    if (std::fabs(a[d]) > std::fabs(a[axis])) axis = d;
  return axis;
}

}  // namespace

void FacetPatch::look(const FacetTree& tree, const Box& box) {
  box_ = box;
  bounds_ = tree.bounds();
  tree.find(box, found_);
  start_ = odd_point(box);
  facets_.clear();
  for (auto& crossings : beside_) crossings.clear();
  for (const LocalId f : found_) {
    facets_.push_back(tree.facet(f));
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (const auto c = cross_line(facets_.back(), axis, start_[(axis + 1) % 3], start_[(axis + 2) % 3]))
        beside_[axis].push_back(*c);
  }
  winding_ = tree.winding(start_);
}

bool FacetPatch::is_empty_within(const Box& box) const {
  return std::none_of(facets_.begin(), facets_.end(), [&](const Triangle& f) { return reaches(f, box); });
}

bool FacetPatch::contains(const Box& box) const {
  return is_empty_within(box) && winding_ + change_along(start_, odd_point(box)) > 0;
}

bool FacetPatch::misses(const Box& box) const {
  return is_empty_within(box) && winding_ + change_along(start_, odd_point(box)) <= 0;
}

bool FacetPatch::is_gentle(const Box&) const {
  Vec3 mean;
  for (const Triangle& f : facets_) mean += cross(f[1] - f[0], f[2] - f[0]);
  const Vec3 way = unit(mean);
  return std::all_of(facets_.begin(), facets_.end(), [&](const Triangle& f) {
    const Vec3 normal = cross(f[1] - f[0], f[2] - f[0]);
    return dot(normal, way) >= kOneWay * norm(normal);
  });
}

std::size_t FacetPatch::steepest_axis(const Vec3&) const {
  Vec3 area;
  for (const Triangle& f : facets_) {
    const Vec3 normal = cross(f[1] - f[0], f[2] - f[0]);
    area += {std::fabs(normal.x), std::fabs(normal.y), std::fabs(normal.z)};
  }
  return longest_axis(area);
}

// Calls visit(l, crossings, winding) for the lines v[l]: all crossings, and the number where the line passes
// the start.
template <class Visit>
void FacetPatch::visit_lines(std::size_t axis, double u, std::span<const double> v,
                             const Visit& visit) const {
  const std::size_t axis_u = (axis + 1) % 3, axis_v = (axis + 2) % 3;
  // To the row, then along it, and from there along each line.
  int winding = winding_;
  for (const FacetCrossing& c : beside_[axis_u]) winding += change(c, start_[axis_u], u);
  std::vector<PlaneCut> cuts;
  std::vector<FacetCrossing> beside, crossings;
  for (const Triangle& f : facets_)
    if (const auto c = cut(f, axis, u)) {
      cuts.push_back(*c);
      if (const auto b = cross_t(*c, start_[axis])) beside.push_back(*b);
    }
  for (std::size_t l = 0; l < v.size(); ++l) {
    int here = winding;
    for (const FacetCrossing& c : beside) here += change(c, start_[axis_v], v[l]);
    crossings.clear();
    for (const PlaneCut& c : cuts)
      if (const auto crossing = cross_v(c, v[l])) crossings.push_back(*crossing);
    visit(l, crossings, here);
  }
}

void FacetPatch::chords(std::size_t axis, double u, std::span<const double> v, ChordRow& row) const {
  std::vector<Piece> pieces;
  visit_lines(axis, u, v, [&](std::size_t l, std::vector<FacetCrossing>& crossings, int winding) {
    add_pieces(crossings, start_[axis], winding, {l, box_.lo[axis], box_.hi[axis]}, pieces);
  });
  add_layers(pieces, v.size(), row);
}

// Whether the number is other than 0 and 1 somewhere, as lines show it.
bool FacetPatch::overlaps_itself() const {
  constexpr std::size_t kLines = 16;
  const auto at = [&](std::size_t axis, std::size_t l) {
    return box_.lo[axis] + (static_cast<double>(l) + 0.5) / kLines * (box_.hi[axis] - box_.lo[axis]);
  };
  std::array<double, kLines> z{};
  for (std::size_t l = 0; l < kLines; ++l) z[l] = at(2, l);
  bool overlaps = false;
  for (std::size_t row = 0; row < kLines && !overlaps; ++row)
    visit_lines(0, at(1, row), z, [&](std::size_t, std::vector<FacetCrossing>& crossings, int winding) {
      keep_between(crossings, box_.lo[0], box_.hi[0]);
      for (const FacetCrossing& c : crossings) winding += change(c, start_[0], box_.lo[0]);
      overlaps = overlaps || winding < 0 || winding > 1;
      for (const FacetCrossing& c : crossings) {
        winding -= c.exit;
        overlaps = overlaps || winding < 0 || winding > 1;
      }
    });
  return overlaps;
}

std::optional<double> FacetPatch::share_of(const Box& box) const {
  if (!(box.lo == box_.lo && box.hi == box_.hi)) return std::nullopt;
  // Facets that all look one way do not overlap: what is behind them is inside.
  if (!is_gentle(box) && overlaps_itself()) return std::nullopt;
  return std::clamp(mean_winding(facets_, box_, start_, winding_), 0.0, 1.0);
}

int FacetPatch::change_along(const Vec3& from, const Vec3& to) const {
  const Vec3 way = to - from;
  const std::size_t axis = longest_axis(way);
  if (!(std::fabs(way[axis]) > 0)) return 0;
  int sum = 0;
  cross_all(facets_, axis, from, way,
            [&](const FacetCrossing& c) { sum += change(c, from[axis], to[axis]); });
  return sum;
}

void FacetPatch::line_chords(std::span<const Vec3> from, std::span<const Vec3> step, ChordRow& row) const {
  std::vector<Piece> pieces;
  std::vector<FacetCrossing> crossings;
  Vec3 last = start_;
  int winding = winding_;
  for (std::size_t l = 0; l < from.size(); ++l) {
    const std::size_t axis = longest_axis(step[l]);
    if (!(std::fabs(step[l][axis]) > 0)) continue;
    const Vec3 odd = from[l] + kOddShare * step[l];
    winding += change_along(last, odd);
    last = odd;
    crossings.clear();
    const int sense = step[l][axis] > 0 ? 1 : -1;
    cross_all(facets_, axis, from[l], step[l], [&](const FacetCrossing& c) {
      crossings.push_back({(c.t - from[l][axis]) / step[l][axis], sense * c.exit});
    });
    add_pieces(crossings, kOddShare, winding, {l, 0, 1}, pieces);
  }
  add_layers(pieces, from.size(), row);
}

std::optional<Vec3> FacetPatch::nearest_on_surface(const Vec3& p) const {
  std::optional<Vec3> best;
  for (const Triangle& f : facets_) {
    const Vec3 q = nearest_point(f, p);
    if (!best || dot(q - p, q - p) < dot(*best - p, *best - p)) best = q;
  }
  return best;
}

}  // namespace sculpt
