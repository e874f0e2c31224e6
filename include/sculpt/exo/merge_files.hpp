#pragma once
// Joins the rank files base.e.N.r of a parallel run into one serial Exodus file, as SEACAS `epu` does: nodes
// sorted by global id and each written once, blocks with the elements of all ranks sorted by global id, sets
// the same way. The joined mesh does not depend on the number of ranks. Unlike epu it also joins a single
// file (N = 1), keeps the title, and refuses files that do not fit together. Element variables are
// joined at all time steps; other variables and distribution factors are left out.
#include <cstddef>
#include <cstdint>
#include <string>

namespace sculpt {

struct MergeOptions {
  std::string extension = "e";   // of the rank files
  std::string output_extension;  // of the joined file; empty = extension
  std::string output;            // whole name of the joined file; empty = base.output_extension
};

struct MergeResult {
  std::string path;
  std::int64_t nodes = 0, elements = 0;
  std::size_t blocks = 0, side_sets = 0, node_sets = 0;
  std::size_t element_variables = 0, time_steps = 0;
  int dropped_variables = 0;  // global ones, and those of nodes and sets, in the first file
};

// Local. The joined mesh and the values of one time step are held in memory beside one rank file. It is
// written under a temporary name; on failure an earlier file stays as it was. Throws Error: a rank file is
// missing or damaged, files of different runs, a shared node in two places, an element twice.
MergeResult merge_files(const std::string& base, int ranks, const MergeOptions& options = {});

}  // namespace sculpt
