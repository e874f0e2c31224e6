#pragma once
// The header of a Tecplot point file: TITLE, VARIABLES and ZONE, in the usual spellings.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sculpt/grid/index_box.hpp"

namespace sculpt {

struct TecHeader {
  std::vector<std::string> variables;  // x, y, z, then one per material
  Index3 cells{0, 0, 0};               // I, J, K of the zone
  std::size_t data_begin = 0;          // the first number starts here
};

// Parses the header at the beginning of `text`; `path` is for messages. Error with file and line.
[[nodiscard]] TecHeader parse_tec_header(std::string_view text, const std::string& path);

}  // namespace sculpt
