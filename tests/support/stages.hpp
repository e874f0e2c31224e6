#pragma once
// The stages from the overlay grid to the smooth mesh, as the program runs them, on made-up input and in
// memory.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/layers.hpp"
#include "sculpt/brep/interfaces.hpp"
#include "sculpt/contour/interface_smoothing.hpp"
#include "sculpt/filter/filter.hpp"
#include "sculpt/geom/features.hpp"
#include "sculpt/mesh/hex_mesh.hpp"
#include "sculpt/quality/summary.hpp"
#include "sculpt/smooth/smooth.hpp"
#include "support/cases.hpp"

namespace sculpt::test {

// The cells of this rank with ghosts, their fractions and the materials with most of each cell (not
// filtered).
struct Overlay {
  HexMesh cells;
  Fractions fractions;
  std::optional<HexMesh> kept{};         // hexes of an input mesh that stay as they are
  std::vector<std::uint8_t> is_block{};  // per material: 1 = its interfaces with others that are 1 stay
};
[[nodiscard]] Overlay overlay(const Comm& comm, const Case& input, int layers = 2);
[[nodiscard]] Overlay overlay(const Case& input);  // one rank alone
// The same after the filter.
[[nodiscard]] Overlay filtered(const Comm& comm, const Case& input, int layers = 2);
[[nodiscard]] Overlay filtered(const Case& input);
// The mesh of a grid of one material, one rank alone.
[[nodiscard]] HexMesh lattice(const Index3& cells);

// The same mesh, which does not know that it is a lattice, with the corners of its hexes in other orders.
[[nodiscard]] HexMesh turned(HexMesh mesh);

// Cells whose edges and nodes have more and fewer cells around them than in a lattice: a lattice with a
// pillow in its middle third. Grains, one per material; the nodes of the pillow have level 1.
[[nodiscard]] Overlay irregular(const Comm& comm, const Index3& cells, std::int32_t grains,
                                std::uint64_t seed, int layers = 2);

struct StageOptions {
  LayerPlan layers;
  std::int32_t void_material = -1;  // left out of the mesh
  FilterOptions filter;
  InterfaceSmoothing interfaces;  // whether to project is decided by the input, as the program does
  SmoothOptions smoothing;
  std::shared_ptr<const GeometryFeatures> features{};  // what is captured
  Log log;                                             // of the volume smoothing
};

struct StageChecksum {
  std::string stage;
  std::int64_t checksum;
};

struct StagesResult {
  HexMesh mesh;
  std::optional<HexMesh> joined;  // with the hexes that stay as they are
  int pillows = 0;
  Geometry geometry;       // of its interface nodes
  std::int64_t cells = 0;  // that are part of the mesh, all ranks
  std::int64_t quads = 0;  // interface quads of this rank's cells
  std::vector<StageChecksum> checksums;
  std::string ghosts;  // where ghosts first differed from what their owners have; empty = nowhere
};

// Collective.
[[nodiscard]] StagesResult run_stages(const Comm& comm, const Case& input, const StageOptions& options = {});
// The same from cells with the ghost layers that options.layers needs. pure: every cell holds one material.
[[nodiscard]] StagesResult run_stages(const Comm& comm, Overlay overlay, bool pure,
                                      const StageOptions& options = {});

}  // namespace sculpt::test
