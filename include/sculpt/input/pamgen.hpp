#pragma once
// A hex mesh that takes the place of the overlay grid, from a description in the language of Pamgen
// (input_mesh_pamgen): blocks, cylinders, parts of spheres, with side sets and node sets on their sides.
#include <string>

#include "sculpt/base/log.hpp"
#include "sculpt/input/input_mesh.hpp"
#include "sculpt/par/comm.hpp"

namespace sculpt {

// Collective. Every rank makes its own part, so that no rank holds the whole mesh; where Pamgen cannot cut a
// mesh in as many parts, the last ranks get nothing. Numbers and positions do not depend on the number of
// ranks. Blocks and sets have the ids of the description and no names. Prints a summary. Throws AgreedError
// with Pamgen's words, and the line where it tells one: no such file, a mistake in the description, bad
// hexes.
[[nodiscard]] InputMesh read_pamgen(const Comm& comm, const std::string& path, const Log& log);

}  // namespace sculpt
