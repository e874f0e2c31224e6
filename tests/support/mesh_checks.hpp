#pragma once
// What a finished mesh must satisfy (docs/architecture.md, invariants). Each check answers with the first
// problem in words; empty = none, so that EXPECT_EQ(problem(...), "") shows it.
#include <cstdint>
#include <string>
#include <vector>

#include "sculpt/grid/grid.hpp"
#include "sculpt/mesh/hex_mesh.hpp"

namespace sculpt::test {

// For the mesh of one rank alone: every face has one or two hexes that see it from opposite sides, the
// boundary is closed, no node is unused, ids ascend, nodes of one colour share no hex unless they stem from
// one grid node. pillows: how often the mesh was pillowed; of the box: how often with the box wrapped.
[[nodiscard]] std::string conformity_problem(const HexMesh& mesh, int pillows = 1, int of_the_box = 0);
// For the mesh of a box of one rank alone: faces with one hex are exactly the faces on the sides of the box.
[[nodiscard]] std::string boundary_problem(const HexMesh& mesh);
// Nodes of a box side stand on it to the last bit, nodes inside the box stand inside.
[[nodiscard]] std::string box_problem(const HexMesh& mesh, const Grid& grid);
// Collective: ghosts are equal to what their owners have, every ghost layer is as deep as promised; images
// are in addition their owners' hexes translated without rounding.
[[nodiscard]] std::string ghost_problem(const HexMesh& mesh);

[[nodiscard]] double volume(const Grid& grid);
// Local, owned hexes.
[[nodiscard]] std::vector<double> volumes(const HexMesh& mesh, std::int32_t materials);
[[nodiscard]] double volume(const HexMesh& mesh);
[[nodiscard]] double least_scaled_jacobian(const HexMesh& mesh);
[[nodiscard]] std::int64_t owned_hexes(const HexMesh& mesh);
// Pairs of hexes of different materials that share a face, by nodes; one rank alone.
[[nodiscard]] std::int64_t interface_faces(const HexMesh& mesh);

// Collective: a number made from the ids, nodes, materials and coordinates (to the last bit) of the owned
// hexes of all ranks, whichever rank owns which.
[[nodiscard]] std::int64_t checksum(const Comm& comm, const HexMesh& mesh);

}  // namespace sculpt::test
