#pragma once
// The diatom language (docs/shapes.md): packages of solids, each package of one material.
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "input/stl.hpp"

namespace sculpt {

struct DiatomSolid {
  std::unique_ptr<Shape> shape;  // null: the solid of an STL file
  std::size_t stl_file = 0;      // its position in DiatomFile::stl_files
};

struct DiatomInsert {
  std::int64_t line = 0;
  DiatomSolid solid;
  std::vector<DiatomSolid> deleted;  // taken out of this solid
};

struct DiatomPackage {
  std::string name;  // without one: package_<place in the file, from 1>
  std::int64_t line = 0;
  std::int64_t material = 0;  // >= 1
  std::vector<DiatomInsert> inserts;
  std::vector<DiatomSolid> deleted;  // taken out of all of its solids
};

struct DiatomFile {
  std::vector<DiatomPackage> packages;
  std::vector<StlFile> stl_files;
};

// Local. At least one insert; packages and inserts in the order of the file. `path` is for messages: Error
// with file and line.
[[nodiscard]] DiatomFile parse_diatom(std::string_view text, const std::string& path);

}  // namespace sculpt
