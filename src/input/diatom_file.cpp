#include "input/diatom_file.hpp"

#include <fmt/core.h>

#include <array>
#include <cctype>
#include <cmath>
#include <optional>

#include "input/number_text.hpp"
#include "sculpt/base/error.hpp"
#include "sculpt/geom/sphere.hpp"

namespace sculpt {
namespace {

struct Word {
  std::string text;
  std::int64_t line = 0;
  bool in_quotes = false;
};

// Splits the text into words: '=' and ',' separate like blanks, '$' begins a comment, '*' does so in column
// one.
class Words {
 public:
  Words(std::string_view text, const std::string& path) : path_(path) {
    std::int64_t line = 0;
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      ++line;
      if (text[at] != '*') split(text.substr(at, end - at), line);
      at = end + 1;
    }
    last_line_ = std::max<std::int64_t>(line, 1);
  }

  [[nodiscard]] bool done() const { return at_ == words_.size(); }
  [[nodiscard]] const Word& peek() const { return words_[at_]; }
  const Word& take() { return words_[at_++]; }
  // The next word; at the end of the file an error that says what is missing.
  const Word& take(const std::string& expected) {
    if (done()) fail_at(last_line_, fmt::format("the file ends, expected {}", expected));
    return take();
  }
  double take_number(const std::string& what) {
    const Word& word = take(what);
    const auto number = to_real(word.text);
    if (word.in_quotes || !number || !std::isfinite(*number))
      fail_at(word.line, fmt::format("found {}, expected {}", quoted(word.text), what));
    return *number;
  }
  [[noreturn]] void fail_at(std::int64_t line, const std::string& what) const {
    throw Error(fmt::format("{}, line {}: {}", path_, line, what));
  }

 private:
  void split(std::string_view line, std::int64_t number) {
    std::size_t at = 0;
    while (at < line.size() && line[at] != '$') {
      const char c = line[at];
      if (is_separator(c)) {
        ++at;
      } else if (c == '\'' || c == '"') {
        const std::size_t end = line.find(c, at + 1);
        if (end == std::string_view::npos) fail_at(number, fmt::format("expected a closing {}", c));
        words_.push_back({std::string(line.substr(at + 1, end - at - 1)), number, true});
        at = end + 1;
      } else {
        const std::size_t start = at;
        while (at < line.size() && !is_separator(line[at]) && line[at] != '$') ++at;
        words_.push_back({std::string(line.substr(start, at - start)), number, false});
      }
    }
  }
  static bool is_separator(char c) { return is_blank(c) || c == '=' || c == ','; }

  const std::string& path_;
  std::vector<Word> words_;
  std::size_t at_ = 0;
  std::int64_t last_line_ = 1;
};

// A keyword may be shortened to its first `shortest` letters.
bool is_keyword(const Word& word, std::string_view keyword, std::size_t shortest) {
  const std::string& text = word.text;
  return !word.in_quotes && text.size() >= shortest && text.size() <= keyword.size() &&
         same_word(text, keyword.substr(0, text.size()));
}

// What CTH says about the state of a material: names that take numbers, which Sculpt ignores.
bool is_state(const Word& word) {
  constexpr std::array<std::string_view, 9> kStates{"velocity",  "xvelocity",   "yvelocity",
                                                    "zvelocity", "temperature", "pressure",
                                                    "density",   "energy",      "iterations"};
  for (const std::string_view state : kStates)
    if (is_keyword(word, state, 4)) return true;
  return is_keyword(word, "numsub", 6);
}

void skip_numbers(Words& words) {
  while (!words.done() && to_real(words.peek().text)) words.take();
}

class DiatomParser {
 public:
  DiatomParser(std::string_view text, const std::string& path) : words_(text, path), path_(path) {}

  std::vector<DiatomShape> parse() {
    while (!words_.done()) {
      const Word& word = words_.take();
      if (!is_keyword(word, "diatoms", 3)) unknown(word, "'diatom'");
      parse_diatom_block(word);
    }
    if (shapes_.empty())
      throw Error(path_ + ": holds no shape, expected at least one 'insert' in a 'diatom' block");
    return std::move(shapes_);
  }

 private:
  void parse_diatom_block(const Word& opening) {
    while (true) {
      const Word& word = next(opening, "diatom", "enddiatom");
      if (is_keyword(word, "enddiatoms", 4)) return;
      if (!is_keyword(word, "package", 3)) unknown(word, "'package' or 'enddiatom'");
      parse_package(word);
    }
  }

