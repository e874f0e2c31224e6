#include "input/diatom_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <optional>

#include "input/diatom_shapes.hpp"
#include "input/diatom_words.hpp"
#include "input/number_text.hpp"
#include "sculpt/base/error.hpp"
#include "sculpt/deck/options.hpp"

namespace sculpt {
namespace {

// What CTH says about the state of a material: names that take numbers, which make no difference to a mesh.
const KeywordNames& states() {
  static const KeywordNames names{"velocity",    "xvelocity", "yvelocity", "zvelocity",
                                  "temperature", "pressure",  "density",   "energy",
                                  "sie",         "numsub",    "iterations"};
  return names;
}

// Shapes of two-dimensional CTH problems.
const KeywordNames& flat_shapes() {
  static const KeywordNames names{"circle", "ellipse", "triangle", "rectangle", "uds"};
  return names;
}

// What the file says between 'insert' or 'delete' and its end.
struct Body {
  const ShapeKind* kind = nullptr;
  std::int64_t line = 0;
  ShapeValues values;                  // per parameter of the kind
  std::vector<std::int64_t> given_at;  // line of each parameter, 0: not given
  std::string stl_path;
  Placement placement;
  std::vector<Body> deleted;
};

class DiatomParser {
 public:
  DiatomParser(std::string_view text, const std::string& path) : words_(text, path), path_(path) {}

  DiatomFile parse() {
    while (!words_.done()) {
      const DiatomWord& word = words_.take();
      if (!is_keyword(word, "diatoms")) unknown(word, {"diatom"});
      parse_block(word);
    }
    const auto& packages = file_.packages;
    if (std::all_of(packages.begin(), packages.end(), [](const auto& p) { return p.inserts.empty(); }))
      throw Error(path_ + ": holds no shape, expected at least one 'insert' in a 'diatom' block");
    return std::move(file_);
  }

 private:
  void parse_block(const DiatomWord& opening) {
    while (true) {
      const DiatomWord& word = next(opening, "diatom", "enddiatom");
      if (is_keyword(word, "enddiatoms")) return;
      if (!is_keyword(word, "package")) unknown(word, {"package", "enddiatom"});
      parse_package(word);
    }
  }

  void parse_package(const DiatomWord& opening) {
    DiatomPackage package;
    package.line = opening.line;
    // A name without quotes is what no keyword of a package is.
    if (!words_.done() && (words_.peek().in_quotes || !begins_package_line(words_.peek())))
      package.name = words_.take().text;
    if (package.name.empty()) package.name = fmt::format("package_{}", file_.packages.size() + 1);
    while (true) {
      const DiatomWord& word = next(opening, "package", "endpackage");
      if (is_keyword(word, "endpackage")) break;
      if (is_keyword(word, "material")) {
        parse_material(word, package.material);
      } else if (is_keyword(word, "insert")) {
        const Body body = parse_body(word, "insert");
        DiatomInsert& insert = package.inserts.emplace_back();
        insert.line = body.line;
        insert.solid = make(body, body.placement);
        for (const Body& hole : body.deleted)
          insert.deleted.push_back(make(hole, body.placement.after(hole.placement)));
      } else if (is_keyword(word, "delete")) {
        const Body body = parse_body(word, "delete");
        package.deleted.push_back(make(body, body.placement));
      } else if (is_keyword(word, states())) {
        skipped_.clear();
        words_.take_numbers(skipped_);
      } else {
        unknown_in_package(word);
      }
    }
    if (package.material == 0)
      words_.fail_at(opening.line,
                     fmt::format("package '{}' has no material, expected 'material <id>'", package.name));
    file_.packages.push_back(std::move(package));
  }

  static bool begins_package_line(const DiatomWord& word) {
    static const KeywordNames names{"material", "insert", "delete", "endpackage"};
    return is_keyword(word, names) || is_keyword(word, states());
  }

