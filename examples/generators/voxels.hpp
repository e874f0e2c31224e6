#pragma once
// A box of voxels with one material id each, and the .spn file of it.
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace microstructure {

using Counts = std::array<std::int64_t, 3>;

// One value per voxel, z fastest, x slowest: the default order of an .spn file.
template <class T>
struct Box {
  Counts n;
  std::vector<T> values;

  explicit Box(const Counts& counts, T value = {})
      : n(counts), values(static_cast<std::size_t>(counts[0] * counts[1] * counts[2]), value) {}
  [[nodiscard]] T& at(std::int64_t i, std::int64_t j, std::int64_t k) { return values[index(i, j, k)]; }
  [[nodiscard]] const T& at(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return values[index(i, j, k)];
  }
  [[nodiscard]] std::size_t index(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return static_cast<std::size_t>(k + n[2] * (j + n[1] * i));
  }
};

using Voxels = Box<std::int32_t>;

// Writes text to a file; throws std::runtime_error and removes the file when that fails.
void write_text(const std::string& path, const std::string& text);
// One row of the file per row of voxels along z.
void write_spn(const std::string& path, const Voxels& voxels);

}  // namespace microstructure
