#include "support/shares.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "sculpt/geom/hex.hpp"
#include "support/cases.hpp"

namespace sculpt::test {
namespace {

using Quad = std::array<std::array<double, 2>, 4>;

// Blocks and values that depend on the element only.
void label(WholeMesh& mesh) {
  mesh.block.clear();
  mesh.value.clear();
  for (std::uint64_t e = 0; e < mesh.corner.size(); ++e) {
    mesh.block.push_back(static_cast<std::int32_t>(scatter(5, e) % 3));
    for (std::uint64_t i = 0; i < 2; ++i) mesh.value.push_back(scatter_unit(7 + i, e));
  }
}

std::vector<std::size_t> shuffled(std::size_t count, std::uint64_t seed) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [seed](std::size_t a, std::size_t b) { return scatter(seed, a) < scatter(seed, b); });
  return order;
}

// Turns about the axis through corners 0 and 6, and about z: any orientation in a few steps.
std::array<GlobalId, 8> turned_corners(const std::array<GlobalId, 8>& c, std::uint64_t times) {
  std::array<GlobalId, 8> r = c;
  for (std::uint64_t t = 0; t < times % 3; ++t) r = {r[0], r[3], r[7], r[4], r[1], r[2], r[6], r[5]};
  for (std::uint64_t t = 0; t < times / 3 % 4; ++t) r = {r[1], r[2], r[3], r[0], r[5], r[6], r[7], r[4]};
  return r;
}

template <class HasElement, class HasNode>
ElementShare share_of(const WholeMesh& mesh, const HasElement& has_element, const HasNode& has_node) {
  ElementShare share;
  share.elements = static_cast<GlobalId>(mesh.corner.size());
  share.nodes = static_cast<GlobalId>(mesh.position.size());
  share.values_per_element = 2;
  for (std::size_t e = 0; e < mesh.corner.size(); ++e) {
    if (!has_element(e)) continue;
    share.element.push_back(static_cast<GlobalId>(e));
    share.corner.push_back(mesh.corner[e]);
    share.block.push_back(mesh.block[e]);
    for (std::size_t i = 0; i < 2; ++i) share.value.push_back(mesh.value[2 * e + i]);
  }
  for (std::size_t n = 0; n < mesh.position.size(); ++n) {
    if (!has_node(n)) continue;
    share.node.push_back(static_cast<GlobalId>(n));
    share.position.push_back(mesh.position[n]);
  }
  return share;
}

}  // namespace

WholeMesh whole_grid(const Grid& grid) {
  WholeMesh mesh;
  mesh.name = "grid";
  Index3 corners = grid.cells;
  for (std::int64_t& n : corners) ++n;
  for (std::int64_t i = 0; i < whole(corners).size(); ++i)
    mesh.position.push_back(grid.corner(whole(corners).cell(i)));
  for (std::int64_t i = 0; i < grid.cell_count(); ++i) {
    const Index3 cell = whole(grid.cells).cell(i);
    std::array<GlobalId, 8> corner;
    for (std::size_t v = 0; v < 8; ++v)
      corner[v] = grid.node_id(
          {cell[0] + kCornerOffset[v][0], cell[1] + kCornerOffset[v][1], cell[2] + kCornerOffset[v][2]});
    mesh.corner.push_back(corner);
  }
  label(mesh);
  return mesh;
}

WholeMesh permuted(const WholeMesh& mesh, std::uint64_t seed, bool turned) {
  WholeMesh result;
  result.name = mesh.name + ", permuted";
  std::vector<GlobalId> new_number(mesh.position.size());
  for (const std::size_t n : shuffled(mesh.position.size(), seed)) {
    new_number[n] = static_cast<GlobalId>(result.position.size());
    result.position.push_back(mesh.position[n]);
  }
  for (const std::size_t e : shuffled(mesh.corner.size(), seed + 1)) {
    std::array<GlobalId, 8> corner;
    for (std::size_t v = 0; v < 8; ++v) corner[v] = new_number[static_cast<std::size_t>(mesh.corner[e][v])];
    result.corner.push_back(turned ? turned_corners(corner, scatter(seed, e) % 12) : corner);
  }
  label(result);
  return result;
}

