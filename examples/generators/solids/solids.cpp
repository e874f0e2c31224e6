#include "solids/solids.hpp"

#include <fmt/core.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <utility>

namespace sculpt::examples {
namespace {

using Ring = std::vector<Vec3>;

void add_quad(Facets& out, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  out.push_back({a, b, c});
  out.push_back({a, c, d});
}

// The facets between two rings of equally many points; outwards when `a` runs around the way from a to b.
void add_wall(Facets& out, const Ring& a, const Ring& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const std::size_t next = (i + 1) % a.size();
    add_quad(out, a[i], a[next], b[next], b[i]);
  }
}

// A circle in the plane at `centre`, from e1 towards e2.
Ring circle(const Vec3& centre, const Vec3& e1, const Vec3& e2, double radius, int sides) {
  Ring ring;
  for (int i = 0; i < sides; ++i) {
    const double t = 2 * std::numbers::pi * i / sides;
    ring.push_back(centre + radius * (std::cos(t) * e1 + std::sin(t) * e2));
  }
  return ring;
}

// A rectangle with a hole; its corners around as the ring of the hole, the i-th one beside the i-th quarter.
void add_pierced(Facets& out, const std::array<Vec3, 4>& corner, const Ring& hole) {
  const std::size_t quarter = hole.size() / 4;
  for (std::size_t q = 0; q < 4; ++q) {
    for (std::size_t i = q * quarter; i < (q + 1) * quarter; ++i)
      out.push_back({corner[q], hole[(i + 1) % hole.size()], hole[i]});
    out.push_back({corner[q], corner[(q + 1) % 4], hole[(q + 1) * quarter % hole.size()]});
  }
}

void turned_over(Facets& facets) {
  for (Facet& f : facets) std::swap(f[1], f[2]);
}

Vec3 normal_of(const Facet& f) { return unit(cross(f[1] - f[0], f[2] - f[0])); }

}  // namespace

Facets sphere(int levels) {
  Facets facets;
  for (int octant = 0; octant < 8; ++octant) {
    const Vec3 x{octant & 1 ? -1.0 : 1.0, 0, 0}, y{0, octant & 2 ? -1.0 : 1.0, 0},
        z{0, 0, octant & 4 ? -1.0 : 1.0};
    const bool odd = ((octant & 1) + (octant >> 1 & 1) + (octant >> 2)) % 2 == 1;
    facets.push_back(odd ? Facet{x, z, y} : Facet{x, y, z});
  }
  for (int level = 0; level < levels; ++level) {
    Facets finer;
    for (const auto& [a, b, c] : facets) {
      const Vec3 ab = unit(a + b), bc = unit(b + c), ca = unit(c + a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    facets = std::move(finer);
  }
  return facets;
}

Facets box(const Vec3& half) {
  Facets facets;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const auto corner = [&](double u, double v) {
        Vec3 p;
        p[axis] = side * half[axis];
        p[(axis + 1) % 3] = u * half[(axis + 1) % 3];
        p[(axis + 2) % 3] = v * half[(axis + 2) % 3];
        return p;
      };
      Facets quad;
      add_quad(quad, corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1));
      if (side < 0) turned_over(quad);
      facets.insert(facets.end(), quad.begin(), quad.end());
    }
  return facets;
}

Facets cylinder(double radius, double half_height, int sides) {
  const Vec3 low{0, 0, -half_height}, high{0, 0, half_height};
  const Ring bottom = circle(low, {1, 0, 0}, {0, 1, 0}, radius, sides),
             top = circle(high, {1, 0, 0}, {0, 1, 0}, radius, sides);
  Facets facets;
  add_wall(facets, bottom, top);
  for (std::size_t i = 0; i < top.size(); ++i) {
    const std::size_t next = (i + 1) % top.size();
    facets.push_back({high, top[i], top[next]});
    facets.push_back({low, bottom[next], bottom[i]});
  }
  return facets;
}

