#pragma once
// Writes the finished mesh, one Exodus file per rank (docs/file-formats.md). Global ids run from 1 and do not
// depend on the number of ranks; the files appear under their final names only when all ranks have written
// theirs.
#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "sculpt/mesh/hex_mesh.hpp"

namespace sculpt {

// A face of a local hex that belongs to a side set.
struct SideFace {
  std::int64_t set;
  LocalId hex;
  std::int32_t face;  // kFaces index
};

// A number for every hex, in the files as an element variable at time 0.
struct HexVariable {
  std::string name;
  std::function<double(LocalId hex)> value;  // asked of owned hexes
};

// The nodes of a set.
struct NodeSet {
  std::int64_t id;
  std::vector<LocalId> node;  // ascending, all that hexes of this rank use; others do not count
};

struct WriteOptions {
  std::string base;                    // files base.e.N.r
  bool large = false;                  // 64-bit integers on disk
  std::vector<std::int64_t> block_id;  // of each dense material index
  std::map<std::int64_t, std::string> block_names, side_set_names, node_set_names;
  std::vector<std::int64_t> side_sets;  // ids of those that appear even without a face
  std::vector<NodeSet> node_sets;
  std::vector<HexVariable> variables;
};

struct WriteSummary {
  std::int64_t nodes = 0, hexes = 0;
  std::size_t blocks = 0, node_sets = 0, side_sets = 0;
};

// Collective. side_faces: of owned hexes, each once. Throws AgreedError when a file cannot be written
// anywhere.
WriteSummary write_mesh(const Comm& comm, const HexMesh& mesh, const std::vector<SideFace>& side_faces,
                        const WriteOptions& options);

// Collective. Fails where a run could not write the files base.e.N.r, which an option names, before any work
// is done.
void check_output_folder(const Comm& comm, const std::string& option, const std::string& base);
// Collective. The same for a single file that an option names.
void check_output_file(const Comm& comm, const std::string& option, const std::string& file_name);

}  // namespace sculpt
