// The deck: BEGIN SCULPT, one option per line, END SCULPT.
#include <fmt/core.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "deck/text.hpp"
#include "deck/value.hpp"
#include "sculpt/base/error.hpp"
#include "sculpt/deck/parse.hpp"

namespace sculpt {

namespace {

// The words of one line. Blanks and the first '=' after the first word separate; '$' and '#' start a comment;
// quotes of either kind keep blanks and comment signs, and pieces that touch make one word, as in a shell.
std::vector<std::string> split_words(std::string_view line, std::string_view where) {
  std::vector<std::string> words;
  bool inside = false, seen_equals = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '$' || c == '#') break;
    const bool equals = c == '=' && !seen_equals && words.size() == 1;
    if (is_blank(c) || equals) {
      inside = false;
      seen_equals = seen_equals || equals;
      continue;
    }
    if (!inside) words.emplace_back();
    inside = true;
    if (c != '"' && c != '\'') {
      words.back() += c;
      continue;
    }
    const std::size_t close = line.find(c, i + 1);
    if (close == std::string_view::npos)
      throw Error(fmt::format("{}: the quote {} is not closed on this line", where, c));
    words.back() += line.substr(i + 1, close - i - 1);
    i = close;
  }
  return words;
}

class DeckReader {
 public:
  explicit DeckReader(std::string_view file_name) : file_(file_name) {}

  void read_line(std::string_view line) {
    ++line_;
    const std::vector<std::string> words = split_words(line, where());
    if (words.empty()) return;
    const std::string first = lower(words[0]);
    const std::string second = words.size() > 1 ? lower(words[1]) : "";
    if (state_ == State::kBefore) {
      if (first != "begin" || second != "sculpt" || words.size() != 2)
        fail(fmt::format("expected 'BEGIN SCULPT', found '{}'", text(words)));
      state_ = State::kInside;
    } else if (state_ == State::kAfter) {
      fail(fmt::format("text after 'END SCULPT': '{}'", text(words)));
    } else if (first == "end" && (second == "sculpt" || words.size() == 1)) {
      if (words.size() != 2) fail(fmt::format("expected 'END SCULPT', found '{}'", text(words)));
      state_ = State::kAfter;
    } else if (first == "begin" && second == "sculpt") {
      fail("a second 'BEGIN SCULPT' before 'END SCULPT'");
    } else {
      read_option(words);
    }
  }

  Deck finish() {
    if (state_ == State::kBefore) fail("the file has no 'BEGIN SCULPT'");
    if (state_ == State::kInside) fail("the file ends without 'END SCULPT'");
    return deck_;
  }

 private:
  enum class State { kBefore, kInside, kAfter };

  [[nodiscard]] std::string where() const { return fmt::format("{}:{}", file_, line_); }
  [[noreturn]] void fail(const std::string& message) const {
    throw Error(fmt::format("{}: {}", where(), message));
  }
  static std::string text(const std::vector<std::string>& words) {
    std::string joined;
    for (const std::string& word : words) joined += (joined.empty() ? "" : " ") + word;
    constexpr std::size_t kShown = 60;  // the file may be no deck at all
    return joined.size() <= kShown ? joined : joined.substr(0, kShown) + "...";
  }

  void read_option(const std::vector<std::string>& words) {
    const OptionSpec* option = find_option(words[0]);
    if (option == nullptr)
      fail(fmt::format("unknown option '{}'{}", words[0], did_you_mean_option(words[0], "")));
    if (option->where == Where::kCommandLineOnly)
      fail(fmt::format("option '{}' belongs on the command line, not into a deck", option->name));
    if (std::holds_alternative<std::monostate>(option->slot))
      fail(fmt::format("option '{}' is not supported yet", option->name == "begin" || option->name == "end"
                                                               ? text(words)
                                                               : std::string(option->name)));
    if (seen_.insert(option->name).second) reset_value(deck_, *option);
    set_value(deck_, *option, std::span(words).subspan(1), where(), option->name);
    deck_.given_options.add(option->name, fmt::format("line {} of {}", line_, file_));
  }

  std::string file_;
  int line_ = 0;
  State state_ = State::kBefore;
  std::set<std::string_view> seen_;
  Deck deck_;
};

}  // namespace

Deck parse_deck(std::string_view text, std::string_view file_name) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  DeckReader reader(file_name);
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    reader.read_line(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return reader.finish();
}

std::string read_deck_file(const std::string& file_name) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file_name, ignored))
    throw Error(fmt::format("deck '{}': this is a folder, not a file", file_name));
  std::ifstream file(file_name, std::ios::binary);
  if (!file) throw Error(fmt::format("deck '{}': cannot open the file: {}", file_name, std::strerror(errno)));
  try {
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  } catch (const std::ios_base::failure&) {
    throw Error(fmt::format("deck '{}': cannot read the file", file_name));
  }
}

}  // namespace sculpt
