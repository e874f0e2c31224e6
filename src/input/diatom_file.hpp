#pragma once
// The diatom language (Appendix K of the report): packages of shapes, each package of one material.
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sculpt/geom/shape.hpp"

namespace sculpt {

struct DiatomShape {
  std::unique_ptr<Shape> shape;  // null: what an STL file holds
  std::int64_t material = 0;     // the user's id, >= 1
  std::string stl_file;
  std::int64_t line = 0;  // where it is inserted
  std::string package{};  // its name; of one without: package_<place in the file, from 1>
};

// Local. The shapes in the order of insertion, at least one. `path` is for messages: Error with file and
// line.
[[nodiscard]] std::vector<DiatomShape> parse_diatom(std::string_view text, const std::string& path);

}  // namespace sculpt
