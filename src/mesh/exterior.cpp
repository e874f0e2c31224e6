#include "sculpt/mesh/exterior.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sculpt {
namespace {

constexpr double kFlat = 2e-5;  // distance of a corner from a plane, as part of the size of the facets

double square(const Vec3& v) { return dot(v, v); }

std::array<std::array<Vec3, 3>, 2> triangles(const Facet& f) {
  return {{{f.corner[0], f.corner[1], f.corner[2]}, {f.corner[0], f.corner[2], f.corner[3]}}};
}

// Largest distance of the corners of a facet from the plane through `point`.
double off_plane(const Facet& facet, const Vec3& point, const Vec3& normal) {
  double most = 0;
  for (const Vec3& c : facet.corner) most = std::max(most, std::fabs(dot(c - point, normal)));
  return most;
}

double size_of(const Facet& f) {
  return std::sqrt(std::max(square(f.corner[2] - f.corner[0]), square(f.corner[3] - f.corner[1])));
}

Vec3 middle_of(const Facet& f) { return 0.25 * ((f.corner[0] + f.corner[1]) + (f.corner[2] + f.corner[3])); }

}  // namespace

Vec3 nearest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double length = square(ab);
  if (!(length > 0)) return a;
  const double t = dot(p - a, ab) / length;
  if (t <= 0) return a;
  return t >= 1 ? b : a + t * ab;
}

Vec3 nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Vec3 bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + (d1 / (d1 - d3)) * ab;
  const Vec3 cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + (d2 / (d2 - d6)) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (c - b);
  const double sum = va + vb + vc;
  if (!(sum > 0)) return a;  // no area
  return a + (vb / sum) * ab + (vc / sum) * ac;
}

Vec3 facet_normal(const Facet& f) {
  return unit(cross(f.corner[2] - f.corner[0], f.corner[3] - f.corner[1]));
}

bool is_flat(const Facet& f) { return off_plane(f, middle_of(f), facet_normal(f)) <= kFlat * size_of(f); }

bool coplanar(const Facet& a, const Facet& b) {
  const Vec3 normal = facet_normal(a);
  return dot(normal, facet_normal(b)) > 0 && is_flat(a) &&
         off_plane(b, middle_of(a), normal) <= kFlat * std::max(size_of(a), size_of(b));
}

bool common_edge(const Facet& a, const Facet& b, std::array<Vec3, 2>& ends) {
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      const Vec3 &p = a.corner[i], &q = a.corner[(i + 1) % 4];
      if (!(p == b.corner[(j + 1) % 4] && q == b.corner[j])) continue;
      ends = {p, q};
      return true;
    }
  return false;
}

LocalId Exterior::facet_at(LocalId hex, int face) const {
  const auto found = std::lower_bound(faces.begin(), faces.end(), std::pair(hex, face),
                                      [](const ExteriorFace& f, const std::pair<LocalId, int>& key) {
                                        return std::pair(f.hex, f.face) < key;
                                      });
  return found != faces.end() && found->hex == hex && found->face == face ? found->facet : kNone;
}

LocalId Exterior::add_surface(std::span<const LocalId> on) {
  Hold hold;
  hold.kind = Hold::Kind::kSurface;
  hold.first = static_cast<std::int32_t>(patch.size());
  patch.insert(patch.end(), on.begin(), on.end());
  hold.last = static_cast<std::int32_t>(patch.size());
  holds.push_back(hold);
  return static_cast<LocalId>(holds.size()) - 1;
}

LocalId Exterior::add_line(const std::array<Vec3, 3>& line) {
  Hold hold;
  hold.kind = Hold::Kind::kLine;
  hold.line = line;
  holds.push_back(hold);
  return static_cast<LocalId>(holds.size()) - 1;
}

Vec3 Exterior::nearest(LocalId hold, const Vec3& p) const {
  const Hold& h = holds[at(hold)];
  Vec3 best = p;
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](const Vec3& q) {
    if (const double distance = square(q - p); distance < least) {
      least = distance;
      best = q;
    }
  };
  if (h.kind == Hold::Kind::kLine) {
    consider(nearest_on_segment(p, h.line[0], h.line[1]));
    consider(nearest_on_segment(p, h.line[1], h.line[2]));
  } else if (h.kind == Hold::Kind::kSurface) {
    for (auto i = h.first; i < h.last; ++i)
      for (const auto& [a, b, c] : triangles(facets[at(patch[static_cast<std::size_t>(i)])]))
        consider(nearest_on_triangle(p, a, b, c));
  }
  return best;
}

Vec3 Exterior::direction(LocalId hold, const Vec3& p) const {
  const Hold& h = holds[at(hold)];
  if (h.kind == Hold::Kind::kLine) {
    const double d0 = square(nearest_on_segment(p, h.line[0], h.line[1]) - p),
                 d1 = square(nearest_on_segment(p, h.line[1], h.line[2]) - p);
    const bool first = d0 < d1 || (d0 == d1 && !(h.line[0] == h.line[1]));
    return unit(first ? h.line[1] - h.line[0] : h.line[2] - h.line[1]);
  }
  Vec3 normal;
  double least = std::numeric_limits<double>::infinity();
  for (auto i = h.first; i < h.last; ++i)
    for (const auto& [a, b, c] : triangles(facets[at(patch[static_cast<std::size_t>(i)])])) {
      const double distance = square(nearest_on_triangle(p, a, b, c) - p);
      if (!(distance < least)) continue;
      least = distance;
      normal = cross(b - a, c - a);
    }
  return unit(normal);
}

}  // namespace sculpt