  void parse_material(const DiatomWord& keyword, std::int64_t& material) {
    if (material != 0) words_.fail_at(keyword.line, "'material' is given twice, expected one per package");
    const DiatomWord& word = words_.take("a material id");
    const auto id = to_integer(word.text);
    if (!id || *id < 1 || *id > INT32_MAX)
      words_.fail_at(word.line, fmt::format("found material {}, expected an integer from 1 to 2147483647",
                                            quoted(word.text)));
    material = *id;
  }

  Body parse_body(const DiatomWord& opening, const std::string& block) {
    Body body;
    body.kind = &parse_kind(block);
    body.line = opening.line;
    body.values.resize(body.kind->parameters.size());
    body.given_at.resize(body.kind->parameters.size());
    const std::string closing = "end" + block;
    while (true) {
      const DiatomWord& word = next(opening, block, closing);
      if (is_keyword(word, closing)) break;
      if (block == "insert" && is_keyword(word, "delete")) {
        body.deleted.push_back(parse_body(word, "delete"));
      } else if (const auto parameter = find_parameter(word, body.kind->parameters)) {
        parse_parameter(word, *parameter, body);
      } else if (const auto placing = find_parameter(word, placing_parameters())) {
        parse_placing(word, placing_parameters()[*placing], body.placement);
      } else {
        unknown_in_body(word, *body.kind, block);
      }
    }
    expect_all_given(body);
    return body;
  }

  const ShapeKind& parse_kind(const std::string& block) {
    const DiatomWord& word = words_.take(fmt::format("the name of a shape after '{}'", block));
    for (const ShapeKind& kind : shape_kinds())
      if (is_keyword(word, kind.names)) return kind;
    if (is_keyword(word, flat_shapes()))
      words_.fail_at(word.line, fmt::format("{} {} is two-dimensional, expected a solid: {}", block,
                                            quoted(word.text), listed(shape_names())));
    words_.fail_at(word.line,
                   fmt::format("found shape {}, expected {}", quoted(word.text), listed(shape_names())) +
                       did_you_mean(word.text, shape_names()));
  }

  // The parameter that a word names or shortens.
  [[nodiscard]] std::optional<std::size_t> find_parameter(const DiatomWord& word,
                                                          std::span<const ShapeParameter> parameters) const {
    std::vector<std::string> fitting;
    std::optional<std::size_t> found;
    for (std::size_t p = 0; p < parameters.size(); ++p) {
      if (!is_keyword(word, parameters[p].names)) continue;
      const KeywordNames& names = parameters[p].names;
      if (std::any_of(names.begin(), names.end(), [&](auto name) { return same_word(word.text, name); }))
        return p;
      fitting.emplace_back(names[0]);
      found = p;
    }
    if (fitting.size() > 1)
      words_.fail_at(word.line, fmt::format("found {}, which may mean several keywords, expected {}",
                                            quoted(word.text), listed(fitting)));
    return found;
  }

  void parse_parameter(const DiatomWord& word, std::size_t p, Body& body) {
    const ShapeParameter& parameter = body.kind->parameters[p];
    if (body.given_at[p] != 0 && parameter.need != ParameterNeed::kRepeated)
      words_.fail_at(word.line, fmt::format("'{}' is given twice, first in line {}, expected it once",
                                            parameter.names[0], body.given_at[p]));
    body.given_at[p] = word.line;
    if (parameter.kind != ParameterKind::kFile) return parse_numbers(word, parameter, body.values[p]);
    const bool follows = !words_.done() && words_.peek().line == word.line;
    if (!follows || words_.peek().text.empty())
      words_.fail_at(word.line,
                     fmt::format("found {} after '{}', expected {}", follows ? "''" : "the end of the line",
                                 parameter.names[0], expected_numbers(parameter.kind)));
    body.stl_path = words_.take().text;
  }

  void parse_placing(const DiatomWord& word, const ShapeParameter& parameter, Placement& placement) {
    numbers_.clear();
    parse_numbers(word, parameter, numbers_);
    placement = placement_of(parameter.kind, numbers_).after(placement);
    try {
      check_placement(placement);
    } catch (const Error& error) {
      words_.fail_at(word.line, error.what());
    }
  }

