#pragma once
// Inputs of a few lines: voxels, grains, spheres, volume fractions. All are the same on every machine.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace sculpt::cli {

struct Voxels {
  int nx, ny, nz;
  std::function<int(int, int, int)> id;  // of cell (i, j, k)
};

// The text of an .spn file with x outermost (spn_xyz_order 0), and the deck lines that name it.
[[nodiscard]] std::string spn_text(const Voxels& voxels);
[[nodiscard]] std::string spn_deck(const Voxels& voxels, const std::string& file);
// The same voxels with the loops in another order: axes[0] outermost (0 = x).
[[nodiscard]] std::string spn_text(const Voxels& voxels, const std::vector<int>& axes);

[[nodiscard]] Voxels letter_f();                                       // 3 x 5 x 4, ids 1 and 2
[[nodiscard]] Voxels one_layer();                                      // 12 x 10 x 1, ids 1 to 6
[[nodiscard]] Voxels grains(int side, int count, std::uint64_t seed);  // Voronoi cells of random points

// A diatom file of two concentric spheres: radius 5 in material 1, radius 10 in material 2; and its deck on
// 16^3 cells of the box +-16.
[[nodiscard]] std::string two_spheres();
[[nodiscard]] std::string two_spheres_deck(const std::string& file);

// The grid of a deck: cells^3 in a cube about the origin.
[[nodiscard]] std::string box_deck(int cells, double half_width);

// Three materials that pass smoothly into each other, 8 x 7 x 6 cells, as a .tec file.
[[nodiscard]] std::string smooth_fractions();

}  // namespace sculpt::cli