Facets bracket(int sides) {
  constexpr double kLength = 2, kWidth = 1.2, kHeight = 1.8, kThick = 0.35;
  const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  Facets out;
  // A plate with a hole: the side at `near` looks against `across`, the one at `far` along it. From the hole
  // its corners lie at -e1 -e2 .. : rings start at the first corner's quarter.
  const auto plate = [&](const std::array<Vec3, 4>& near, const std::array<Vec3, 4>& far, const Vec3& centre,
                         const Vec3& e1, const Vec3& e2, const Vec3& across) {
    const Ring low = circle(centre, e1, e2, 0.3, sides),
               high = circle(centre + kThick * across, e1, e2, 0.3, sides);
    Facets bottom, wall;
    add_pierced(bottom, near, low);
    turned_over(bottom);
    out.insert(out.end(), bottom.begin(), bottom.end());
    add_pierced(out, far, high);
    add_wall(wall, low, high);
    turned_over(wall);
    out.insert(out.end(), wall.begin(), wall.end());
  };
  const auto at = [](double px, double py, double pz) { return Vec3{px, py, pz}; };
  // Corners in the first, second, third and fourth quarter of (e1, e2).
  plate({at(kLength, kWidth, 0), at(0, kWidth, 0), at(0, 0, 0), at(kLength, 0, 0)},
        {at(kLength, kWidth, kThick), at(kThick, kWidth, kThick), at(kThick, 0, kThick),
         at(kLength, 0, kThick)},
        {1.2, 0.6, 0}, x, y, z);
  plate({at(0, kWidth, kHeight), at(0, 0, kHeight), at(0, 0, 0), at(0, kWidth, 0)},
        {at(kThick, kWidth, kHeight), at(kThick, 0, kHeight), at(kThick, 0, kThick),
         at(kThick, kWidth, kThick)},
        {0, 0.6, 1.1}, y, z, x);
  // The two L-shaped sides, from the inner corner, and the two ends.
  const std::array<std::array<double, 2>, 5> around{
      {{kThick, kHeight}, {0, kHeight}, {0, 0}, {kLength, 0}, {kLength, kThick}}};
  for (std::size_t i = 0; i + 1 < around.size(); ++i) {
    const auto& [ax, az] = around[i];
    const auto& [bx, bz] = around[i + 1];
    out.push_back({at(kThick, 0, kThick), at(ax, 0, az), at(bx, 0, bz)});
    out.push_back({at(kThick, kWidth, kThick), at(bx, kWidth, bz), at(ax, kWidth, az)});
  }
  add_quad(out, at(kLength, 0, 0), at(kLength, kWidth, 0), at(kLength, kWidth, kThick),
           at(kLength, 0, kThick));
  add_quad(out, at(0, 0, kHeight), at(kThick, 0, kHeight), at(kThick, kWidth, kHeight),
           at(0, kWidth, kHeight));
  return out;
}

void turn(Facets& facets, double about_z, double about_x) {
  const double a = about_z * std::numbers::pi / 180, b = about_x * std::numbers::pi / 180;
  const double ca = std::cos(a), sa = std::sin(a), cb = std::cos(b), sb = std::sin(b);
  for (Facet& f : facets)
    for (Vec3& p : f) {
      const Vec3 q{ca * p.x - sa * p.y, sa * p.x + ca * p.y, p.z};
      p = {q.x, cb * q.y - sb * q.z, sb * q.y + cb * q.z};
    }
}

std::string ascii_stl(const Facets& facets, const std::string& name) {
  std::string text = fmt::format("solid {}\n", name);
  for (const Facet& f : facets) {
    const Vec3 n = normal_of(f);
    text += fmt::format("facet normal {} {} {}\n outer loop\n", n.x, n.y, n.z);
    for (const Vec3& p : f) text += fmt::format("  vertex {} {} {}\n", p.x, p.y, p.z);
    text += " endloop\nendfacet\n";
  }
  return text + fmt::format("endsolid {}\n", name);
}

std::string binary_stl(const Facets& facets, const std::string& header) {
  std::string bytes(84 + 50 * facets.size(), '\0');
  std::memcpy(bytes.data(), header.data(), std::min<std::size_t>(header.size(), 80));
  const auto count = static_cast<std::uint32_t>(facets.size());
  std::memcpy(bytes.data() + 80, &count, 4);
  char* at = bytes.data() + 84;
  for (const Facet& f : facets) {
    const auto put = [&](const Vec3& p) {
      const std::array<float, 3> as_float{static_cast<float>(p.x), static_cast<float>(p.y),
                                          static_cast<float>(p.z)};
      std::memcpy(at, as_float.data(), 12);
      at += 12;
    };
    put(normal_of(f));
    for (const Vec3& p : f) put(p);
    at += 2;
  }
  return bytes;
}

}  // namespace sculpt::examples