WholeMesh cylinder(int n, int layers) {
  WholeMesh mesh;
  mesh.name = "cylinder";
  std::vector<Quad> kites;
  constexpr double kPi = 3.14159265358979323846;
  const auto on_circle = [](double turn) {
    return std::array<double, 2>{std::cos(2 * kPi * turn / 10), std::sin(2 * kPi * turn / 10)};
  };
  const auto part = [](double s, const std::array<double, 2>& p) {
    return std::array<double, 2>{s * p[0], s * p[1]};
  };
  for (int t = 0; t < 5; ++t) {
    // Of the triangle axis - a - b: its middle m, the middles of its edges and its three kites.
    const auto a = on_circle(2 * t), b = on_circle(2 * t + 2), ab = on_circle(2 * t + 1), m = part(0.6, ab);
    kites.push_back({{{0, 0}, part(0.5, a), m, part(0.5, b)}});
    kites.push_back({{part(0.5, a), a, ab, m}});
    kites.push_back({{part(0.5, b), m, ab, b}});
  }
  std::map<std::array<long, 3>, GlobalId> known;  // by place, rounded
  const auto node = [&](const Quad& q, int i, int j, int k) {
    const double u = static_cast<double>(i) / n, v = static_cast<double>(j) / n;
    Vec3 p{0, 0, 0.4 * k};
    for (std::size_t d = 0; d < 2; ++d)
      p[d] = (1 - u) * (1 - v) * q[0][d] + u * (1 - v) * q[1][d] + u * v * q[2][d] + (1 - u) * v * q[3][d];
    const std::array<long, 3> key{std::lround(1e9 * p.x), std::lround(1e9 * p.y), k};
    const auto [at, fresh] = known.try_emplace(key, static_cast<GlobalId>(mesh.position.size()));
    if (fresh) mesh.position.push_back(p);
    return at->second;
  };
  for (const Quad& q : kites)
    for (int k = 0; k < layers; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          std::array<GlobalId, 8> corner;
          for (std::size_t v = 0; v < 8; ++v)
            corner[v] = node(q, i + kCornerOffset[v][0], j + kCornerOffset[v][1], k + kCornerOffset[v][2]);
          mesh.corner.push_back(corner);
        }
  label(mesh);
  return mesh;
}

void append(WholeMesh& mesh, const WholeMesh& other) {
  const auto nodes = static_cast<GlobalId>(mesh.position.size());
  mesh.position.insert(mesh.position.end(), other.position.begin(), other.position.end());
  for (auto corner : other.corner) {
    for (GlobalId& n : corner) n += nodes;
    mesh.corner.push_back(corner);
  }
  label(mesh);
}

ElementShare dealt(const Comm& comm, const WholeMesh& mesh, std::uint64_t seed) {
  const auto ranks = static_cast<std::uint64_t>(comm.size()), rank = static_cast<std::uint64_t>(comm.rank());
  return share_of(
      mesh, [&](std::size_t e) { return scatter(seed, e) % ranks == rank; },
      [&](std::size_t n) {
        return scatter(seed + 1, n) % ranks == rank || scatter(seed + 2, n) % (3 * ranks) == rank;
      });
}

ElementShare in_pieces(const Comm& comm, const WholeMesh& mesh) {
  const auto ranks = static_cast<std::size_t>(comm.size()), rank = static_cast<std::size_t>(comm.rank());
  return share_of(
      mesh, [&](std::size_t e) { return e * ranks / mesh.corner.size() == rank; },
      [&](std::size_t n) { return n * ranks / mesh.position.size() == rank; });
}

}  // namespace sculpt::test
