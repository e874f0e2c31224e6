#pragma once
// Unstructured meshes that do not fit together, with what check_conformity says of them.
#include <string>
#include <vector>

#include "support/shares.hpp"

namespace sculpt::test {

struct FaultyMesh {
  WholeMesh mesh;
  std::string message;
};
[[nodiscard]] std::vector<FaultyMesh> faulty_meshes();
[[nodiscard]] std::vector<WholeMesh> conforming_meshes();

// Collective. What check_conformity throws, with blocks 10, 20, 30; empty: nothing.
[[nodiscard]] std::string conformity_message(const Comm& comm, const ElementShare& share);

}  // namespace sculpt::test
