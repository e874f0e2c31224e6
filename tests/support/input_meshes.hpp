#pragma once
// Unstructured overlay meshes in memory: cells with their exterior, as a run with `input_mesh` makes them, of
// the meshes of the examples' generator and of others.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "support/shares.hpp"
#include "support/stages.hpp"

namespace sculpt::test {

// A mesh of examples/generators/meshes: cylinder, sphere-in-cube, nested, bar, box, with options as there.
[[nodiscard]] WholeMesh generated(const std::string& kind, std::vector<std::string> options = {});

struct InputMeshCase {
  std::string name;
  WholeMesh mesh;
  int grains = 3;  // materials 0 .. grains - 1
  std::uint64_t seed = 1;
  bool pure = false;                 // the material of a cell is that of its centre
  std::vector<std::int32_t> keep{};  // indices of the blocks that stay as they are
  bool blocks = false;               // materials are the blocks and a grain 0 in the middle
  double feature_angle = 135;
  bool slides = false;
  std::uint64_t dealt = 7;  // seed of the partition
};

// Per block of the mesh the material of its hexes when they stay as they are: those after the grains.
[[nodiscard]] inline std::int32_t material_of_kept(const InputMeshCase& input, std::int32_t block) {
  return input.grains + block;
}

// Collective. The cells of the mesh, dealt to ranks by chance, with units, but without exterior.
struct InputCells {
  HexMesh cells;
  std::vector<std::int32_t> block;
};
[[nodiscard]] InputCells input_cells(const Comm& comm, const WholeMesh& mesh, int layers = 2,
                                     std::uint64_t seed = 7);
// Collective. With exterior, fractions and assigned materials, and the hexes that stay.
[[nodiscard]] Overlay input_overlay(const Comm& comm, const InputMeshCase& input, int layers = 2);

// Collective. All stages on such cells.
[[nodiscard]] StagesResult run_stages(const Comm& comm, const InputMeshCase& input,
                                      const StageOptions& options = {});

// For a mesh of one rank alone: every exterior face is a face of one hex only, once, and lies on the surface
// of its facet as near as `distance`. closed: every face of one hex is an exterior face.
[[nodiscard]] std::string exterior_problem(const HexMesh& mesh, double distance, bool closed = true);

}  // namespace sculpt::test
