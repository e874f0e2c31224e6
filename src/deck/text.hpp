#pragma once
// Small functions on words: case, numbers, booleans.
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sculpt {

inline std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

inline bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }

// The whole word as a number; nothing when it is none, is out of range, infinite or followed by something
// else.
template <class Number>
std::optional<Number> to_number(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  Number value{};
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (code != std::errc() || end != word.data() + word.size()) return std::nullopt;
  if constexpr (std::is_floating_point_v<Number>) {
    if (!std::isfinite(value)) return std::nullopt;
  }
  return value;
}

inline std::optional<bool> to_bool(std::string_view word) {
  const std::string w = lower(word);
  if (w == "true" || w == "on" || w == "yes" || w == "1") return true;
  if (w == "false" || w == "off" || w == "no" || w == "0") return false;
  return std::nullopt;
}

}  // namespace sculpt
