#include "kinds.hpp"

#include <cmath>
#include <stdexcept>

#include "section.hpp"
#include "sphere.hpp"
#include "turn.hpp"

namespace hexmesh {
namespace {

// n + 1 values from lo to hi, both exact.
std::vector<double> steps(double lo, double hi, std::int32_t n) {
  std::vector<double> values;
  for (std::int32_t i = 0; i <= n; ++i) values.push_back(i == n ? hi : lo + (hi - lo) * i / n);
  return values;
}

std::int32_t at_least_one(double count) {
  return count < 1 ? 1 : static_cast<std::int32_t>(std::floor(count + 0.5));
}

Mesh lattice(std::int32_t nx, std::int32_t ny, std::int32_t nz) {
  Mesh mesh;
  for (std::int32_t k = 0; k <= nz; ++k)
    for (std::int32_t j = 0; j <= ny; ++j)
      for (std::int32_t i = 0; i <= nx; ++i)
        mesh.node.push_back({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
  for (std::int32_t k = 0; k < nz; ++k)
    for (std::int32_t j = 0; j < ny; ++j)
      for (std::int32_t i = 0; i < nx; ++i) {
        Hex hex;
        for (std::size_t c = 0; c < 8; ++c) {
          const auto& o = sculpt::kCornerOffset[c];
          hex[c] = i + o[0] + (nx + 1) * (j + o[1] + (ny + 1) * (k + o[2]));
        }
        mesh.hex.push_back(hex);
      }
  mesh.block.assign(mesh.hex.size(), 0);
  mesh.blocks = {{1, ""}};
  return mesh;
}

// Sets of the six sides of a lattice, by the lattice positions of its nodes.
void add_lattice_sides(Mesh& mesh, std::int32_t nx, std::int32_t ny, std::int32_t nz) {
  const Vec3 last{static_cast<double>(nx), static_cast<double>(ny), static_cast<double>(nz)};
  constexpr const char* kNames[6] = {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};
  for (std::size_t s = 0; s < 6; ++s) {
    const std::size_t axis = s / 2;
    const double plane = s % 2 == 0 ? 0 : last[axis];
    add_side_set(mesh, static_cast<std::int64_t>(s) + 1, kNames[s],
                 [axis, plane](const Vec3& p) { return p[axis] == plane; });
  }
  add_node_set(mesh, 1, "corner", [](const Vec3& p) { return p == Vec3{}; });
  add_node_set(mesh, 2, "top", [&last](const Vec3& p) { return p.z == last.z; });
}

Mesh make_box(Options& o) {
  const std::int32_t nx = o.integer("nx", 10, 1, 500), ny = o.integer("ny", 10, 1, 500),
                     nz = o.integer("nz", 10, 1, 500);
  const Vec3 origin{o.number("x0", 0, -1e9, 1e9), o.number("y0", 0, -1e9, 1e9), o.number("z0", 0, -1e9, 1e9)};
  const Vec3 size{o.number("lx", nx, 1e-9, 1e9), o.number("ly", ny, 1e-9, 1e9),
                  o.number("lz", nz, 1e-9, 1e9)};
  Mesh mesh = lattice(nx, ny, nz);
  add_lattice_sides(mesh, nx, ny, nz);
  const Vec3 count{static_cast<double>(nx), static_cast<double>(ny), static_cast<double>(nz)};
  for (Vec3& p : mesh.node)
    for (std::size_t d = 0; d < 3; ++d) p[d] = origin[d] + size[d] * p[d] / count[d];
  return mesh;
}

Mesh make_bar(Options& o) {
  const std::int32_t nx = o.integer("nx", 20, 1, 500), ny = o.integer("ny", 20, 1, 500),
                     nz = o.integer("nz", 10, 1, 500);
  const double length = o.number("length", 40, 1e-6, 1e6), height = o.number("height", 2, 1e-6, 1e6),
               width = o.number("width", 1, 1e-6, 1e6), angle = o.number("angle", 90, 1, 350);
  const double inner = length / (angle / 180 * 3.14159265358979323846) - height / 2;
  if (inner <= 0) throw std::runtime_error("--angle: the bar is too short for this bend, or too high");
  Mesh mesh = lattice(nx, ny, nz);
  add_lattice_sides(mesh, nx, ny, nz);
  for (Vec3& p : mesh.node) {
    const Direction d = direction(0.5 + angle / 360 * (p.x / nx - 0.5) + 0.25);
    const double radius = inner + height * (1 - p.y / ny);
    p = {radius * d.cos, radius * d.sin, width * p.z / nz};
  }
  return mesh;
}

// The wall of a cylinder about the z axis.
std::function<bool(const Vec3&)> on_wall(double radius) {
  return [radius](const Vec3& p) {
    return std::fabs(std::sqrt(p.x * p.x + p.y * p.y) - radius) < 1e-9 * radius;
  };
}
std::function<bool(const Vec3&)> at_height(double z) {
  return [z](const Vec3& p) { return p.z == z; };
}
std::function<bool(const Vec3&)> on_axis() {
  return [](const Vec3& p) { return p.x == 0 && p.y == 0; };
}

Mesh make_cylinder(Options& o) {
  const std::int32_t n = o.integer("n", 8, 2, 200), layers = o.integer("layers", 2 * n, 1, 2000),
                     rings = o.integer("rings", at_least_one(n / 3.0), 1, 200);
  const double radius = o.number("radius", 5, 1e-6, 1e6), height = o.number("height", 10, 1e-6, 1e6);
  Mesh mesh =
      sweep(disc(n, rings, radius), steps(0, height, layers), [](std::int32_t, std::int32_t) { return 0; });
  mesh.blocks = {{1, ""}};
  add_side_set(mesh, 1, "bottom", at_height(0));
  add_side_set(mesh, 2, "top", at_height(height));
  add_side_set(mesh, 3, "wall", on_wall(radius));
  add_node_set(mesh, 1, "axis", on_axis());
  return mesh;
}

// Appendix N: the first two blocks are the lower and the upper part of a cylinder, the third is the tube
// around them, the fourth stands on all three.
Mesh make_nested(Options& o) {
  const std::int32_t n = 2 * o.integer("n", 6, 1, 50);
  const double fine = n / 12.0, inner = 8, outer = 15, bottom = -5, height = 36, centre = 13;
  Section section = disc(n, at_least_one(3 * fine), inner);
  std::vector<double> radii = steps(inner, 10, at_least_one(2 * fine));
  add_rings(section, std::span(radii).subspan(1), 1);
  const double doubled = 10 + 1.3 / fine;
  add_doubling_ring(section, doubled < 13 ? doubled : 13, 1);
  radii = steps(doubled < 13 ? doubled : 13, outer, at_least_one(4 * fine));
  add_rings(section, std::span(radii).subspan(1), 1);
  const std::int32_t layers = 3 * at_least_one(10 * fine);
  const std::int32_t first = layers / 3, last = layers - layers * 4 / 15;
  const std::vector<double> heights = steps(bottom, bottom + height, layers);
  Mesh mesh = sweep(section, heights, [&](std::int32_t part, std::int32_t layer) {
    if (layer >= last) return 3;
    if (part == 1) return 2;
    return layer < first ? 0 : 1;
  });
  mesh.blocks = {{1, "lower"}, {2, "upper"}, {3, "tube"}, {4, "cap"}};
  add_side_set(mesh, 1, "bottom", at_height(bottom));
  add_side_set(mesh, 2, "top", at_height(bottom + height));
  add_side_set(mesh, 3, "wall", on_wall(outer));
  add_interface(mesh, 4, "upper_tube", 1, 2);
  add_node_set(mesh, 1, "axis", on_axis());
  add_node_set(mesh, 2, "rim", [&](const Vec3& p) { return at_height(bottom)(p) && on_wall(outer)(p); });
  for (Vec3& p : mesh.node) p = {p.x + centre, p.y + centre, p.z};
  return mesh;
}

Mesh make_sphere(Options& o) {
  SphereOptions s;
  s.n = o.integer("n", 8, 2, 100);
  s.inside = o.integer("inside", at_least_one(s.n / 4.0), 1, 200);
  s.outside = o.integer("outside", at_least_one(s.n / 2.0), 1, 200);
  s.radius = o.number("radius", 0.6, 0.1, 0.8);
  return sphere_in_cube(s);
}

constexpr Kind kKinds[] = {
    {"nested", make_nested,
     "[--n 6]  four blocks of nested cylinders about (13,13), radius 15, z from -5 to 31 (Appendix N)"},
    {"cylinder", make_cylinder,
     "[--n 8] [--rings N] [--layers N] [--radius 5] [--height 10]  along z, n x n hexes in the middle"},
    {"sphere-in-cube", make_sphere,
     "[--n 8] [--inside N] [--outside N] [--radius 0.6]  a ball and six blocks around it, [-1,1]^3"},
    {"bar", make_bar,
     "[--nx 20] [--ny 20] [--nz 10] [--length 40] [--height 2] [--width 1] [--angle 90]  bent, flat hexes"},
    {"box", make_box,
     "[--nx 10] [--ny 10] [--nz 10] [--x0 0] [--y0 0] [--z0 0] [--lx NX] [--ly NY] [--lz NZ]  a Cartesian "
     "grid"},
};

}  // namespace

std::span<const Kind> all_kinds() { return kKinds; }

const Kind& kind_named(const std::string& name) {
  std::string names;
  for (const Kind& k : kKinds) {
    if (name == k.name) return k;
    names += std::string(" ") + k.name;
  }
  throw std::runtime_error("found '" + name + "', expected one of" + names);
}

Mesh make_mesh(const Kind& kind, Options& options) {
  Mesh mesh = kind.make(options);
  const std::int32_t grains = options.integer("grains", 0, 1, 1000);
  const std::int32_t seed = options.integer("seed", 1, 0, INT32_MAX);
  const std::int32_t order = options.integer("permute", -1, 0, INT32_MAX);
  if (grains > 0) add_grains(mesh, grains, static_cast<std::uint64_t>(seed));
  if (order >= 0) shuffle(mesh, static_cast<std::uint64_t>(order));
  return mesh;
}

}  // namespace hexmesh
