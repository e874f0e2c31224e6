#pragma once
// The kinds of meshes. Each takes its options and describes itself for the help.
#include <span>
#include <string>

#include "mesh.hpp"
#include "options.hpp"

namespace hexmesh {

struct Kind {
  const char* name;
  Mesh (*make)(Options&);
  const char* help;  // options with defaults, then what it is; lines of up to 110 characters
};

[[nodiscard]] std::span<const Kind> all_kinds();
[[nodiscard]] const Kind& kind_named(const std::string& name);  // throws std::runtime_error

// The mesh of a command line without its first word: the kind's own options and those of all kinds.
[[nodiscard]] Mesh make_mesh(const Kind& kind, Options& options);

}  // namespace hexmesh
