#include "sphere.hpp"

#include <cmath>
#include <map>

#include "turn.hpp"

namespace hexmesh {
namespace {

constexpr double kCore = 0.55;     // half the width of the core, in radii
constexpr double kRounding = 0.5;  // of the core: 0 a cube, 1 a ball

// tan(turn / 8 * t), for t in [-1,1]: lines of equal angles across a side of the cube.
double equal_angles(double t) {
  const Direction d = direction((t < 0 ? -t : t) / 8);
  return t < 0 ? -d.sin / d.cos : d.sin / d.cos;
}

using Place = std::array<std::int32_t, 4>;  // i, j, k in the core; number of the shell, 0 = core

class SphereBuilder {
 public:
  explicit SphereBuilder(const SphereOptions& o) : o_(o) {}

  Mesh build() {
    mesh_.blocks = {{1, "ball"}, {2, "xmin"}, {3, "xmax"}, {4, "ymin"},
                    {5, "ymax"}, {6, "zmin"}, {7, "zmax"}};
    add_core();
    for (std::int32_t shell = 0; shell < o_.inside + o_.outside; ++shell)
      for (std::int32_t face = 0; face < 6; ++face) add_layer(shell, face);
    sort_by_block(mesh_);
    constexpr const char* kNames[6] = {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};
    for (std::size_t s = 0; s < 6; ++s)
      add_side_set(mesh_, static_cast<std::int64_t>(s) + 1, kNames[s],
                   [s](const Vec3& p) { return p[s / 2] == (s % 2 == 0 ? -1 : 1); });
    add_interface(mesh_, 7, "sphere_zmax", 0, 6);
    add_node_set(mesh_, 1, "sphere",
                 [this](const Vec3& p) { return std::fabs(norm(p) - o_.radius) < 1e-9 * o_.radius; });
    return std::move(mesh_);
  }

 private:
  void add_core() {
    for (std::int32_t k = 0; k < o_.n; ++k)
      for (std::int32_t j = 0; j < o_.n; ++j)
        for (std::int32_t i = 0; i < o_.n; ++i) {
          Hex hex;
          for (std::size_t c = 0; c < 8; ++c) {
            const auto& d = sculpt::kCornerOffset[c];
            hex[c] = node({i + d[0], j + d[1], k + d[2], 0});
          }
          add(hex, 0);
        }
  }

  // The hexes between two shells, on one side of the cube: -x +x -y +y -z +z.
  void add_layer(std::int32_t shell, std::int32_t face) {
    const auto axis = static_cast<std::size_t>(face / 2), u = (axis + 1) % 3, v = (axis + 2) % 3;
    const bool up = face % 2 == 1;
    for (std::int32_t b = 0; b < o_.n; ++b)
      for (std::int32_t a = 0; a < o_.n; ++a) {
        Hex hex;
        for (std::size_t c = 0; c < 8; ++c) {
          const auto& d = sculpt::kCornerOffset[c];
          Place p{};
          p[axis] = up ? o_.n : 0;
          p[u] = a + (up ? d[0] : d[1]);
          p[v] = b + (up ? d[1] : d[0]);
          p[3] = shell + d[2];
          hex[c] = node(p);
        }
        add(hex, shell < o_.inside ? 0 : face + 1);
      }
  }

  void add(const Hex& hex, std::int32_t block) {
    mesh_.hex.push_back(hex);
    mesh_.block.push_back(block);
  }

  std::int32_t node(const Place& place) {
    const auto [entry, is_new] = number_.try_emplace(place, static_cast<std::int32_t>(mesh_.node.size()));
    if (is_new) mesh_.node.push_back(position(place));
    return entry->second;
  }

  Vec3 position(const Place& place) const {
    Vec3 lattice;
    for (std::size_t d = 0; d < 3; ++d) lattice[d] = (2.0 * place[d] - o_.n) / o_.n;
    const double m = largest(lattice);
    if (m == 0) return {};
    Vec3 angles = (1 / m) * lattice;  // on the sides of the cube
    for (std::size_t d = 0; d < 3; ++d) angles[d] = equal_angles(angles[d]);
    const Vec3 sphere = unit(angles);
    const double share = kRounding * m;
    const Vec3 core = kCore * o_.radius * ((1 - share) * lattice + (share * m) * sphere);
    const std::int32_t shell = place[3];
    if (shell == 0) return core;
    if (shell < o_.inside) return mixed(core, o_.radius * sphere, shell, o_.inside);
    if (shell == o_.inside) return o_.radius * sphere;
    if (shell < o_.inside + o_.outside)
      return mixed(o_.radius * sphere, lattice, shell - o_.inside, o_.outside);
    return lattice;
  }

  static Vec3 mixed(const Vec3& a, const Vec3& b, std::int32_t step, std::int32_t steps) {
    const double t = static_cast<double>(step) / steps;
    return (1 - t) * a + t * b;
  }

  SphereOptions o_;
  Mesh mesh_;
  std::map<Place, std::int32_t> number_;
};

}  // namespace

Mesh sphere_in_cube(const SphereOptions& options) { return SphereBuilder(options).build(); }

}  // namespace hexmesh
