#include "section.hpp"

#include <cmath>

#include "turn.hpp"

namespace hexmesh {
namespace {

constexpr double kCore = 0.6;  // half the width of the square in the middle, in radii of the disc: its sides
constexpr double kRounding = 0.5;  // 0: a square, 1: a disc

std::int32_t count_of(const Section& s) { return static_cast<std::int32_t>(s.point.size()); }

// Point j of a rim.
Section::Point on_circle(double start, std::size_t j, std::size_t points, double radius) {
  const Direction d = direction(start + static_cast<double>(j) / static_cast<double>(points));
  return {radius * d.cos, radius * d.sin};
}

// The square [-1,1]^2 pulled towards the disc: its boundary bulges.
Section::Point rounded(double u, double v) {
  const double m = std::fmax(std::fabs(u), std::fabs(v));
  if (m == 0) return {0, 0};
  // Place along the side of the concentric square, as the angle of the disc.
  const double along = (m == std::fabs(u) ? v : u) / m;
  const Direction d = direction(0.125 * (along < 0 ? -along : along));
  const double a = m * d.cos, b = along < 0 ? -m * d.sin : m * d.sin;
  const Section::Point on_disc =
      m == std::fabs(u) ? Section::Point{u < 0 ? -a : a, b} : Section::Point{b, v < 0 ? -a : a};
  const double share = kRounding * m;
  return {(1 - share) * u + share * on_disc.x, (1 - share) * v + share * on_disc.y};
}

void add_quad(Section& s, const Quad& q, std::int32_t part) {
  s.quad.push_back(q);
  s.part.push_back(part);
}

}  // namespace

Section disc(std::int32_t n, std::int32_t rings, double radius) {
  Section s;
  const double half = kCore * radius;
  for (std::int32_t j = 0; j <= n; ++j)
    for (std::int32_t i = 0; i <= n; ++i) {
      const Section::Point p =
          rounded((2.0 * i - n) / static_cast<double>(n), (2.0 * j - n) / static_cast<double>(n));
      s.point.push_back({half * p.x, half * p.y});
    }
  const auto index = [n](std::int32_t i, std::int32_t j) { return i + (n + 1) * j; };
  for (std::int32_t j = 0; j < n; ++j)
    for (std::int32_t i = 0; i < n; ++i)
      add_quad(s, {index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)}, 0);
  for (std::int32_t i = 0; i < n; ++i) s.rim.push_back(index(i, 0));
  for (std::int32_t i = 0; i < n; ++i) s.rim.push_back(index(n, i));
  for (std::int32_t i = 0; i < n; ++i) s.rim.push_back(index(n - i, n));
  for (std::int32_t i = 0; i < n; ++i) s.rim.push_back(index(0, n - i));
  const std::vector<std::int32_t> core = s.rim;
  const std::size_t points = core.size();
  for (std::int32_t r = 1; r <= rings; ++r) {
    std::vector<std::int32_t> rim;
    const double t = static_cast<double>(r) / rings;
    for (std::size_t j = 0; j < points; ++j) {
      const Section::Point a = s.point[static_cast<std::size_t>(core[j])],
                           b = on_circle(s.start, j, points, radius);
      rim.push_back(count_of(s));
      s.point.push_back(r == rings ? b : Section::Point{(1 - t) * a.x + t * b.x, (1 - t) * a.y + t * b.y});
    }
    for (std::size_t j = 0; j < points; ++j) {
      const std::size_t next = (j + 1) % points;
      add_quad(s, {s.rim[j], rim[j], rim[next], s.rim[next]}, 0);
    }
    s.rim = std::move(rim);
  }
  return s;
}

void add_rings(Section& s, std::span<const double> radii, std::int32_t part) {
  const std::size_t points = s.rim.size();
  for (const double radius : radii) {
    std::vector<std::int32_t> rim;
    for (std::size_t j = 0; j < points; ++j) {
      rim.push_back(count_of(s));
      s.point.push_back(on_circle(s.start, j, points, radius));
    }
    for (std::size_t j = 0; j < points; ++j) {
      const std::size_t next = (j + 1) % points;
      add_quad(s, {s.rim[j], rim[j], rim[next], s.rim[next]}, part);
    }
    s.rim = std::move(rim);
  }
}

