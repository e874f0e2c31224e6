#pragma once
// The diatom language (Appendix K of the report): packages of shapes, each package of one material.
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "input/shape_source.hpp"

namespace sculpt {

// Local. The shapes in the order of insertion, at least one. `path` is for messages: Error with file and
// line.
[[nodiscard]] std::vector<MaterialShape> parse_diatom(std::string_view text, const std::string& path);

}  // namespace sculpt
