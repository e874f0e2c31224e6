#include "sculpt/input/element_fractions.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include "sculpt/par/finding.hpp"

namespace sculpt {
namespace {

constexpr double kTolerance = 1e-6, kSinglePrecision = 1e-7;
constexpr double kAbsent = 1e-12;
constexpr double kRounding = 1e-12;  // of sums in double precision

// The number at the end of a name; 0 when there is none that an id can be.
std::int64_t trailing_number(const std::string& name) {
  const auto digits = name.find_last_not_of("0123456789") + 1;  // npos + 1 == 0
  std::int32_t number = 0;
  const char* const end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data() + digits, end, number);
  return error == std::errc{} && stop == end ? number : 0;
}

std::vector<std::int64_t> ids_of(std::span<const std::string> variables) {
  std::vector<std::int64_t> ids;
  for (const std::string& name : variables) ids.push_back(trailing_number(name));
  std::vector<std::int64_t> sorted = ids;
  std::sort(sorted.begin(), sorted.end());
  const bool distinct = std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
  if (!distinct || sorted.front() < 1) std::iota(ids.begin(), ids.end(), std::int64_t{1});
  return ids;
}

// The entries of a cell.
struct Cell {
  std::span<const std::int32_t> variable;
  std::span<const double> value;
};
Cell cell_of(const Fractions& f, std::size_t c) {
  const auto from = static_cast<std::size_t>(f.offset[c]);
  const std::size_t count = static_cast<std::size_t>(f.offset[c + 1]) - from;
  return {std::span(f.material).subspan(from, count), std::span(f.value).subspan(from, count)};
}

// What is wrong with the values of an element; empty when nothing is.
std::string complaint(std::span<const std::string> variables, const Cell& cell) {
  double sum = 0;
  for (std::size_t e = 0; e < cell.value.size(); ++e) {
    const double value = cell.value[e];
    if (!(value >= -kTolerance && value <= 1 + kTolerance))
      return fmt::format("fraction {} of variable '{}', expected 0 to 1", value,
                         variables[static_cast<std::size_t>(cell.variable[e])]);
    sum += value;
  }
  if (std::fabs(sum - 1) <= kTolerance + kSinglePrecision * static_cast<double>(variables.size())) return {};
  return fmt::format("the fractions of its materials sum to {:.9g}, expected 1", sum);
}

// Collective. Throws what is wrong with the element that has the lowest number.
void refuse_wrong(const Comm& comm, const std::string& path, std::span<const std::string> variables,
                  std::span<const GlobalId> element, const Fractions& found) {
  Finding bad;
  for (std::size_t e = 0; e < element.size(); ++e) {
    if (element[e] >= bad.at) continue;
    const std::string text = complaint(variables, cell_of(found, e));
    if (!text.empty()) bad = {element[e], fmt::format("'{}', element {}: {}", path, element[e] + 1, text)};
  }
  refuse_first(comm, bad);
}

// Whether nothing is to be changed: positive, and 1 in double precision.
bool is_exact(const Cell& cell) {
  double sum = 0;
  for (const double value : cell.value) {
    if (value < 0) return false;
    sum += value;
  }
  return std::fabs(sum - 1) <= kRounding;
}

// Appends a cell of fractions that are right up to single precision.
void add_normalised(const Cell& cell, Fractions& to) {
  const auto fraction = [&](std::size_t e) {
    return cell.value[e] < kAbsent ? 0.0 : std::min(cell.value[e], 1.0);
  };
  double sum = 0;
  for (std::size_t e = 0; e < cell.value.size(); ++e) sum += fraction(e);
  for (std::size_t e = 0; e < cell.value.size(); ++e)
    if (fraction(e) > 0) to.add(cell.variable[e], fraction(e) / sum);
  to.end_cell();
}

void add_as_it_is(const Cell& cell, Fractions& to) {
  for (std::size_t e = 0; e < cell.value.size(); ++e) to.add(cell.variable[e], cell.value[e]);
  to.end_cell();
}

}  // namespace

Fractions checked_fractions(const Comm& comm, const std::string& path, std::span<const std::string> variables,
                            std::span<const GlobalId> element, Fractions found) {
  refuse_wrong(comm, path, variables, element, found);
  Fractions fractions;
  fractions.reserve(element.size(), found.material.size());
  for (std::size_t e = 0; e < element.size(); ++e) {
    const Cell cell = cell_of(found, e);
    if (is_exact(cell))
      add_as_it_is(cell, fractions);
    else
      add_normalised(cell, fractions);
  }
  return fractions;
}

ElementFractions element_fractions(const Comm& comm, const std::string& path,
                                   std::span<const std::string> variables, std::span<const GlobalId> element,
                                   std::span<const double> value) {
  const std::size_t k = variables.size();
  if (k == 0)
    throw AgreedError(
        fmt::format("'{}' has no element variables, expected the fractions of the materials", path));
  collectively(comm, "reading fractions of elements", [&] {
    check(value.size() == k * element.size(), "an element needs a value of each variable");
  });

  ElementFractions result;
  const std::vector<std::int64_t> ids = ids_of(variables);
  std::vector<std::size_t> order(k);  // variable of each material
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return ids[a] < ids[b]; });
  std::vector<std::string> names;
  for (const std::size_t v : order) {
    result.table.block_id.push_back(ids[v]);
    names.push_back(variables[v]);
  }
  Fractions found;
  for (std::size_t e = 0; e < element.size(); ++e) {
    for (std::size_t m = 0; m < k; ++m)
      if (const double v = value[k * e + order[m]]; v != 0) found.add(static_cast<std::int32_t>(m), v);
    found.end_cell();
  }
  result.fractions = checked_fractions(comm, path, names, element, std::move(found));
  return result;
}

}  // namespace sculpt
