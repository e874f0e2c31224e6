#pragma once
// Writes a RankMesh to an Exodus file: as one of the files of a parallel run, or as a serial one.
#include <cstddef>
#include <functional>
#include <span>
#include <string>

#include "sculpt/exo/rank_mesh.hpp"

namespace sculpt {

struct ExodusTables {
  bool nemesis = true;      // the tables of a parallel run
  bool node_ids = true;     // node_num_map; may be left out when the ids are 1..N
  bool element_ids = true;  // elem_num_map; likewise
};

// The values of one element variable at one step, both from 0; valid until the next call. Steps ascend, and
// in each step the variables.
using ElementValues = std::function<std::span<const double>(std::size_t step, std::size_t variable)>;

// Throws as write_rank_file() does, and removes the file then. The values of element variables come from
// `values` and not from the mesh, so that they need not be in memory all at once.
void write_exodus(const std::string& path, const RankMesh& mesh, ExodusTables tables,
                  const ElementValues& values);

}  // namespace sculpt
