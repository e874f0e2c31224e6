#include "input/tec_header.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "input/number_text.hpp"
#include "sculpt/base/error.hpp"

namespace sculpt {
namespace {

// Walks over the words of the header: names, quoted strings, '=' and lists in parentheses.
class HeaderText {
 public:
  HeaderText(std::string_view text, const std::string& path) : text_(text), path_(path) {}

  [[nodiscard]] std::size_t position() const { return at_; }
  [[nodiscard]] bool done() {
    skip();
    return at_ == text_.size();
  }
  // The next character that is no blank, comma or comment; 0 at the end.
  [[nodiscard]] char peek() {
    skip();
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool take_equals() {
    if (peek() != '=') return false;
    ++at_;
    return true;
  }
  // A word, or what stands in quotes or parentheses.
  std::string take_word() {
    const char first = peek();
    if (first == '"' || first == '\'') return take_until(first);
    if (first == '(') return take_until(')');
    const std::size_t start = at_;
    while (at_ < text_.size() && !RealText::separates(text_[at_]) && text_[at_] != '=') ++at_;
    if (at_ == start) fail(fmt::format("found {}, expected a word", quoted(text_.substr(at_, 1))));
    return std::string(text_.substr(start, at_ - start));
  }
  // The word ahead without taking it; empty before a quote or at the end.
  [[nodiscard]] std::string next_word() {
    const char first = peek();
    if (first == '\0' || first == '"' || first == '\'' || first == '=' || first == '(') return {};
    const std::size_t start = at_;
    std::string word = take_word();
    at_ = start;
    return word;
  }
  void expect_equals(const std::string& after) {
    if (!take_equals()) fail(fmt::format("expected '=' after {}", quoted(after)));
  }
  [[noreturn]] void fail(const std::string& what) const {
    const auto line = std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n') + 1;
    throw Error(fmt::format("{}, line {}: {}", path_, line, what));
  }

 private:
  void skip() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '#')
        while (at_ < text_.size() && text_[at_] != '\n') ++at_;
      else if (RealText::separates(c))
        ++at_;
      else
        return;
    }
  }
  std::string take_until(char closing) {
    const std::size_t start = at_ + 1, end = text_.find(closing, start);
    if (end == std::string_view::npos)
      fail(fmt::format("expected a closing {}", quoted(std::string(1, closing))));
    at_ = end + 1;
    return std::string(text_.substr(start, end - start));
  }

  std::string_view text_;
  const std::string& path_;
  std::size_t at_ = 0;
};

bool starts_number(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '+' || c == '-' || c == '.';
}

void parse_variables(HeaderText& text, TecHeader& header) {
  text.expect_equals("VARIABLES");
  while (!text.done()) {
    const std::string word = text.next_word();
    if (same_word(word, "ZONE") || same_word(word, "TITLE")) break;
    header.variables.push_back(text.take_word());
  }
}

void parse_count(HeaderText& text, const std::string& key, Index3& cells) {
  const std::string word = text.take_word();
  const auto count = to_integer(word);
  constexpr std::int64_t kMost = std::int64_t{1} << 31;
  if (!count || *count < 1 || *count > kMost)
    text.fail(fmt::format("found {} = {}, expected a number of cells >= 1", key, word));
  const char axis = static_cast<char>(std::toupper(static_cast<unsigned char>(key[0])));
  cells[static_cast<std::size_t>(axis - 'I')] = *count;
}

void parse_zone(HeaderText& text, TecHeader& header) {
  while (!text.done() && !starts_number(text.peek())) {
    const std::string key = text.take_word();
    if (same_word(key, "AUXDATA")) continue;  // a name and its value follow
    text.expect_equals(key);
    if (same_word(key, "I") || same_word(key, "J") || same_word(key, "K")) {
      parse_count(text, key, header.cells);
    } else {
      const std::string value = text.take_word();
      if ((same_word(key, "F") || same_word(key, "DATAPACKING")) && !same_word(value, "POINT"))
        text.fail(fmt::format("found {} = {}, expected POINT: one row of numbers per cell", key, value));
    }
  }
}

void check_header(const HeaderText& text, const TecHeader& header) {
  if (header.variables.size() < 4)
    text.fail(fmt::format("found {} variables, expected x, y, z and at least one material (VARIABLES = ...)",
                          header.variables.size()));
  constexpr std::array<char, 3> kAxes{'I', 'J', 'K'};
  std::int64_t room = INT64_MAX / 8;
  for (std::size_t d = 0; d < 3; ++d) {
    if (header.cells[d] == 0) text.fail(fmt::format("the ZONE gives no {}, expected I, J and K", kAxes[d]));
    room /= header.cells[d];
  }
  if (room == 0) text.fail("the ZONE has more cells than can be numbered");
}

}  // namespace

TecHeader parse_tec_header(std::string_view text, const std::string& path) {
  TecHeader header;
  HeaderText words(text, path);
  bool has_zone = false;
  while (!has_zone) {
    if (words.done()) words.fail("the header ends without a ZONE");
    if (starts_number(words.peek()))
      words.fail("found a number, expected the TITLE, VARIABLES and ZONE lines first");
    const std::string key = words.take_word();
    if (same_word(key, "VARIABLES")) {
      parse_variables(words, header);
    } else if (same_word(key, "ZONE")) {
      has_zone = true;
    } else if (same_word(key, "TITLE") || same_word(key, "FILETYPE")) {
      words.expect_equals(key);
      (void)words.take_word();
    } else if (!same_word(key, "DATASETAUXDATA")) {
      // A title line without its keyword, or the name and value of auxiliary data.
      if (words.take_equals()) (void)words.take_word();
    }
  }
  parse_zone(words, header);
  check_header(words, header);
  if (words.done()) words.fail("expected rows of numbers after the ZONE");
  header.data_begin = words.position();
  return header;
}

}  // namespace sculpt
