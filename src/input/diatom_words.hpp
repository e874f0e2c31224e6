#pragma once
// The words of a diatom file, and its keywords, which may be shortened.
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sculpt {

struct DiatomWord {
  std::string_view text;
  std::int64_t line = 0;
  bool in_quotes = false;
};

// Names of one thing, the first one for messages.
using KeywordNames = std::vector<std::string_view>;

// Whether a word is one of the names, in any case, or their beginning: at least three letters, four of the
// names that begin with 'end'.
[[nodiscard]] bool is_keyword(const DiatomWord& word, std::string_view name);
[[nodiscard]] bool is_keyword(const DiatomWord& word, const KeywordNames& names);

// 'a', 'b' or 'c'
[[nodiscard]] std::string listed(std::span<const std::string> names);

// '=' and ',' separate like blanks, '$' begins a comment, '*' does so in column one. Text and path must live
// as long as the words.
class DiatomWords {
 public:
  DiatomWords(std::string_view text, const std::string& path);

  [[nodiscard]] bool done() const { return at_ == words_.size(); }
  [[nodiscard]] const DiatomWord& peek() const { return words_[at_]; }
  const DiatomWord& take() { return words_[at_++]; }
  // The next word; at the end of the file an error that says what is missing.
  const DiatomWord& take(std::string_view expected);
  // All numbers up to the next word that is none.
  void take_numbers(std::vector<double>& numbers);
  // The next of the words, or the end of the file, for messages.
  [[nodiscard]] std::string shown_next() const;
  [[noreturn]] void fail_at(std::int64_t line, const std::string& what) const;

 private:
  void split(std::string_view line, std::int64_t number);

  const std::string& path_;
  std::vector<DiatomWord> words_;
  std::size_t at_ = 0;
  std::int64_t last_line_ = 1;
};

}  // namespace sculpt
