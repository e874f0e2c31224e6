#include "pipeline/void_regions.hpp"

#include <algorithm>

#include "sculpt/mesh/adjacency.hpp"
#include "sculpt/par/components.hpp"

namespace sculpt {
namespace {

// Joins void hexes at their faces. All the other hexes are one set, which spares them a search.
DisjointSets joined(const HexMesh& mesh, std::int32_t of_void) {
  const FaceNeighbours neighbours = face_neighbours_of_any(mesh);
  DisjointSets sets(mesh.hexes.size());
  LocalId first_other = kNone;
  for (LocalId h = 0; h < mesh.size(); ++h) {
    if (mesh.material[at(h)] != of_void) {
      if (first_other == kNone) first_other = h;
      sets.join(first_other, h);
      continue;
    }
    for (const LocalId other : neighbours[at(h)])
      if (other != kNone && other < h && mesh.material[at(other)] == of_void) sets.join(h, other);
  }
  return sets;
}

}  // namespace

std::optional<std::int32_t> void_block(const Deck& deck, const MaterialTable& materials) {
  if (materials.void_material) return materials.void_material;
  const auto& ids = materials.block_id;
  const auto found = std::find(ids.begin(), ids.end(), deck.void_mat);
  if (!deck.given("void_mat") || found == ids.end()) return std::nullopt;
  return static_cast<std::int32_t>(found - ids.begin());
}

VoidRegions separate_void(const Comm& comm, HexMesh& mesh, MaterialTable& materials, std::int32_t of_void) {
  Components parts = connected_components(comm, joined(mesh, of_void), mesh.hex_homes(), mesh.hex_exchange);
  std::vector<std::int32_t> is_other;
  for (const LocalId h : parts.first) is_other.push_back(mesh.material[at(h)] != of_void);
  (void)number_components(comm, parts, mesh.hex_homes(), is_other);
  const auto next = static_cast<std::int32_t>(materials.block_id.size());
  std::int64_t regions = 0;
  for (LocalId h = 0; h < mesh.size(); ++h) {
    if (mesh.material[at(h)] != of_void) continue;
    const std::int32_t region = parts.of[at(h)];
    regions = std::max<std::int64_t>(regions, region + 1);
    if (region > 0) mesh.material[at(h)] = next + region - 1;
  }
  regions = comm.max(regions);
  std::int64_t id = *std::max_element(materials.block_id.begin(), materials.block_id.end());
  for (std::int64_t r = 1; r < regions; ++r) materials.block_id.push_back(++id);
  return {of_void, next, regions};
}

void share_void_volume(const QualitySummary& summary, const VoidRegions& regions,
                       std::vector<double>& input_volume) {
  std::vector<std::size_t> of_region{at(regions.first)};
  for (std::int64_t r = 1; r < regions.count; ++r)
    of_region.push_back(at(regions.others) + static_cast<std::size_t>(r) - 1);
  input_volume.resize(at(regions.others) + of_region.size() - 1);
  const auto meshed = [&](std::size_t m) {
    return m < summary.materials.size() ? summary.materials[m].volume : 0.0;
  };
  double all = 0;
  for (const std::size_t m : of_region) all += meshed(m);
  const double input = input_volume[at(regions.first)];
  for (const std::size_t m : of_region) input_volume[m] = all > 0 ? input * meshed(m) / all : 0;
}

}  // namespace sculpt
