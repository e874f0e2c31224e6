#include "sculpt/deck/options.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>

#include "deck/table.hpp"
#include "deck/text.hpp"

namespace sculpt {

namespace {

constexpr GroupSpec kGroups[] = {
    {Group::kProcess, "Process Control", "process", "pc"},
    {Group::kInput, "Input Data Files", "input", "inp"},
    {Group::kOutput, "Output", "output", "out"},
    {Group::kOverlay, "Overlay Grid Specification", "overlay", "ovr", "bbox", "box"},
    {Group::kType, "Mesh Type", "type", "typ"},
    {Group::kBoundaryCondition, "Boundary Conditions", "boundary_condition", "bc"},
    {Group::kAdapt, "Adaptive Meshing", "adapt", "adp"},
    {Group::kSmoothing, "Smoothing", "smoothing", "smo"},
    {Group::kImprove, "Mesh Improvement", "improve", "imp"},
    {Group::kTransform, "Mesh Transformation", "transform", "tfm"},
    {Group::kBoundaryLayer, "Boundary Layers", "boundary_layer", "bly"},
};

std::vector<OptionSpec> join_groups() {
  std::vector<OptionSpec> table;
  for (const auto& rows : {process_options(), input_options(), output_options(), overlay_options(),
                           type_options(), boundary_condition_options(), adapt_options(), smoothing_options(),
                           improve_options(), transform_options(), boundary_layer_options()})
    table.insert(table.end(), rows.begin(), rows.end());
  return table;
}

// Levenshtein distance: insertions, deletions and replacements of one character.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

}  // namespace

std::span<const GroupSpec> option_groups() { return kGroups; }

std::span<const OptionSpec> option_table() {
  static const std::vector<OptionSpec> table = join_groups();
  return table;
}

const OptionSpec* find_option(std::string_view long_name) {
  const std::string wanted = lower(long_name);
  for (const OptionSpec& option : option_table())
    if (option.name == wanted) return &option;
  return nullptr;
}

const OptionSpec* find_flag(std::string_view flag) {
  if (flag.empty()) return nullptr;
  for (const OptionSpec& option : option_table())
    if (option.flag == flag) return &option;
  return nullptr;
}

std::string did_you_mean(std::string_view word, std::span<const std::string> candidates) {
  const std::size_t reach =
      word.size() <= 4 ? 1 : std::max<std::size_t>(2, word.size() / 3);  // farther: no help
  std::string_view nearest;
  std::size_t least = 0;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(lower(word), lower(candidate));
    const std::size_t score = 100 * distance + edit_distance(word, candidate);  // case decides between equals
    if (distance > reach || (!nearest.empty() && score >= least)) continue;
    least = score;
    nearest = candidate;
  }
  return nearest.empty() ? std::string() : fmt::format("; did you mean '{}'?", nearest);
}

std::string did_you_mean_option(std::string_view word, std::string_view prefix) {
  std::vector<std::string> names;
  for (const OptionSpec& option : option_table())
    if (!option.hidden) names.push_back(std::string(prefix) + std::string(option.name));
  return did_you_mean(word, names);
}

}  // namespace sculpt
