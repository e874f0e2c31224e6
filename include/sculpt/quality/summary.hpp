#pragma once
// The quality of a finished mesh in numbers (design: docs/quality.md): scaled Jacobian, lengths and volumes,
// over all ranks. The same for any number of ranks, but for the owners of hexes.
#include <array>
#include <cstdint>
#include <vector>

#include "sculpt/mesh/hex_mesh.hpp"

namespace sculpt {

inline constexpr std::size_t kWorstListed = 50;    // hexes in QualitySummary::worst
inline constexpr std::size_t kInvalidListed = 20;  // hexes in QualitySummary::invalid

// A hex that is named to the user.
struct ListedHex {
  GlobalId hex = 0;      // key in the mesh
  GlobalId element = 0;  // number in the files, from 1: block by block, in each ascending in key
  std::int32_t material = 0, owner = 0;
  double scaled_jacobian = 0;
  std::int32_t corner = 0;  // where it is reached, 1..8, Exodus order
  double least_determinant =
      0;                     // of the edges at a corner; smallest of the eight, in cells (HexMesh::hex_unit)
  double shortest_edge = 0;  // in the units of the mesh
  Vec3 centre;               // mean of the corners
  std::int32_t valid = 1;    // 1: the Jacobian is positive everywhere in the hex
};

struct MaterialQuality {
  std::int64_t hexes = 0;
  double least = 0, mean = 0;  // scaled Jacobian; 0 without hexes
  double volume = 0;           // in cells of the overlay grid, at level 0
};

struct QualitySummary {
  static constexpr int kBins = 20;
  // Lower end of a bin of the histogram; bins are 0.1 wide, from -1 to 1, and hold their lower end; the last
  // one also holds 1.
  [[nodiscard]] static double bin_begin(int bin) { return (bin - 10) / 10.0; }

  std::int64_t hexes = 0, not_positive = 0;  // scaled Jacobian <= 0
  std::int64_t below_01 = 0, below_02 = 0, below_03 = 0, below_05 = 0;
  std::int64_t not_positive_inside = 0;  // hexes whose Jacobian is not positive everywhere, corners included
  std::array<std::int64_t, kBins> histogram{};
  double least = 1, average = 1;           // scaled Jacobian
  double shortest_edge = 0;                // in the units of the mesh; 0 without hexes
  double shortest_edge_cells = 0;          // the same in cells (HexMesh::hex_unit), every axis in its unit
  std::vector<MaterialQuality> materials;  // per dense material index, up to the last one with hexes
  std::vector<ListedHex> worst;            // least scaled Jacobian first; ties: the smaller key
  std::vector<ListedHex> invalid;          // likewise, of those that are counted in not_positive_inside
};

// Collective. The mesh needs no ghosts. Averages and volumes are summed in whole units of 2^-30, so that they
// do not depend on the number of ranks.
[[nodiscard]] QualitySummary summarise(const Comm& comm, const HexMesh& mesh);

// Local. Of every local hex, ghosts included.
[[nodiscard]] std::vector<double> scaled_jacobians(const HexMesh& mesh);

}  // namespace sculpt
