#pragma once
// The pieces of the option table, group by group.
#include <span>

#include "sculpt/deck/options.hpp"

namespace sculpt {

inline constexpr double kMaxId = 2147483647;  // block and set ids
inline constexpr double kMaxCount = 1000000000;
inline constexpr double kMinNorm = -1, kMaxNorm = 1;  // range of the scaled Jacobian

[[nodiscard]] std::span<const OptionSpec> process_options();
[[nodiscard]] std::span<const OptionSpec> input_options();
[[nodiscard]] std::span<const OptionSpec> output_options();
[[nodiscard]] std::span<const OptionSpec> overlay_options();
[[nodiscard]] std::span<const OptionSpec> type_options();
[[nodiscard]] std::span<const OptionSpec> boundary_condition_options();
[[nodiscard]] std::span<const OptionSpec> adapt_options();
[[nodiscard]] std::span<const OptionSpec> smoothing_options();
[[nodiscard]] std::span<const OptionSpec> improve_options();
[[nodiscard]] std::span<const OptionSpec> transform_options();
[[nodiscard]] std::span<const OptionSpec> boundary_layer_options();

}  // namespace sculpt