  // Adds the numbers that follow the keyword.
  void parse_numbers(const DiatomWord& word, const ShapeParameter& parameter, std::vector<double>& numbers) {
    const std::size_t before = numbers.size();
    words_.take_numbers(numbers);
    const std::size_t count = numbers.size() - before;
    if (!takes(parameter.kind, count))
      words_.fail_at(word.line, fmt::format("found {} number{} after '{}' and then {}, expected {}", count,
                                            count == 1 ? "" : "s", parameter.names[0], words_.shown_next(),
                                            expected_numbers(parameter.kind)));
    try {
      check_numbers(parameter.kind, parameter.names[0], std::span(numbers).subspan(before));
    } catch (const Error& error) {
      words_.fail_at(word.line, error.what());
    }
  }

  void expect_all_given(const Body& body) const {
    for (std::size_t p = 0; p < body.given_at.size(); ++p) {
      const ShapeParameter& parameter = body.kind->parameters[p];
      if (body.given_at[p] == 0 && parameter.need != ParameterNeed::kPerhaps)
        words_.fail_at(body.line,
                       fmt::format("the {0} has no '{1}', expected '{1}' and {2}", body.kind->names[0],
                                   parameter.names[0], expected_numbers(parameter.kind)));
    }
  }

  DiatomSolid make(const Body& body, const Placement& placement) {
    if (body.kind->make == nullptr) {
      file_.stl_files.push_back({body.stl_path, fmt::format("{}, line {}", path_, body.line), placement});
      return {nullptr, file_.stl_files.size() - 1};
    }
    try {
      return {make_solid(*body.kind, body.values, placement)};
    } catch (const Error& error) {
      words_.fail_at(body.line, error.what());
    }
  }

  // The next word of a block that must be closed.
  const DiatomWord& next(const DiatomWord& opening, std::string_view block, std::string_view closing) {
    if (words_.done())
      words_.fail_at(opening.line, fmt::format("'{}' is not closed, expected '{}'", block, closing));
    return words_.take();
  }

  [[noreturn]] void unknown(const DiatomWord& word, std::vector<std::string> expected) const {
    words_.fail_at(word.line, fmt::format("found {}, expected {}", quoted(word.text), listed(expected)) +
                                  did_you_mean(word.text, expected));
  }
  [[noreturn]] void unknown_in_package(const DiatomWord& word) const {
    std::vector<std::string> expected{"material", "insert", "delete", "endpackage"};
    std::vector<std::string> known = expected;
    known.insert(known.end(), states().begin(), states().end());
    words_.fail_at(word.line, fmt::format("found {}, expected {} or a state such as 'velocity'",
                                          quoted(word.text), listed(expected)) +
                                  did_you_mean(word.text, known));
  }
  [[noreturn]] void unknown_in_body(const DiatomWord& word, const ShapeKind& kind,
                                    const std::string& block) const {
    std::vector<std::string> expected;
    for (const ShapeParameter& parameter : kind.parameters) expected.emplace_back(parameter.names[0]);
    for (const ShapeParameter& parameter : placing_parameters()) expected.emplace_back(parameter.names[0]);
    if (block == "insert") expected.emplace_back("delete");
    expected.push_back("end" + block);
    unknown(word, expected);
  }
  [[nodiscard]] static std::vector<std::string> shape_names() {
    std::vector<std::string> names;
    for (const ShapeKind& kind : shape_kinds()) names.emplace_back(kind.names[0]);
    return names;
  }

  DiatomWords words_;
  const std::string& path_;
  DiatomFile file_;
  std::vector<double> numbers_, skipped_;
};

}  // namespace

DiatomFile parse_diatom(std::string_view text, const std::string& path) {
  return DiatomParser(text, path).parse();
}

}  // namespace sculpt