  void parse_package(const Word& opening) {
    std::string name;
    // A name without quotes is what no keyword of a package is.
    if (!words_.done() && (words_.peek().in_quotes || !begins_package_line(words_.peek())))
      name = words_.take().text;
    ++packages_;
    if (name.empty()) name = fmt::format("package_{}", packages_);
    std::optional<std::int64_t> material;
    const std::size_t first = shapes_.size();
    while (true) {
      const Word& word = next(opening, "package", "endpackage");
      if (is_keyword(word, "endpackage", 4)) break;
      if (is_keyword(word, "material", 3)) {
        material = parse_material();
      } else if (is_keyword(word, "insert", 3)) {
        parse_insert(word);
      } else if (is_state(word)) {
        skip_numbers(words_);
      } else {
        unknown(word, "'material', 'insert' or 'endpackage'");
      }
    }
    if (!material) words_.fail_at(opening.line, "the package has no material, expected 'material <id>'");
    for (std::size_t s = first; s < shapes_.size(); ++s) {
      shapes_[s].material = *material;
      shapes_[s].package = name;
    }
  }
  static bool begins_package_line(const Word& word) {
    return is_keyword(word, "material", 3) || is_keyword(word, "insert", 3) ||
           is_keyword(word, "endpackage", 4) || is_state(word);
  }

  std::int64_t parse_material() {
    const Word& word = words_.take("a material id");
    const auto id = to_integer(word.text);
    if (!id || *id < 1 || *id > INT32_MAX)
      words_.fail_at(word.line, fmt::format("found material {}, expected an integer from 1 to 2147483647",
                                            quoted(word.text)));
    return *id;
  }

  void parse_insert(const Word& opening) {
    const Word& kind = words_.take("the name of a shape after 'insert'");
    if (is_keyword(kind, "stl", 3))
      parse_stl_file(opening);
    else if (is_keyword(kind, "sphere", 3))
      parse_sphere(opening);
    else
      words_.fail_at(kind.line, fmt::format("insert {} is not supported yet, expected 'sphere' or 'stl'",
                                            quoted(kind.text)));
  }

  void parse_stl_file(const Word& opening) {
    std::string file;
    while (true) {
      const Word& word = next(opening, "insert", "endinsert");
      if (is_keyword(word, "endinsert", 4)) break;
      if (!is_keyword(word, "file", 4)) unknown(word, "'file' or 'endinsert'");
      file = words_.take("the name of an STL file").text;
    }
    if (file.empty()) words_.fail_at(opening.line, "the stl has no file, expected \"file = 'name.stl'\"");
    shapes_.push_back({nullptr, 0, file, opening.line});
  }

  void parse_sphere(const Word& opening) {
    std::optional<Vec3> center;
    std::optional<double> radius;
    while (true) {
      const Word& word = next(opening, "insert", "endinsert");
      if (is_keyword(word, "endinsert", 4)) break;
      if (is_keyword(word, "center", 3) || is_keyword(word, "centre", 3)) {
        center.emplace();
        for (std::size_t d = 0; d < 3; ++d)
          (*center)[d] = words_.take_number("three coordinates of the center");
      } else if (is_keyword(word, "radius", 3)) {
        radius = words_.take_number("the radius");
        if (!(*radius > 0))
          words_.fail_at(word.line, fmt::format("found radius {}, expected a value > 0", *radius));
      } else {
        unknown(word, "'center', 'radius' or 'endinsert'");
      }
    }
    if (!center) words_.fail_at(opening.line, "the sphere has no center, expected 'center = x y z'");
    if (!radius) words_.fail_at(opening.line, "the sphere has no radius, expected 'radius = r'");
    shapes_.push_back({std::make_unique<Sphere>(*center, *radius), 0, "", opening.line});
  }

  // The next word of a block that must be closed.
  const Word& next(const Word& opening, const char* block, const char* closing) {
    if (words_.done())
      words_.fail_at(opening.line, fmt::format("'{}' is not closed, expected '{}'", block, closing));
    return words_.take();
  }
  [[noreturn]] void unknown(const Word& word, const char* expected) const {
    words_.fail_at(word.line, fmt::format("found {}, expected {}", quoted(word.text), expected));
  }

  Words words_;
  const std::string& path_;
  std::vector<DiatomShape> shapes_;
  std::int64_t packages_ = 0;
};

}  // namespace

std::vector<DiatomShape> parse_diatom(std::string_view text, const std::string& path) {
  return DiatomParser(text, path).parse();
}

}  // namespace sculpt
