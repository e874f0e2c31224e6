#pragma once
// Volume fractions on the cells of the overlay mesh: look-up, expansion layers (the report, 2.7.5), those of
// ghosts, and the fractions that agree with a filtered assignment. Local unless said otherwise.
#include <cstdint>
#include <span>

#include "sculpt/grid/index_box.hpp"
#include "sculpt/input/material_source.hpp"
#include "sculpt/mesh/hex_mesh.hpp"

namespace sculpt {

// The cells of `box` (a box of the grid grown by `expand` layers per side) with the fractions of the nearest
// cell of the source grid; `data` holds the cells of `source_box`, both x fastest.
[[nodiscard]] Fractions expand_fractions(const Fractions& data, const IndexBox& source_box,
                                         const IndexBox& box, std::int64_t expand,
                                         const Index3& source_cells);

// The source cells that `box` of the grown grid takes its data from.
[[nodiscard]] IndexBox source_of(const IndexBox& box, std::int64_t expand, const Index3& source_cells);

// Collective. The fractions of all local cells, from those of the owned cells (in local order): ghosts, and
// the images of a periodic mesh, have what their owners have.
[[nodiscard]] Fractions with_ghosts(const HexMesh& cells, const Fractions& owned);

// Fractions in which the assigned material of each cell is dominant: where the filter reassigned a cell the
// fractions of its former dominant material and of the new one are exchanged (section 3.1 of the stage's
// page: an edge crossing then exists on every interface face).
void follow_assignment(Fractions& fractions, std::span<const std::int32_t> material);

}  // namespace sculpt
