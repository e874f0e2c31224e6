#include "support/cases.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace sculpt::test {
namespace {

Grid unit_grid(const Index3& cells) { return uniform_grid(cells, {0, 0, 0}, {1, 1, 1}); }

std::string sized(const char* what, const Index3& cells, std::uint64_t seed) {
  return fmt::format("{} {}x{}x{}, seed {}", what, cells[0], cells[1], cells[2], seed);
}

void add_two(Fractions& f, double of_one) {
  if (of_one < 1) f.add(0, 1 - of_one);
  if (of_one > 0) f.add(1, of_one);
}

double cube(double x) { return x * x * x; }

}  // namespace

// The tetrahedron formula, summed over the corners of the cube.
double part_above(const Vec3& corner, Vec3 n, double distance) {
  double d = distance - dot(n, corner);
  for (std::size_t a = 0; a < 3; ++a)
    if (n[a] < 0) {  // mirror the cube
      d -= n[a];
      n[a] = -n[a];
    }
  double below = 0;
  for (unsigned v = 0; v < 8; ++v) {
    const double rest = d - (v & 1 ? n.x : 0) - (v & 2 ? n.y : 0) - (v & 4 ? n.z : 0);
    const bool odd = ((v & 1) + (v >> 1 & 1) + (v >> 2)) % 2 == 1;
    if (rest > 0) below += odd ? -cube(rest) : cube(rest);
  }
  const double above = 1 - below / (6 * n.x * n.y * n.z);
  return above < 1e-12 ? 0 : above > 1 - 1e-12 ? 1 : above;
}

Case periodic(Case input, const std::array<bool, 3>& axes) {
  input.periodic = axes;
  input.name = "periodic " + input.name;
  return input;
}

Fractions fractions_in(const Case& input, const IndexBox& box) {
  Fractions f;
  for (std::int64_t p = 0; p < box.size(); ++p) {
    input.fill(box.cell(p), f);
    f.end_cell();
  }
  return f;
}

std::uint64_t scatter(std::uint64_t seed, std::uint64_t item) {  // splitmix64
  std::uint64_t x = (seed * 0x9e3779b97f4a7c15u) ^ (item + 1) * 0xd1342543de82ef95u;
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
  x = (x ^ x >> 27) * 0x94d049bb133111ebu;
  return x ^ x >> 31;
}

double scatter_unit(std::uint64_t seed, std::uint64_t item) {
  return static_cast<double>(scatter(seed, item) >> 11) / 9007199254740992.0;
}

Case voxels(const std::string& name, const Index3& cells, std::int32_t materials,
            const std::function<std::int32_t(const Index3&)>& material) {
  return {name, unit_grid(cells), materials,
          [material](const Index3& c, Fractions& f) { f.add(material(c), 1); }, true};
}

Case voxels(const Index3& cells, const std::vector<std::int32_t>& material) {
  const std::int32_t most = *std::max_element(material.begin(), material.end());
  return voxels("voxels", cells, most + 1, [=](const Index3& c) {
    return material[static_cast<std::size_t>(whole(cells).position(c))];
  });
}

Case noise(const Index3& cells, std::int32_t materials, std::uint64_t seed) {
  return voxels(sized("noise", cells, seed), cells, materials, [=](const Index3& c) {
    const auto id = static_cast<std::uint64_t>(whole(cells).position(c));
    return static_cast<std::int32_t>(scatter(seed, id) % static_cast<std::uint64_t>(materials));
  });
}

