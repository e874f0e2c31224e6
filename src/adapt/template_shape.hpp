#pragma once
// Better places for the nodes inside a block in transition. Pure.
#include "adapt/block_template.hpp"

namespace sculpt {

// Moves the interior nodes until the worst corners around them are as good as they get by a few careful
// passes: to the middle of their neighbours, or a little along an axis, where that raises the worst corner.
// Nodes on a middle plane where the block ends (bits of `ends`) stay on it.
void relax_interior(BlockTemplate& block, unsigned ends);

}  // namespace sculpt
