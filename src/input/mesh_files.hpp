#pragma once
// Which files of an Exodus mesh the ranks read: the whole mesh, or the parts that decomp cuts it into.
#include <string>
#include <vector>

#include "sculpt/base/log.hpp"
#include "sculpt/par/comm.hpp"

namespace sculpt {

struct MeshFiles {
  bool parts = false;  // one for each rank
  std::string mine;    // what this rank opens
  std::string shown;   // for the summary
};

// Collective. Throws AgreedError that says what was found and expected.
[[nodiscard]] MeshFiles find_mesh_files(const Comm& comm, const std::string& path, const Log& log);

// Collective. The files of a mesh that any number of ranks has written: path.N.0 to path.N.<N-1>, otherwise
// `path` itself. Throws AgreedError: there are none, some are missing, or there are those of several N.
[[nodiscard]] std::vector<std::string> find_parts_of_any_number(const Comm& comm, const std::string& path,
                                                                const Log& log);

// The advice of messages: how to make the parts for so many ranks.
[[nodiscard]] std::string decomp_command(const std::string& path, int ranks);

}  // namespace sculpt
