#pragma once
// All sets of the mesh that is written, whichever option makes them: their ids, members and names
// (docs/boundary-conditions.md).
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "pipeline/overlay.hpp"
#include "sculpt/base/log.hpp"
#include "sculpt/deck/deck.hpp"
#include "sculpt/mesh/hex_mesh.hpp"
#include "sculpt/write/write_mesh.hpp"

namespace sculpt {

// Local. What to tell of options of sets that have no effect.
[[nodiscard]] std::vector<std::string> idle_set_options(const Deck& deck, const MaterialTable& materials);

// Local. Throws Error where two options make a set with one id. generated: the side sets of gen_sidesets,
// those of the input mesh among them.
void check_set_ids(const Deck& deck, std::span<const std::int64_t> generated, const InputSets& carried);

// Collective. Adds the sets of sideset, nodeset, periodic_nodesets and rve_sets to `faces` (those of
// gen_sidesets) and to the options, which have the names of the deck and the sets of an input mesh already.
// options.side_sets lists all side sets afterwards. `blocks`: ids of those that have hexes. Tells of empty
// sets and of names of sets that do not exist. Throws Error when a name is too long.
void add_mesh_sets(const Comm& comm, const Deck& deck, const HexMesh& mesh,
                   std::span<const std::int64_t> generated, std::span<const std::int64_t> blocks,
                   std::vector<SideFace>& faces, WriteOptions& options, const Log& log);

}  // namespace sculpt
