#pragma once
// The templates of all blocks met so far: each pattern is cut once. One store per process; looked up by one
// thread.
#include "adapt/block_template.hpp"

namespace sculpt {

[[nodiscard]] bool transition_exists(BlockPattern pattern, unsigned ends);
// Of a pattern for which a transition exists.
[[nodiscard]] const BlockTemplate& transition(BlockPattern pattern, unsigned ends);

}  // namespace sculpt
