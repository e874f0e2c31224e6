#include "input/diatom_words.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "input/number_text.hpp"
#include "sculpt/base/error.hpp"

namespace sculpt {
namespace {

bool is_separator(char c) { return is_blank(c) || c == '=' || c == ','; }

}  // namespace

bool is_keyword(const DiatomWord& word, std::string_view name) {
  const std::size_t shortest = std::min<std::size_t>(name.starts_with("end") ? 4 : 3, name.size());
  const std::size_t size = word.text.size();
  return !word.in_quotes && size >= shortest && size <= name.size() &&
         same_word(word.text, name.substr(0, size));
}

bool is_keyword(const DiatomWord& word, const KeywordNames& names) {
  return std::any_of(names.begin(), names.end(),
                     [&](std::string_view name) { return is_keyword(word, name); });
}

std::string listed(std::span<const std::string> names) {
  std::string list;
  for (std::size_t n = 0; n < names.size(); ++n)
    list += fmt::format("{}'{}'", n == 0 ? "" : n + 1 == names.size() ? " or " : ", ", names[n]);
  return list;
}

DiatomWords::DiatomWords(std::string_view text, const std::string& path) : path_(path) {
  std::int64_t line = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    ++line;
    if (text[at] != '*') split(text.substr(at, end - at), line);
    at = end + 1;
  }
  last_line_ = std::max<std::int64_t>(line, 1);
}

void DiatomWords::split(std::string_view line, std::int64_t number) {
  std::size_t at = 0;
  while (at < line.size() && line[at] != '$') {
    const char c = line[at];
    if (is_separator(c)) {
      ++at;
    } else if (c == '\'' || c == '"') {
      const std::size_t end = line.find(c, at + 1);
      if (end == std::string_view::npos)
        fail_at(number, fmt::format("the line ends, expected a closing {}", c));
      words_.push_back({line.substr(at + 1, end - at - 1), number, true});
      at = end + 1;
    } else {
      const std::size_t start = at;
      while (at < line.size() && !is_separator(line[at]) && line[at] != '$') ++at;
      words_.push_back({line.substr(start, at - start), number, false});
    }
  }
}

const DiatomWord& DiatomWords::take(std::string_view expected) {
  if (done()) fail_at(last_line_, fmt::format("the file ends, expected {}", expected));
  return take();
}

void DiatomWords::take_numbers(std::vector<double>& numbers) {
  while (!done() && !peek().in_quotes) {
    const std::optional<double> number = to_real(peek().text);
    if (!number) return;
    numbers.push_back(*number);
    take();
  }
}

std::string DiatomWords::shown_next() const { return done() ? "the end of the file" : quoted(peek().text); }

void DiatomWords::fail_at(std::int64_t line, const std::string& what) const {
  throw Error(fmt::format("{}, line {}: {}", path_, line, what));
}

}  // namespace sculpt
