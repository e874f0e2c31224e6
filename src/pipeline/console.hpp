#pragma once
// What real Sculpt prints around the stages, and how its options turn into those of the stages.
#include <vector>

#include "sculpt/base/log.hpp"
#include "sculpt/contour/interface_smoothing.hpp"
#include "sculpt/deck/deck.hpp"
#include "sculpt/distribute/cartesian.hpp"
#include "sculpt/input/material_source.hpp"
#include "sculpt/smooth/smooth.hpp"
#include "sculpt/write/write_mesh.hpp"

namespace sculpt {

// pure_cells: every cell holds one material only (voxel data). exact: what the input knows of its surfaces.
[[nodiscard]] InterfaceSmoothing interface_smoothing(const Deck& deck, bool pure_cells,
                                                     const ExactSurface& exact);
[[nodiscard]] SmoothOptions smooth_options(const Deck& deck, bool pure_cells, const Vec3& cell_size);

void print_decomposition(const Log& log, const CartesianParts& parts);
void print_smoothing_banner(const Log& log, const Deck& deck);
// Collective.
void print_mesh_summary(const Comm& comm, const Log& log, const Deck& deck, const WriteSummary& written,
                        const QualitySummary& quality);
void print_end(const Comm& comm, const Log& log, double seconds);

// Volume of each material by its volume fractions; compare_volume sets it beside that of the mesh.
class VolumeTable {
 public:
  // Collective.
  VolumeTable(const Comm& comm, const HexMesh& cells, const Fractions& fractions,
              const MaterialTable& materials);
  void compare(const Comm& comm, const HexMesh& mesh, const Log& log) const;

 private:
  std::vector<std::int64_t> block_id_;
  std::vector<double> volume_;
};

}  // namespace sculpt
