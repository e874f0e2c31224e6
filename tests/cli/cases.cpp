#include "cases.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sculpt::cli {
namespace {

// The same numbers everywhere, unlike the distributions of <random>.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  double next() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state_ >> 11) / 9007199254740992.0;
  }

 private:
  std::uint64_t state_;
};

}  // namespace

std::string spn_text(const Voxels& voxels) { return spn_text(voxels, {0, 1, 2}); }

std::string spn_text(const Voxels& voxels, const std::vector<int>& axes) {
  const std::array<int, 3> cells{voxels.nx, voxels.ny, voxels.nz};
  const auto axis = [&](std::size_t loop) { return static_cast<std::size_t>(axes[loop]); };
  std::string text;
  std::array<int, 3> c{};
  for (c[axis(0)] = 0; c[axis(0)] < cells[axis(0)]; ++c[axis(0)])
    for (c[axis(1)] = 0; c[axis(1)] < cells[axis(1)]; ++c[axis(1)]) {
      for (c[axis(2)] = 0; c[axis(2)] < cells[axis(2)]; ++c[axis(2)])
        text += fmt::format("{} ", voxels.id(c[0], c[1], c[2]));
      text += '\n';
    }
  return text;
}

std::string spn_deck(const Voxels& voxels, const std::string& file) {
  return fmt::format("input_spn = {}\nnelx = {}\nnely = {}\nnelz = {}\n", file, voxels.nx, voxels.ny,
                     voxels.nz);
}

Voxels letter_f() {
  return {3, 5, 4, [](int i, int j, int k) {
            const bool bar = j == 4 || (j == 2 && k < 3) || k == 0;
            return i < 2 && bar ? 2 : 1;
          }};
}

Voxels one_layer() {
  return {12, 10, 1, [](int i, int j, int) { return 1 + (i / 4 + j / 5 + (i * j > 40 ? 2 : 0)) % 6; }};
}

Voxels grains(int side, int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<std::array<double, 3>> points(static_cast<std::size_t>(count));
  for (auto& point : points)
    for (double& x : point) x = side * random.next();
  return {side, side, side, [points](int i, int j, int k) {
            std::size_t nearest = 0;
            double least = 1e300;
            for (std::size_t p = 0; p < points.size(); ++p) {
              const double x = i + 0.5 - points[p][0], y = j + 0.5 - points[p][1], z = k + 0.5 - points[p][2];
              const double distance = x * x + y * y + z * z;
              if (distance < least) {
                least = distance;
                nearest = p;
              }
            }
            return static_cast<int>(nearest) + 1;
          }};
}

std::string two_spheres() {
  return "diatom\n"
         "  package 'inner'\n    material 1\n    insert sphere\n      center = 0 0 0\n      radius = 5\n    "
         "endinsert\n"
         "  endpackage\n"
         "  package 'outer'\n    material 2\n    insert sphere\n      center = 0 0 0\n      radius = 10\n    "
         "endinsert\n"
         "  endpackage\n"
         "enddiatom\n";
}

std::string box_deck(int cells, double half_width) {
  std::string deck;
  for (const char axis : {'x', 'y', 'z'})
    deck += fmt::format("nel{0} = {1}\n{0}min = {2}\n{0}max = {3}\n", axis, cells, -half_width, half_width);
  return deck;
}

std::string two_spheres_deck(const std::string& file) {
  return "diatom_file = " + file +
         "\nnelx = 16\nnely = 16\nnelz = 16\nxmin = -16\nymin = -16\nzmin = -16\nxmax = 16\nymax = 16\nzmax "
         "= 16\n";
}

std::string smooth_fractions() {
  std::string text = "TITLE = \"three materials\"\nVARIABLES = \"x\", \"y\", \"z\", \"a\", \"b\", \"c\"\n";
  text += "ZONE I = 8, J = 7, K = 6, F = POINT\n";
  for (int k = 0; k < 6; ++k)
    for (int j = 0; j < 7; ++j)
      for (int i = 0; i < 8; ++i) {
        // Distances to a plane and to a sphere, softened over a cell. Sixteenths sum to 1 exactly.
        const double plane = 3.3 + 0.4 * j - i, ball = 2.4 - std::hypot(i - 6.2, j - 2.1, k - 2.6);
        const auto soften = [](double d) { return std::clamp(0.5 + d, 0.0, 1.0); };
        const int c = static_cast<int>(16 * soften(ball)), a = static_cast<int>((16 - c) * soften(plane));
        text += fmt::format("{} {} {} {} {} {}\n", i, j, k, a / 16.0, (16 - a - c) / 16.0, c / 16.0);
      }
  return text;
}

}  // namespace sculpt::cli
