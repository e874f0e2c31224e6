#include "fractions.hpp"

#include <algorithm>
#include <charconv>

namespace microstructure {
namespace {

constexpr std::int32_t kWeights[5] = {1, 2, 4, 2, 1};

using Counted = Box<std::int32_t>;

// Voxels of one material in each cell, 0 .. 8.
Counted count_voxels(const Voxels& fine, std::int32_t material) {
  Counted counts({fine.n[0] / 2, fine.n[1] / 2, fine.n[2] / 2});
  for (std::int64_t i = 0; i < 2 * counts.n[0]; ++i)
    for (std::int64_t j = 0; j < 2 * counts.n[1]; ++j)
      for (std::int64_t k = 0; k < 2 * counts.n[2]; ++k)
        counts.at(i / 2, j / 2, k / 2) += fine.at(i, j, k) == material;
  return counts;
}

// Weighted sum along one axis; the weights add up to 10.
void spread(Counted& field, std::size_t axis) {
  const Counted before = field;
  Counts c;
  for (c[0] = 0; c[0] < field.n[0]; ++c[0])
    for (c[1] = 0; c[1] < field.n[1]; ++c[1])
      for (c[2] = 0; c[2] < field.n[2]; ++c[2]) {
        std::int32_t sum = 0;
        for (std::int64_t w = 0; w < 5; ++w) {
          Counts near = c;
          near[axis] = std::clamp<std::int64_t>(c[axis] + w - 2, 0, field.n[axis] - 1);
          sum += kWeights[w] * before.at(near[0], near[1], near[2]);
        }
        field.at(c[0], c[1], c[2]) = sum;
      }
}

void append_integer(std::string& text, std::int64_t value) {
  char digits[24];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

// eighths / 8000 as a decimal without trailing zeros.
void append_fraction(std::string& text, std::int32_t eighths) {
  if (eighths == 0 || eighths == 8000) {
    text += eighths == 0 ? '0' : '1';
    return;
  }
  std::string digits = std::to_string(1000000 + eighths * 125);
  digits[0] = '.';
  digits.erase(digits.find_last_not_of('0') + 1);
  text += '0';
  text += digits;
}

std::string header(const Counts& n, std::int32_t materials) {
  std::string text = "TITLE = \"Volume fractions\"\nVARIABLES = \"X\", \"Y\", \"Z\"";
  for (std::int32_t m = 1; m <= materials; ++m) text += ", \"VF" + std::to_string(m) + "\"";
  return text + "\nZONE I=" + std::to_string(n[0]) + ", J=" + std::to_string(n[1]) +
         ", K=" + std::to_string(n[2]) + ", DATAPACKING=POINT\n";
}

}  // namespace

void write_fractions(const std::string& path, const Voxels& fine, std::int32_t materials) {
  std::vector<Counted> fields;
  for (std::int32_t m = 1; m <= materials; ++m) {
    fields.push_back(count_voxels(fine, m));
    for (std::size_t axis = 0; axis < 3; ++axis) spread(fields.back(), axis);
  }
  const Counts n = fields.front().n;
  std::string text = header(n, materials);
  for (std::int64_t k = 0; k < n[2]; ++k)
    for (std::int64_t j = 0; j < n[1]; ++j)
      for (std::int64_t i = 0; i < n[0]; ++i) {
        for (const std::int64_t centre : {i, j, k}) {
          append_integer(text, centre);
          text += ' ';
        }
        for (const Counted& field : fields) {
          append_fraction(text, field.at(i, j, k));
          text += ' ';
        }
        text.back() = '\n';
      }
  write_text(path, text);
}

}  // namespace microstructure
