#pragma once
// Who owns which cells of a Cartesian grid, and the mesh of a rank's share (the report, section 2.4): boxes
// of cells with layers of ghost cells around them.
#include <array>
#include <vector>

#include "sculpt/grid/grid.hpp"
#include "sculpt/mesh/hex_mesh.hpp"
#include "sculpt/par/comm.hpp"

namespace sculpt {

// A grid cut into segments[0] x segments[1] x segments[2] boxes; ranks beyond their product own nothing.
struct CartesianParts {
  Index3 cells{0, 0, 0};
  std::array<bool, 3> periodic{false, false, false};  // axes that have no ends: cells[d] is 0 once more
  Index3 segments{1, 1, 1};
  std::array<std::vector<std::int64_t>, 3> cuts;  // segments[d]+1 ascending cell indices per axis

  [[nodiscard]] IndexBox owned(int rank) const;
  // The owned box and `layers` cells around it, inside the grid but on periodic axes; empty where nothing is
  // owned.
  [[nodiscard]] IndexBox ghosted(int rank, int layers) const;
  [[nodiscard]] int owner(const Index3& cell) const;  // of a cell of the grid
};

// Cuts that minimise the area between ranks; ties go to the smaller largest box, then to more segments in z,
// y, x (the splits of real Sculpt). user: segments fixed by iproc, jproc, kproc, 0 = free. If no factors of
// `ranks` fit the grid the largest smaller number that does is used. Throws Error when the user's segments do
// not fit.
[[nodiscard]] CartesianParts cut_grid(const Index3& cells, int ranks, const Index3& user);

// The cells per axis of the grid by whose i + nx (j + ny k) lattice_mesh numbers its cells (and likewise its
// nodes): that of `parts`, with `layers` cells more at both ends of periodic axes.
[[nodiscard]] Index3 numbered_grid(const CartesianParts& parts, int layers);

// Local. Period and quantum of the mesh of a grid with so many ghost layers; mesh.cell_size is known.
void set_period(HexMesh& mesh, const Grid& grid, const std::array<bool, 3>& periodic, int layers);

// Collective. This rank's cells with `layers` ghost layers; materials are left unset. On a periodic axis,
// which needs two cells at least, all of it goes on beyond the ends of the grid, with images.
[[nodiscard]] HexMesh lattice_mesh(const Comm& comm, const Grid& grid, const CartesianParts& parts,
                                   int layers);

}  // namespace sculpt
