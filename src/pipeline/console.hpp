#pragma once
// What real Sculpt prints around the stages, and how its options turn into those of the stages.
#include <vector>

#include "sculpt/base/log.hpp"
#include "sculpt/contour/interface_smoothing.hpp"
#include "sculpt/deck/deck.hpp"
#include "sculpt/distribute/cartesian.hpp"
#include "sculpt/input/material_source.hpp"
#include "sculpt/quality/fidelity.hpp"
#include "sculpt/smooth/smooth.hpp"
#include "sculpt/write/side_set_stats.hpp"
#include "sculpt/write/write_mesh.hpp"

namespace sculpt {

// Whether interface nodes are to end on the geometry of the input.
[[nodiscard]] bool goes_to_geometry(const Deck& deck);
// pure_cells: every cell holds one material only (voxel data). exact: what the input knows of its surfaces.
[[nodiscard]] InterfaceSmoothing interface_smoothing(const Deck& deck, bool pure_cells,
                                                     const ExactSurface& exact);
[[nodiscard]] SmoothOptions smooth_options(const Deck& deck, bool pure_cells, const Vec3& cell_size);

void print_decomposition(const Log& log, const CartesianParts& parts);
void print_smoothing_banner(const Log& log, const Deck& deck);
void print_mesh_summary(const Comm& comm, const Log& log, const Deck& deck, const WriteSummary& written,
                        const QualityReport& report);
// The table of compare_volume: input, mesh and error in percent, for each material that is meshed and in all.
void print_volumes(const Log& log, const QualityReport& report);
// The table of compute_ss_stats.
void print_side_sets(const Log& log, std::span<const SideSetStats> stats,
                     const std::map<std::int64_t, std::string>& names);
// What remove_bad did; removed: hexes of each material.
void print_removed(const Log& log, const Deck& deck, const MaterialTable& materials,
                   const std::vector<std::int64_t>& removed);
// Collective.
void print_end(const Comm& comm, const Log& log, double seconds);

}  // namespace sculpt
