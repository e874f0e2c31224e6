#include "sculpt/filter/thicken.hpp"

#include <algorithm>

#include "sculpt/filter/filter.hpp"
#include "sculpt/vfrac/fractions.hpp"

namespace sculpt {
namespace {

// Appends the fractions of a cell after it gained some of a material.
void add_thickened(const Fractions& from, LocalId cell, std::int32_t material, double gain, Fractions& to) {
  const double before = fraction_of(from, cell, material), after = before + std::min(gain, 1 - before);
  const double others = before < 1 ? (1 - after) / (1 - before) : 0;
  bool placed = false;
  for (auto e = static_cast<std::size_t>(from.offset[at(cell)]);
       e < static_cast<std::size_t>(from.offset[at(cell) + 1]); ++e) {
    if (!placed && from.material[e] >= material) {
      to.add(material, after);
      placed = true;
    }
    if (from.material[e] != material && others * from.value[e] > 0)
      to.add(from.material[e], others * from.value[e]);
  }
  if (!placed) to.add(material, after);
  to.end_cell();
}

void add_copy(const Fractions& from, LocalId cell, Fractions& to) {
  for (auto e = static_cast<std::size_t>(from.offset[at(cell)]);
       e < static_cast<std::size_t>(from.offset[at(cell) + 1]); ++e)
    to.add(from.material[e], from.value[e]);
  to.end_cell();
}

}  // namespace

void thicken(HexMesh& mesh, Fractions& fractions, const FaceNeighbours& neighbours, const NodeHexes& around,
             std::int32_t material, double value) {
  constexpr double kFlat = 3.5;                    // all cells around a cell to those behind a flat interface
  std::vector<double> gain(mesh.hexes.size(), 0);  // known to the owner, who sees all neighbours
  for (LocalId c = 0; c < mesh.size(); ++c) {
    if (mesh.layer[at(c)] != 0 || mesh.material[at(c)] == material) continue;
    int of_material = 0, all = 0;
    for (const LocalId n : mesh.hexes[at(c)])
      for (const std::int32_t item : around[n]) {
        if (item / 8 == c) continue;
        ++all;
        of_material += mesh.material[at(item / 8)] == material;
      }
    if (of_material > 0) gain[at(c)] = value * kFlat * of_material / all;
  }
  mesh.hex_exchange.copy_to_ghosts(gain);
  Fractions thick;
  thick.reserve(mesh.hexes.size(), fractions.material.size() + mesh.hexes.size() / 8);
  for (LocalId c = 0; c < mesh.size(); ++c) {
    if (gain[at(c)] > 0)
      add_thickened(fractions, c, material, gain[at(c)], thick);
    else
      add_copy(fractions, c, thick);
  }
  fractions = std::move(thick);
  assign_materials(mesh, fractions, neighbours);
}

std::int64_t separate_by_void(HexMesh& mesh, Fractions& fractions, const NodeHexes& around,
                              std::int32_t void_material, bool both_sides) {
  std::vector<std::uint8_t> emptied(mesh.hexes.size(), 0);
  std::int64_t count = 0;
  for (LocalId c = 0; c < mesh.size(); ++c) {
    const std::int32_t own = mesh.material[at(c)];
    if (mesh.layer[at(c)] != 0 || own == void_material) continue;
    for (const LocalId n : mesh.hexes[at(c)])
      for (const std::int32_t item : around[n]) {
        const std::int32_t other = mesh.material[at(item / 8)];
        if (other != void_material && (other < own || (both_sides && other != own))) emptied[at(c)] = 1;
      }
    count += emptied[at(c)];
  }
  mesh.hex_exchange.copy_to_ghosts(emptied);
  Fractions separated;
  separated.reserve(mesh.hexes.size(), fractions.material.size());
  for (LocalId c = 0; c < mesh.size(); ++c) {
    if (emptied[at(c)]) {
      mesh.material[at(c)] = void_material;
      separated.add(void_material, 1);
      separated.end_cell();
    } else {
      add_copy(fractions, c, separated);
    }
  }
  fractions = std::move(separated);
  return mesh.hex_exchange.comm().sum(count);
}

}  // namespace sculpt