Case grains(const Index3& cells, int grains, std::int32_t materials, std::uint64_t seed) {
  std::vector<Vec3> points;
  for (int g = 0; g < grains; ++g) {
    const auto item = static_cast<std::uint64_t>(3 * g);
    points.push_back({scatter_unit(seed, item) * static_cast<double>(cells[0]),
                      scatter_unit(seed, item + 1) * static_cast<double>(cells[1]),
                      scatter_unit(seed, item + 2) * static_cast<double>(cells[2])});
  }
  return voxels(sized("grains", cells, seed), cells, materials, [=](const Index3& c) {
    const Vec3 at{static_cast<double>(c[0]) + 0.5, static_cast<double>(c[1]) + 0.5,
                  static_cast<double>(c[2]) + 0.5};
    const auto nearest = std::min_element(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) {
      return dot(a - at, a - at) < dot(b - at, b - at);
    });
    return static_cast<std::int32_t>(nearest - points.begin()) % materials;
  });
}

Case two_phase_fractions(const Index3& cells, std::uint64_t seed) {
  return {sized("two-phase fractions", cells, seed), unit_grid(cells), 2, [=](const Index3& c, Fractions& f) {
            const double x = scatter_unit(seed, static_cast<std::uint64_t>(whole(cells).position(c)));
            add_two(f, std::clamp(1.4 * x - 0.2, 0.0, 1.0));
          }};
}

Case ball(const Index3& cells, const Vec3& centre, double radius) {
  const std::string name = fmt::format("ball {}x{}x{} around {} {} {}, radius {}", cells[0], cells[1],
                                       cells[2], centre.x, centre.y, centre.z, radius);
  return {name, unit_grid(cells), 2, [=](const Index3& c, Fractions& f) {
            constexpr int kPoints = 8;
            int inside = 0;
            for (int s = 0; s < kPoints * kPoints * kPoints; ++s) {
              const std::array<int, 3> p{s % kPoints, s / kPoints % kPoints, s / kPoints / kPoints};
              Vec3 at;
              for (std::size_t d = 0; d < 3; ++d)
                at[d] = static_cast<double>(c[d]) + (p[d] + 0.5) / kPoints - centre[d];
              inside += dot(at, at) < radius * radius;
            }
            add_two(f, static_cast<double>(inside) / (kPoints * kPoints * kPoints));
          }};
}

Case half_space(const Index3& cells, const Vec3& normal, double distance) {
  return {
      "half space", unit_grid(cells), 2, [=](const Index3& c, Fractions& f) {
        const Vec3 corner{static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])};
        add_two(f, part_above(corner, normal, distance));
      }};
}

Case at_level(Case input, int level) {
  input.level = [level](const Index3&) { return static_cast<std::uint8_t>(level); };
  input.cell_size = std::ldexp(1.0, level) * input.grid.cell_size();
  return input;
}

Case graded(const Index3& cells, std::int64_t fine, const std::function<bool(const Vec3&)>& inside) {
  Case input{fmt::format("graded {}x{}x{}", cells[0], cells[1], cells[2]), unit_grid(cells), 2, {}};
  for (auto& planes : input.grid.planes)
    for (std::size_t i = static_cast<std::size_t>(fine); i + 1 < planes.size(); ++i)
      planes[i + 1] = planes[i] + 0.5;
  input.level = [fine](const Index3& n) {
    return static_cast<std::uint8_t>(n[0] >= fine || n[1] >= fine || n[2] >= fine);
  };
  input.cell_size = {1, 1, 1};
  input.fill = [planes = input.grid.planes, inside](const Index3& c, Fractions& f) {
    constexpr int kPoints = 8;
    int count = 0;
    for (int s = 0; s < kPoints * kPoints * kPoints; ++s) {
      const std::array<int, 3> p{s % kPoints, s / kPoints % kPoints, s / kPoints / kPoints};
      Vec3 at;
      for (std::size_t d = 0; d < 3; ++d) {
        const auto i = static_cast<std::size_t>(c[d]);
        at[d] = planes[d][i] + (planes[d][i + 1] - planes[d][i]) * (p[d] + 0.5) / kPoints;
      }
      count += inside(at);
    }
    add_two(f, static_cast<double>(count) / (kPoints * kPoints * kPoints));
  };
  return input;
}

}  // namespace sculpt::test
