#pragma once
// The part of an unstructured hex mesh that a rank holds on the way from a file to its HexMesh: elements and
// nodes by their global numbers.
#include <array>
#include <cstdint>
#include <vector>

#include "sculpt/base/types.hpp"
#include "sculpt/base/vec3.hpp"

namespace sculpt {

// Every element of the mesh is on exactly one rank. Every node is on one rank or more, with the same position
// to the last bit, and not necessarily on those whose elements use it. Numbers run from 0 and do not depend
// on the number of ranks: they are positions in the undecomposed file.
struct ElementShare {
  GlobalId elements = 0, nodes = 0;             // of the whole mesh, all ranks
  std::vector<GlobalId> element;                // numbers, ascending
  std::vector<std::array<GlobalId, 8>> corner;  // per element: numbers of its nodes, Exodus corner order
  std::vector<std::int32_t> block;              // per element: index of its block
  int values_per_element = 0;                   // numbers that travel with each element
  std::vector<double> value;                    // values_per_element of each element, one after another
  std::vector<GlobalId> node;                   // numbers, ascending
  std::vector<Vec3> position;                   // per entry of node
};

}  // namespace sculpt