void add_doubling_ring(Section& s, double radius, std::int32_t part) {
  const std::size_t points = s.rim.size();
  // Four quads outside for two inside: three for the split one, one for the other. The outer points are
  // turned by half a quad so that the split ones look straight outwards.
  s.start -= 0.25 / static_cast<double>(points);
  std::vector<std::int32_t> rim;
  for (std::size_t j = 0; j < 2 * points; ++j) {
    rim.push_back(count_of(s));
    s.point.push_back(on_circle(s.start, j, 2 * points, radius));
  }
  const auto outer = [&](std::size_t j) { return rim[j % rim.size()]; };
  const auto between = [&](std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d, double across,
                           double out) {
    const auto p = [&](std::int32_t i) { return s.point[static_cast<std::size_t>(i)]; };
    const auto mix = [&](double pa, double pb, double pc, double pd) {
      return (1 - out) * ((1 - across) * pa + across * pb) + out * ((1 - across) * pc + across * pd);
    };
    const std::int32_t index = count_of(s);
    s.point.push_back({mix(p(a).x, p(b).x, p(c).x, p(d).x), mix(p(a).y, p(b).y, p(c).y, p(d).y)});
    return index;
  };
  for (std::size_t j = 0; j < points; j += 2) {
    const std::int32_t b0 = s.rim[j], b1 = s.rim[j + 1], b2 = s.rim[(j + 2) % points];
    const std::int32_t t0 = outer(2 * j), t1 = outer(2 * j + 1), t2 = outer(2 * j + 2), t3 = outer(2 * j + 3),
                       t4 = outer(2 * j + 4);
    const std::int32_t i0 = between(b0, b1, t0, t3, 0.32, 0.5), i1 = between(b0, b1, t0, t3, 0.68, 0.5);
    add_quad(s, {b0, i0, i1, b1}, part);
    add_quad(s, {b0, t0, t1, i0}, part);
    add_quad(s, {i0, t1, t2, i1}, part);
    add_quad(s, {b1, i1, t2, t3}, part);
    add_quad(s, {b1, t3, t4, b2}, part);
  }
  s.rim = std::move(rim);
}

Mesh sweep(const Section& s, std::span<const double> heights,
           const std::function<std::int32_t(std::int32_t, std::int32_t)>& block_of) {
  Mesh mesh;
  std::vector<std::int32_t> number(s.point.size() * heights.size(), -1);
  const auto node = [&](std::int32_t point, std::size_t level) {
    return static_cast<std::size_t>(point) + s.point.size() * level;
  };
  for (std::size_t layer = 0; layer + 1 < heights.size(); ++layer)
    for (std::size_t q = 0; q < s.quad.size(); ++q) {
      const std::int32_t block = block_of(s.part[q], static_cast<std::int32_t>(layer));
      if (block < 0) continue;
      Hex hex;
      for (std::size_t c = 0; c < 8; ++c) {
        const std::size_t n = node(s.quad[q][c % 4], layer + c / 4);
        number[n] = 0;
        hex[c] = static_cast<std::int32_t>(n);
      }
      mesh.hex.push_back(hex);
      mesh.block.push_back(block);
    }
  for (std::size_t n = 0; n < number.size(); ++n) {
    if (number[n] < 0) continue;
    number[n] = static_cast<std::int32_t>(mesh.node.size());
    const Section::Point& p = s.point[n % s.point.size()];
    mesh.node.push_back({p.x, p.y, heights[n / s.point.size()]});
  }
  for (Hex& h : mesh.hex)
    for (std::int32_t& n : h) n = number[static_cast<std::size_t>(n)];
  sort_by_block(mesh);
  return mesh;
}

}  // namespace hexmesh
