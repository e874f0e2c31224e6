#pragma once
// Hex meshes as input: made by the generators of the examples, written whole or in parts as decomp does.
#include <functional>
#include <string>
#include <vector>

#include "mesh.hpp"
#include "run_program.hpp"
#include "sculpt/exo/rank_mesh.hpp"
#include "support/exodus_mesh.hpp"

namespace sculpt::cli {

// The mesh of `hexmesh KIND --option value ...`.
[[nodiscard]] hexmesh::Mesh generated(const std::string& kind, const Words& options);
[[nodiscard]] test::ExodusMesh exodus_mesh(const hexmesh::Mesh& mesh);
[[nodiscard]] test::ExodusMesh exodus_mesh(const std::string& kind, const Words& options);

// Writes path.<ranks>.<rank> for all ranks; `rank_of` says to which an element, from 0, belongs.
void write_parts(const std::string& path, const test::ExodusMesh& mesh, int ranks,
                 const std::function<int(int)>& rank_of);

// Of a mesh as it was read, without regard to numbers: the corners of each hex of a block, sorted.
using HexPlaces = std::vector<std::array<std::array<double, 3>, 8>>;
[[nodiscard]] HexPlaces hexes_of_block(const RankMesh& mesh, std::int64_t id);
[[nodiscard]] HexPlaces hexes_of_block(const test::ExodusMesh& mesh, std::int64_t id);

}  // namespace sculpt::cli
