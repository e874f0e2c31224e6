#include "voxels.hpp"

#include <charconv>
#include <cstdio>
#include <stdexcept>

namespace microstructure {

void write_text(const std::string& path, const std::string& text) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) throw std::runtime_error("cannot write " + path);
  const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  if (std::fclose(file) == 0 && written) return;
  std::remove(path.c_str());
  throw std::runtime_error("cannot write all of " + path);
}

void write_spn(const std::string& path, const Voxels& voxels) {
  std::string text;
  text.reserve(4 * voxels.values.size());
  char digits[16];
  std::int64_t column = 0;
  for (const std::int32_t id : voxels.values) {
    text.append(digits, std::to_chars(digits, digits + sizeof digits, id).ptr);
    text += ++column % voxels.n[2] == 0 ? '\n' : ' ';
  }
  write_text(path, text);
}

}  // namespace microstructure
