#include <algorithm>

#include "sculpt/filter/filter.hpp"
#include "sculpt/vfrac/fractions.hpp"

namespace sculpt {
namespace {

double in_neighbours(const Fractions& f, const std::array<LocalId, 6>& neighbours, std::int32_t m) {
  std::array<LocalId, 6> sorted = neighbours;  // canonical order of the sum
  std::sort(sorted.begin(), sorted.end());
  double sum = 0;
  for (const LocalId n : sorted)
    if (n != kNone) sum += fraction_of(f, n, m);
  return sum;
}

}  // namespace

void assign_materials(HexMesh& mesh, const Fractions& fractions, const FaceNeighbours& neighbours) {
  mesh.material.resize(mesh.hexes.size());
  for (std::size_t c = 0; c < mesh.hexes.size(); ++c) {
    const auto first = static_cast<std::size_t>(fractions.offset[c]),
               last = static_cast<std::size_t>(fractions.offset[c + 1]);
    std::size_t best = first;
    double around_best = -1;
    for (std::size_t e = first + 1; e < last; ++e) {
      if (fractions.value[e] < fractions.value[best]) continue;
      if (fractions.value[e] == fractions.value[best]) {
        if (around_best < 0) around_best = in_neighbours(fractions, neighbours[c], fractions.material[best]);
        const double around = in_neighbours(fractions, neighbours[c], fractions.material[e]);
        if (around <= around_best) continue;
        around_best = around;
      } else {
        around_best = -1;
      }
      best = e;
    }
    mesh.material[c] = fractions.material[best];
  }
  mesh.hex_exchange.copy_to_ghosts(mesh.material);  // the outermost ghosts lack neighbours
}

}  // namespace sculpt
