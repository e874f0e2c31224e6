#include "deck/value.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <limits>
#include <type_traits>

#include "deck/table.hpp"
#include "deck/text.hpp"
#include "sculpt/base/error.hpp"

namespace sculpt {

namespace {

using Ids = std::vector<std::int64_t>;

// The type of the field behind a slot.
template <class Member>
struct FieldOf;
template <class T>
struct FieldOf<T Deck::*> {
  using Type = T;
};
template <class Member>
using Field = typename FieldOf<Member>::Type;

template <class T>
inline constexpr bool kIsRecords =
    std::is_same_v<T, std::vector<MaterialValue>> || std::is_same_v<T, std::vector<IdName>> ||
    std::is_same_v<T, std::vector<IdBox>> || std::is_same_v<T, std::vector<NumberRecord>>;

// A message about a value: where, which option, what was expected, what was found.
struct Complaint {
  const OptionSpec& option;
  std::string_view where, shown;
  std::string found;

  [[noreturn]] void fail(std::string_view expected) const {
    if (found.empty()) throw Error(fmt::format("{}: option '{}' needs {}", where, shown, expected));
    throw Error(fmt::format("{}: option '{}' needs {}, found '{}'", where, shown, expected, found));
  }
};

// No limit, or one beyond what the type can hold, is not worth telling.
bool tells_range(double lo, double hi) { return std::isfinite(lo) || std::isfinite(hi); }

std::string range_text(double lo, double hi) {
  if (!tells_range(lo, hi)) return "";
  const auto text = [](double v) {
    return v == std::floor(v) ? fmt::format("{:.0f}", v) : fmt::format("{}", v);
  };
  if (!std::isfinite(hi)) return fmt::format("of at least {}", text(lo));
  return fmt::format("from {} to {}", text(lo), text(hi));
}

std::string with_range(std::string_view noun, double lo, double hi) {
  const std::string range = range_text(lo, hi);
  return range.empty() ? std::string(noun) : fmt::format("{} {}", noun, range);
}

template <class Int>
Int integer(const std::string& word, double lo, double hi, const Complaint& complaint) {
  const std::optional<Int> value = to_number<Int>(word);
  if (!value || static_cast<double>(*value) < lo || static_cast<double>(*value) > hi)
    complaint.fail(with_range("an integer", lo, hi));
  return *value;
}

double real(const std::string& word, double lo, double hi, const Complaint& complaint) {
  const std::optional<double> value = to_number<double>(word);
  if (!value || *value < lo || *value > hi) complaint.fail(with_range("a number", lo, hi));
  return *value;
}

std::int64_t id(const std::string& word, const Complaint& complaint) {
  return integer<std::int64_t>(word, 0, kMaxId, complaint);
}

std::string value_list(const OptionSpec& option) {
  return fmt::format("one of {}", fmt::join(value_names(option), "; "));
}

int enum_number(const std::string& word, const Complaint& complaint) {
  const std::string wanted = lower(word);
  for (const EnumValue& value : complaint.option.values)
    if (value.name == wanted) return value.number;
  const std::optional<int> number = to_number<int>(word);
  if (!number || find_value(complaint.option, *number) == nullptr)
    complaint.fail(value_list(complaint.option));
  return *number;
}

// The words of one value, checked and converted. `words` has the right count already.
void assign(bool& field, std::span<const std::string> words, const Complaint& complaint) {
  const std::optional<bool> value = words.empty() ? true : to_bool(words[0]);
  if (!value) complaint.fail("true or false");
  field = *value;
}
void assign(int& field, std::span<const std::string> words, const Complaint& c) {
  field = c.option.values.empty() ? integer<int>(words[0], c.option.lo, c.option.hi, c)
                                  : enum_number(words[0], c);
}
void assign(std::int64_t& field, std::span<const std::string> words, const Complaint& c) {
  field = integer<std::int64_t>(words[0], c.option.lo, c.option.hi, c);
}
void assign(double& field, std::span<const std::string> words, const Complaint& c) {
  field = real(words[0], c.option.lo, c.option.hi, c);
}
void assign(std::string& field, std::span<const std::string> words, const Complaint& c) {
  if (words[0].empty()) c.fail(fmt::format("a {}", c.option.argument));
  field = words[0];
}
void assign(Ids& field, std::span<const std::string> words, const Complaint& c) {
  Ids ids;
  for (const std::string& word : words)
    ids.push_back(integer<std::int64_t>(word, c.option.lo, c.option.hi, c));
  field = ids;
}
void assign(std::vector<MaterialValue>& field, std::span<const std::string> words, const Complaint& c) {
  field.push_back({id(words[0], c),
                   words[1] == "auto" ? MaterialValue::kAuto : real(words[1], c.option.lo, c.option.hi, c)});
}
void assign(std::vector<IdName>& field, std::span<const std::string> words, const Complaint& c) {
  if (words[1].empty()) c.fail("an id and a name");
  field.push_back({id(words[0], c), words[1]});
}
void assign(std::vector<IdBox>& field, std::span<const std::string> words, const Complaint& c) {
  IdBox record{integer<std::int64_t>(words[0], 1, kMaxId, c), {}};
  for (std::size_t i = 0; i < record.box.size(); ++i)
    record.box[i] = real(words[i + 1], -HUGE_VAL, HUGE_VAL, c);
  for (std::size_t d = 0; d < 3; ++d)
    if (!(record.box[d] <= record.box[d + 3]))
      c.fail("an id and a box, xmin ymin zmin xmax ymax zmax, whose lower ends are not above the upper ones");
  field.push_back(record);
}
void assign(std::vector<NumberRecord>& field, std::span<const std::string> words, const Complaint& c) {
  NumberRecord record;
  for (const std::string& word : words) record.numbers.push_back(real(word, -HUGE_VAL, HUGE_VAL, c));
  field.push_back(record);
}

// What the words should have been, for a wrong count of them.
std::string expected_value(const OptionSpec& option) {
  const auto expected = [&](auto slot) -> std::string {
    if constexpr (std::is_same_v<decltype(slot), std::monostate>) {
      return "a value";
    } else {
      using T = Field<decltype(slot)>;
      if constexpr (std::is_same_v<T, bool>) return "true or false";
      if constexpr (std::is_same_v<T, int> || std::is_same_v<T, std::int64_t>)
        return option.values.empty() ? with_range("an integer", option.lo, option.hi) : value_list(option);
      if constexpr (std::is_same_v<T, double>) return with_range("a number", option.lo, option.hi);
      if constexpr (std::is_same_v<T, std::string>)
        return fmt::format("one {} (in quotes if it has blanks)", option.argument);
      if constexpr (std::is_same_v<T, Ids>) return "integers separated by blanks";
      if constexpr (std::is_same_v<T, std::vector<MaterialValue>>) return "an id and a value";
      if constexpr (std::is_same_v<T, std::vector<IdName>>)
        return "an id and one name (in quotes if it has blanks)";
      if constexpr (std::is_same_v<T, std::vector<IdBox>>) return "an id and xmin ymin zmin xmax ymax zmax";
      return "numbers separated by blanks";
    }
  };
  return std::visit(expected, option.slot);
}

// A text that the deck reader takes for one word.
std::string quoted(const std::string& text) {
  if (!text.empty() && text.find_first_of(" \t$#='\"") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"'\"'\"") : std::string(1, c);
  return result + "\"";
}

enum class Style { kDeck, kConsole };

std::string number_text(double value, Style style) {
  return style == Style::kDeck ? fmt::format("{}", value) : fmt::format("{:f}", value);
}

std::string text_of(bool value, const OptionSpec&, Style style) {
  if (style == Style::kConsole) return value ? "ON (1)" : "OFF (0)";
  return value ? "true" : "false";
}
std::string text_of(int value, const OptionSpec& option, Style style) {
  const EnumValue* named = style == Style::kDeck ? find_value(option, value) : nullptr;
  return named != nullptr ? std::string(named->name) : fmt::format("{}", value);
}
std::string text_of(std::int64_t value, const OptionSpec&, Style) { return fmt::format("{}", value); }
std::string text_of(double value, const OptionSpec&, Style style) { return number_text(value, style); }
std::string text_of(const std::string& value, const OptionSpec&, Style style) {
  return style == Style::kDeck ? quoted(value) : value;
}
std::string text_of(const Ids& value, const OptionSpec&, Style) {
  return fmt::format("{}", fmt::join(value, " "));
}
std::string text_of(const MaterialValue& record, const OptionSpec&, Style style) {
  return fmt::format("{} {}", record.id,
                     record.value == MaterialValue::kAuto ? "auto" : number_text(record.value, style));
}
std::string text_of(const IdName& record, const OptionSpec&, Style style) {
  return fmt::format("{} {}", record.id, style == Style::kDeck ? quoted(record.name) : record.name);
}
std::string text_of(const NumberRecord& record, const OptionSpec&, Style style) {
  std::vector<std::string> texts;
  for (const double number : record.numbers) texts.push_back(number_text(number, style));
  return fmt::format("{}", fmt::join(texts, " "));
}
std::string text_of(const IdBox& record, const OptionSpec& option, Style style) {
  return fmt::format("{} {}", record.id,
                     text_of(NumberRecord{{record.box.begin(), record.box.end()}}, option, style));
}

std::vector<std::string> texts(const Deck& deck, const OptionSpec& option, Style style) {
  std::vector<std::string> result;
  const auto write = [&](auto slot) {
    if constexpr (!std::is_same_v<decltype(slot), std::monostate>) {
      const auto& field = deck.*slot;
      if constexpr (kIsRecords<Field<decltype(slot)>>) {
        for (const auto& record : field) result.push_back(text_of(record, option, style));
      } else {
        result.push_back(text_of(field, option, style));
      }
    }
  };
  std::visit(write, option.slot);
  return result;
}

}  // namespace

void set_value(Deck& deck, const OptionSpec& option, std::span<const std::string> words,
               std::string_view where, std::string_view shown) {
  const Complaint complaint{option, where, shown, fmt::format("{}", fmt::join(words, " "))};
  const std::size_t wanted = words_of_value(option);
  const bool right = wanted == kManyWords ? !words.empty()
                     : wanted == 0        ? words.size() <= 1
                                          : words.size() == wanted;
  if (!right) complaint.fail(expected_value(option));
  const auto set = [&](auto slot) {
    if constexpr (!std::is_same_v<decltype(slot), std::monostate>) assign(deck.*slot, words, complaint);
  };
  std::visit(set, option.slot);
}

void reset_value(Deck& deck, const OptionSpec& option) {
  const auto reset = [&](auto slot) {
    if constexpr (!std::is_same_v<decltype(slot), std::monostate>) deck.*slot = Deck{}.*slot;
  };
  std::visit(reset, option.slot);
}

std::size_t words_of_value(const OptionSpec& option) {
  const auto count = [](auto slot) -> std::size_t {
    if constexpr (std::is_same_v<decltype(slot), std::monostate>) {
      return kManyWords;
    } else {
      using T = Field<decltype(slot)>;
      if constexpr (std::is_same_v<T, bool>) return 0;
      if constexpr (std::is_same_v<T, Ids> || std::is_same_v<T, std::vector<NumberRecord>>) return kManyWords;
      if constexpr (std::is_same_v<T, std::vector<MaterialValue>> || std::is_same_v<T, std::vector<IdName>>)
        return 2;
      if constexpr (std::is_same_v<T, std::vector<IdBox>>) return 7;
      return 1;
    }
  };
  return std::visit(count, option.slot);
}

std::vector<std::string> deck_texts(const Deck& deck, const OptionSpec& option) {
  return texts(deck, option, Style::kDeck);
}

std::vector<std::string> console_texts(const Deck& deck, const OptionSpec& option) {
  return texts(deck, option, Style::kConsole);
}

std::string argument_type(const OptionSpec& option) {
  if (std::holds_alternative<std::monostate>(option.slot) ||
      std::holds_alternative<std::string Deck::*>(option.slot))
    return std::string(option.argument);
  if (is_boolean(option))
    return option.takes_argument ? "true or false" : "none on the command line, true or false";
  const std::string range = range_text(option.lo, option.hi);
  const std::string suffix = range.empty() ? "" : fmt::format(" ({})", range);
  if (!option.values.empty()) return "name or integer";
  if (std::holds_alternative<double Deck::*>(option.slot)) return "floating point value" + suffix;
  if (std::holds_alternative<Ids Deck::*>(option.slot)) return "integers" + suffix;
  if (std::holds_alternative<std::vector<MaterialValue> Deck::*>(option.slot)) return "id and value" + suffix;
  if (std::holds_alternative<std::vector<IdName> Deck::*>(option.slot)) return "id and name";
  if (std::holds_alternative<std::vector<IdBox> Deck::*>(option.slot))
    return "id xmin ymin zmin xmax ymax zmax";
  if (std::holds_alternative<std::vector<NumberRecord> Deck::*>(option.slot)) return "numbers";
  return "integer" + suffix;
}

bool is_boolean(const OptionSpec& option) { return std::holds_alternative<bool Deck::*>(option.slot); }

bool shows_argument(const OptionSpec& option) { return !is_boolean(option) || option.takes_argument; }

bool is_repeatable(const OptionSpec& option) {
  const auto records = [](auto slot) {
    if constexpr (std::is_same_v<decltype(slot), std::monostate>) {
      return false;
    } else {
      return kIsRecords<Field<decltype(slot)>>;
    }
  };
  return std::visit(records, option.slot);
}

bool equals_default(const Deck& deck, const OptionSpec& option) {
  const auto same = [&](auto slot) {
    if constexpr (std::is_same_v<decltype(slot), std::monostate>) {
      return true;
    } else {
      return deck.*slot == Deck{}.*slot;
    }
  };
  return std::visit(same, option.slot);
}

std::vector<std::string> value_names(const OptionSpec& option) {
  std::vector<std::string> result;
  for (const EnumValue& value : option.values) {
    if (find_value(option, value.number) != &value) continue;
    std::string names;
    for (const EnumValue& alias : option.values)
      if (alias.number == value.number && !to_number<int>(alias.name))
        names += (names.empty() ? "" : ", ") + std::string(alias.name);
    const bool refused = option.supported && !value.supported;
    result.push_back(fmt::format("{} ({}){}", names, value.number, refused ? " [not supported yet]" : ""));
  }
  return result;
}

const EnumValue* find_value(const OptionSpec& option, int number) {
  for (const EnumValue& value : option.values)
    if (value.number == number) return &value;
  return nullptr;
}

}  // namespace sculpt
