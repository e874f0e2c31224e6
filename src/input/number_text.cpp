#include "input/number_text.hpp"

#include <algorithm>
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
