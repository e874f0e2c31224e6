#pragma once
// Whether the elements of an unstructured mesh fit together.
#include <cstdint>
#include <vector>

#include "sculpt/mesh/element_share.hpp"
#include "sculpt/par/comm.hpp"

namespace sculpt {

// Collective. Throws AgreedError, with numbers from 1 and a place, the same for any number of ranks, when
//   - an element has a node twice,
//   - a face has three elements or more, or two that do not see it from opposite sides,
//   - two nodes of exterior faces lie at the same place (within 1e-6 of the shortest edge there),
//   - a node of an exterior face lies in another exterior face or on its edge (within 1e-6 of the geometric
//     mean of its shortest and longest edge), so that it hangs,
//   - two exterior faces look at each other and share opposite corners, so that they are one face but for the
//     others.
// What comes first in this list is reported, of that the smallest numbers. block_ids: by which the message
// names the blocks of elements; empty: not named. Quick where neighbours are mostly on one rank
// (repartition).
void check_conformity(const Comm& comm, const ElementShare& share,
                      const std::vector<std::int64_t>& block_ids = {});

}  // namespace sculpt
