#pragma once
// What a mesh made of the geometry it was given (docs/quality.md): how smooth its interfaces are, how far
// they moved, and what that did to the volumes. All numbers are the same for any number of ranks.
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sculpt/input/material_source.hpp"
#include "sculpt/mesh/hex_mesh.hpp"
#include "sculpt/quality/summary.hpp"

namespace sculpt {

// The interface nodes that a rank owns, and where earlier stages had them.
struct InterfaceTrack {
  std::vector<GlobalId> node;   // ids in the final mesh, ascending
  std::vector<Vec3> contoured;  // where the contour placed it
  std::vector<Vec3> smoothed;   // after the interfaces were smoothed: the target of the volume smoothing
};

// Distances in cells: every axis in units of the cells at the node.
struct Displacement {
  std::int64_t nodes = 0;
  double largest_from_contour = 0, mean_from_contour = 0;
  double largest_from_target = 0, mean_from_target = 0;
};

// Collective. The nodes of the track that the mesh still has, in the coordinates of the track.
[[nodiscard]] Displacement displacement(const Comm& comm, const HexMesh& mesh, const InterfaceTrack& track);

// Quads between hexes of two materials, and the angle between two of them that share an edge.
struct Kink {
  std::int64_t quads = 0;
  std::int64_t edges = 0;  // that exactly two quads share, both between the same two materials
  double mean = 0;         // degrees, over these edges
};

// Collective. The mesh needs one ghost layer. Work: a pass over the hexes, the rest in proportion to the
// interfaces.
[[nodiscard]] Kink measure_kink(const Comm& comm, const HexMesh& mesh);

// Collective. Volume of each material by its fractions, in cells of level 0.
[[nodiscard]] std::vector<double> input_volumes(const Comm& comm, const HexMesh& cells,
                                                const Fractions& fractions, std::size_t materials);

// Half the sum over the materials of |volume in the mesh - volume in the input|, in percent of the domain.
// What is not meshed counts as one more material, which has the volume of the materials `unmeshed`
// in the input.
[[nodiscard]] double volume_moved(const QualitySummary& summary, std::span<const double> input,
                                  std::optional<std::int32_t> unmeshed);

// All that is told about a mesh, on the console and in the quality file.
struct QualityReport {
  // A material that is meshed, whether or not a hex of it was made.
  struct Block {
    std::int32_t material = 0;  // dense index
    std::int64_t id = 0;
    std::string name;
    double input_volume = 0;  // in cells of level 0
  };
  QualitySummary summary;
  Kink kink;
  Displacement displacement;
  std::vector<Block> blocks;  // ascending in material
  double volume_moved = 0;    // percent of the domain
  double cell_volume = 1;     // in the units of the mesh

  [[nodiscard]] MaterialQuality of(const Block& block) const {
    return at(block.material) < summary.materials.size() ? summary.materials[at(block.material)]
                                                         : MaterialQuality{};
  }
};

}  // namespace sculpt
