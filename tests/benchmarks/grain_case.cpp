#include "grain_case.hpp"

#include <algorithm>

#include "grains.hpp"
#include "sculpt/distribute/cartesian.hpp"

namespace sculpt {
namespace {

constexpr int kLayers = 2;
constexpr double kOffset = 0.3;  // of the pillow copies

HexMesh cells_of(int n) {
  const Comm alone = Comm::self();
  const Grid grid = uniform_grid({n, n, n}, {0, 0, 0}, {1, 1, 1});
  HexMesh mesh = lattice_mesh(alone, grid, cut_grid(grid.cells, 1, {0, 0, 0}), kLayers);
  microstructure::GrainOptions options;
  options.n = {n, n, n};
  options.grains = std::max(1, n * n * n / 1000);
  const microstructure::Voxels voxels = make_grains(options);
  mesh.material.resize(mesh.hexes.size());
  for (std::size_t c = 0; c < mesh.hexes.size(); ++c) {
    const GlobalId id = mesh.hex_id[c];
    mesh.material[c] = voxels.at(id % n, id / n % n, id / n / n) - 1;
  }
  return mesh;
}

Fractions pure_fractions(const HexMesh& mesh) {
  Fractions fractions;
  fractions.reserve(mesh.material.size(), mesh.material.size());
  for (const std::int32_t m : mesh.material) {
    fractions.add(m, 1.0);
    fractions.end_cell();
  }
  return fractions;
}

}  // namespace

GrainCase::GrainCase(int n)
    : cells(cells_of(n)),
      fractions(pure_fractions(cells)),
      neighbours(face_neighbours(cells)),
      around(cells) {}

Pillowed GrainCase::pillowed() const {
  return pillow(Comm::self(), cells, neighbours, cells.material, {}, {.offset = kOffset});
}

}  // namespace sculpt
