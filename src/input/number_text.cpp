#include "input/number_text.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>

namespace sculpt {

const char* RealText::parse_rare(const char* p, const char* end, Value& value) {
  const char* const stop = std::find_if(p, end, separates);
  std::string text(p, stop);
  for (char& c : text)
    if (c == 'd' || c == 'D') c = 'e';
  char* after = nullptr;
  value = std::strtod(text.c_str(), &after);
  return after == text.c_str() ? nullptr : p + (after - text.c_str());
}

const char* RealText::parse_plain(const char* p, const char* end, Value& value) {
  constexpr int kDigits = 15;
  static constexpr std::array<double, kDigits + 1> kPower{1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                          1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  const bool negative = p != end && *p == '-';
  if (negative) ++p;
  std::int64_t mantissa = 0;
  int digits = 0, after_point = 0;
  const auto read_digits = [&] {
    const char* const first = p;
    for (; p != end && *p >= '0' && *p <= '9' && digits <= kDigits; ++p, ++digits)
      mantissa = 10 * mantissa + (*p - '0');
    return static_cast<int>(p - first);
  };
  read_digits();
  if (p != end && *p == '.') {
    ++p;
    after_point = read_digits();
  }
  if (digits == 0 || digits > kDigits || (p != end && !separates(*p))) return nullptr;
  const double size = static_cast<double>(mantissa) / kPower[static_cast<std::size_t>(after_point)];
  value = negative ? -size : size;
  return p;
}

std::optional<double> to_real(std::string_view text) {
  const std::string ended(text);  // RealText looks at the character after the number
  double value = 0;
  if (ended.empty()) return std::nullopt;
  const char* const end = ended.c_str() + ended.size();
  return RealText::parse(ended.c_str(), end, value) == end ? std::optional(value) : std::nullopt;
}

std::optional<std::int64_t> to_integer(std::string_view text) {
  std::int64_t value = 0;
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  const auto [after, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && after == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

std::string quoted(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string shown(text.substr(0, kLongest));
  for (char& c : shown)
    if (std::iscntrl(static_cast<unsigned char>(c)) != 0) c = '?';
  return "'" + shown + (text.size() > kLongest ? "..." : "") + "'";
}

bool same_word(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
  });
}

}  // namespace sculpt
