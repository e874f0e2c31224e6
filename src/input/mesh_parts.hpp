#pragma once
// The files that decomp (or nem_spread, or IOSS) cuts a mesh into: whether they belong together, and the
// numbers of their nodes and elements in the undecomposed file.
#include <string>
#include <vector>

#include "sculpt/base/types.hpp"
#include "sculpt/exo/read_exodus.hpp"
#include "sculpt/par/comm.hpp"

namespace sculpt {

struct PartNumbers {
  std::vector<GlobalId> element, node;  // from 0, per element and node of this rank's file
};

// Collective. Throws AgreedError when the files were not made for this number of ranks, are of several
// meshes, or do not have each element once.
[[nodiscard]] PartNumbers numbers_of_parts(const Comm& comm, const std::string& path, ExodusReader& part);

}  // namespace sculpt
