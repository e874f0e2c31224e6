#pragma once
// A hex mesh that takes the place of the overlay grid (input_mesh): read from Exodus files, each rank its
// part.
#include <cstdint>
#include <string>
#include <vector>

#include "sculpt/base/log.hpp"
#include "sculpt/mesh/element_share.hpp"
#include "sculpt/par/comm.hpp"

namespace sculpt {

struct InputMesh {
  struct Block {
    std::int64_t id = 0;
    std::string name;  // empty = none
    bool operator==(const Block&) const = default;
  };
  // This rank's portion of the entries: each entry is on one rank, on any.
  struct SideSet {
    std::int64_t id = 0;
    std::string name;
    std::vector<GlobalId> element;
    std::vector<std::int32_t> face;  // of the element: index into kFaces, the Exodus side - 1
  };
  // This rank's portion; a node may be listed by several ranks.
  struct NodeSet {
    std::int64_t id = 0;
    std::string name;
    std::vector<GlobalId> node;
  };

  // Its values are those of the element variables, in the order of `variables`, at the last step; 0 where a
  // block has none. Every hex has eight different nodes at finite positions and is right-handed at all
  // corners.
  ElementShare share;
  bool decomposed = false;    // from files of decomp: the share is the partition to use
  std::vector<Block> blocks;  // the same on every rank, in the order of the file, as the next three
  std::vector<SideSet> side_sets;
  std::vector<NodeSet> node_sets;
  std::vector<std::string> variables;  // element variables; none when the file has no step
};

// Collective. Reads `path`, or its parts path.P.0 to path.P.<P-1> where they exist on P > 1 ranks. Of a whole
// file rank r takes the r-th of P even parts of the elements (in the order of the file, across blocks), of
// the nodes and of each set; of parts each rank takes its own. Prints which files, and a summary. Throws
// AgreedError: files are missing, damaged or do not fit together, anything but hexes, bad hexes.
[[nodiscard]] InputMesh read_input_mesh(const Comm& comm, const std::string& path, const Log& log);

// Collective. Throws AgreedError that counts the hexes with a corner determinant of 0 or less and describes
// the one with the smallest number. read_input_mesh() has called it; `path` is for the message.
void check_hexes(const Comm& comm, const InputMesh& mesh, const std::string& path);

}  // namespace sculpt
