#pragma once
// A list cut into contiguous parts whose sizes differ by one at most: part p has the items
// [items p / parts, items (p + 1) / parts).
#include <cstddef>
#include <cstdint>

namespace sculpt {

struct EvenParts {
  std::int64_t items = 0;  // items * parts must fit
  int parts = 1;

  [[nodiscard]] std::int64_t begin(int part) const { return items * part / parts; }
  [[nodiscard]] std::int64_t end(int part) const { return begin(part + 1); }
  [[nodiscard]] std::size_t size(int part) const { return static_cast<std::size_t>(end(part) - begin(part)); }
  [[nodiscard]] bool contains(std::int64_t item) const { return item >= 0 && item < items; }
  // The part that has an item of 0 .. items-1.
  [[nodiscard]] std::size_t part_of(std::int64_t item) const {
    return static_cast<std::size_t>(((item + 1) * parts - 1) / items);
  }
};

}  // namespace sculpt
