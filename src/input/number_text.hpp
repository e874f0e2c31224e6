#pragma once
// Numbers in text: the two kinds of token that large input files are made of, and how they are scanned. A
// kind has Value, parse(p, end, value) -> the character after the number or nullptr, and expected() for
// messages.
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sculpt {

[[nodiscard]] inline bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

// Non-negative integers that fit 32 bits: material ids.
struct IntegerText {
  using Value = std::int32_t;
  [[nodiscard]] static bool separates(char c) { return is_blank(c); }
  [[nodiscard]] static const char* parse(const char* p, const char* /*end*/, Value& value) {
    // The text ends with a character that is no digit, so the loop needs no bound.
    const char* const start = p;
    std::uint64_t n = 0;
    for (unsigned digit; (digit = static_cast<unsigned>(*p) - unsigned{'0'}) < 10; ++p) n = n * 10 + digit;
    constexpr int kDigitsThatFit = 19;
    if (p == start || p - start > kDigitsThatFit || n > INT32_MAX) return nullptr;
    value = static_cast<Value>(n);
    return p;
  }
  [[nodiscard]] static std::string expected() { return "an integer from 0 to 2147483647"; }
};

// Real numbers in C or Fortran notation (1.5, +2e-3, 1.D+00); inf and nan are left to the reader of the
// numbers.
struct RealText {
  using Value = double;
  [[nodiscard]] static bool separates(char c) { return is_blank(c) || c == ','; }
  [[nodiscard]] static const char* parse(const char* p, const char* end, Value& value) {
    if (*p == '+') ++p;
    if (const char* const after_plain = parse_plain(p, end, value)) return after_plain;
    const auto [after, error] = std::from_chars(p, end, value);
    if (error == std::errc() && *after != 'd' && *after != 'D') return after;
    return error == std::errc::invalid_argument ? nullptr : parse_rare(p, end, value);
  }
  // Decimals of at most 15 digits without exponent, which is what most files hold: both the digits and the
  // power of ten are exact, so one division rounds as the general conversion does. nullptr: something else.
  [[nodiscard]] static const char* parse_plain(const char* p, const char* end, Value& value);
  // Fortran exponents and values beyond the range of a double.
  [[nodiscard]] static const char* parse_rare(const char* p, const char* end, Value& value);
  [[nodiscard]] static std::string expected() { return "a number"; }
};

// The whole text as a real number or an integer; nothing when it is something else.
[[nodiscard]] std::optional<double> to_real(std::string_view text);
[[nodiscard]] std::optional<std::int64_t> to_integer(std::string_view text);

// The text in quotes for a message, shortened, without control characters.
[[nodiscard]] std::string quoted(std::string_view text);

// True when a and b are equal but for upper and lower case.
[[nodiscard]] bool same_word(std::string_view a, std::string_view b);

}  // namespace sculpt
