#pragma once
// Files of volume fractions (volfrac_file, input_vfrac): the cells of an overlay mesh as hexes, one element
// variable per material. docs/file-formats.md has the layout.
#include <optional>
#include <string>
#include <vector>

#include "sculpt/base/log.hpp"
#include "sculpt/input/material_source.hpp"
#include "sculpt/mesh/element_share.hpp"
#include "sculpt/par/comm.hpp"

namespace sculpt {

// The element variables of these materials, in their order: vfrac_<id>, of the void vfrac_void_<id>.
[[nodiscard]] std::vector<std::string> volfrac_names(const MaterialTable& materials);
// The materials that these names stand for, in their order; nothing when one is no such name, when two have
// one id, or when there are two voids.
[[nodiscard]] std::optional<MaterialTable> volfrac_materials(const std::vector<std::string>& names);

struct VolfracFiles {
  std::vector<std::string> names;  // the parts in the order of their ranks, or one joined file
  std::string block;               // name of their block: the option that had named the input
};

// Collective. Finds base.e.N.0 to base.e.N.<N-1> of any N, or else the joined file base.e. Throws
// AgreedError.
[[nodiscard]] VolfracFiles find_volfrac_files(const Comm& comm, const std::string& base, const Log& log);

// The cells of the files, each on one rank, with their fractions.
struct VolfracCells {
  ElementShare share;  // without values and blocks; the nodes that its elements use
  MaterialTable table;
  Fractions fractions;  // of the elements of the share, in their order
};

// Collective. Every rank reads an even part of the elements, one variable after the other. `base` is for
// messages. Throws AgreedError: damaged files, parts that do not fit together, fractions that are none.
[[nodiscard]] VolfracCells read_volfrac(const Comm& comm, const std::string& base, const VolfracFiles& files);

}  // namespace sculpt
