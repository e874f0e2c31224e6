#include "sculpt/input/element_fractions.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>

namespace sculpt {
namespace {

constexpr double kTolerance = 1e-6, kSinglePrecision = 1e-7;
constexpr double kAbsent = 1e-12;

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

// What is wrong with the values of an element; empty when nothing is.
std::string complaint(std::span<const std::string> variables, std::span<const double> value) {
  double sum = 0;
  for (std::size_t v = 0; v < value.size(); ++v) {
    if (!(value[v] >= -kTolerance && value[v] <= 1 + kTolerance))
      return fmt::format("fraction {} of variable '{}', expected 0 to 1", value[v], variables[v]);
    sum += value[v];
  }
  if (std::fabs(sum - 1) <= kTolerance + kSinglePrecision * static_cast<double>(value.size())) return {};
  return fmt::format("the fractions of its materials sum to {:.9g}, expected 1", sum);
}

// Collective. Throws what is wrong with the element that has the lowest number.
void refuse_wrong(const Comm& comm, const std::string& path, std::span<const std::string> variables,
                  std::span<const GlobalId> element, std::span<const double> value) {
  constexpr GlobalId kNoElement = std::numeric_limits<GlobalId>::max();
  const std::size_t k = variables.size();
  GlobalId lowest = kNoElement;
  std::string text;
  for (std::size_t e = 0; e < element.size(); ++e) {
    if (element[e] >= lowest) continue;
    const std::string found = complaint(variables, value.subspan(k * e, k));
    if (found.empty()) continue;
    lowest = element[e];
    text = fmt::format("'{}', element {}: {}", path, lowest + 1, found);
  }
  const GlobalId first = comm.min(lowest);
  if (first == kNoElement) return;
  const auto root = static_cast<int>(comm.min(std::int64_t{lowest == first ? comm.rank() : comm.size()}));
  throw AgreedError(comm.broadcast(text, root));
}

}  // namespace

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
  refuse_wrong(comm, path, variables, element, value);

  ElementFractions result;
  const std::vector<std::int64_t> ids = ids_of(variables);
  std::vector<std::size_t> order(k);  // variable of each material
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return ids[a] < ids[b]; });
  for (const std::size_t v : order) result.table.block_id.push_back(ids[v]);

  Fractions& fractions = result.fractions;
  fractions.reserve(element.size(), element.size() + element.size() / 8);
  for (std::size_t e = 0; e < element.size(); ++e) {
    const std::span<const double> of = value.subspan(k * e, k);
    const auto fraction = [&](std::size_t m) {
      return of[order[m]] < kAbsent ? 0.0 : std::min(of[order[m]], 1.0);
    };
    double sum = 0;
    for (std::size_t m = 0; m < k; ++m) sum += fraction(m);
    for (std::size_t m = 0; m < k; ++m)
      if (fraction(m) > 0) fractions.add(static_cast<std::int32_t>(m), fraction(m) / sum);
    fractions.end_cell();
  }
  return result;
}

}  // namespace sculpt
