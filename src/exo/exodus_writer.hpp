#pragma once
// Writes a RankMesh to an Exodus file: as one of the files of a parallel run, or as a serial one.
#include <string>

#include "sculpt/exo/rank_mesh.hpp"
#include "sculpt/exo/write_rank_file.hpp"

namespace sculpt {

struct ExodusTables {
  bool nemesis = true;      // the tables of a parallel run
  bool node_ids = true;     // node_num_map; may be left out when the ids are 1..N
  bool element_ids = true;  // elem_num_map; likewise
};

// Throws as write_rank_file() does, and removes the file then. The values of element variables come from
// `values` and not from the mesh, so that they need not be in memory all at once.
void write_exodus(const std::string& path, const RankMesh& mesh, ExodusTables tables,
                  const ElementValues& values);

}  // namespace sculpt
