// The command line: short and long options in any mixture, on top of the deck they name.
#include <fmt/core.h>

#include <optional>
#include <set>

#include "deck/text.hpp"
#include "deck/value.hpp"
#include "sculpt/base/error.hpp"
#include "sculpt/deck/parse.hpp"

namespace sculpt {

namespace {

constexpr std::string_view kWhere = "command line";

[[noreturn]] void fail(const std::string& message) { throw Error(fmt::format("{}: {}", kWhere, message)); }

// An option of the command line with its words, not yet converted.
struct Mention {
  const OptionSpec* option;
  std::string shown;  // as the user wrote it
  std::vector<std::string> words;
};

// "-x", "--nelx", "-print_input"; the part behind '=' is not looked at. nullptr: no such option.
const OptionSpec* find_word(std::string_view word) {
  if (word.starts_with("--")) return find_option(word.substr(2));
  const OptionSpec* option = find_flag(word);
  return option != nullptr ? option : find_option(word.substr(1));
}

bool looks_like_option(std::string_view word) {
  return word.size() > 1 && word[0] == '-' && !to_number<double>(word);
}

// The words of a value that came as one quoted argument: "3 0.2".
std::vector<std::string> split_blanks(std::string_view text) {
  std::vector<std::string> words;
  bool inside = false;
  for (const char c : text) {
    if (!is_blank(c) && !inside) words.emplace_back();
    inside = !is_blank(c);
    if (inside) words.back() += c;
  }
  return words;
}

// Front ends pass file names with their quotes.
std::string without_quotes(const std::string& word) {
  const bool quoted = word.size() >= 2 && (word[0] == '"' || word[0] == '\'') && word.back() == word[0];
  return quoted ? word.substr(1, word.size() - 2) : word;
}

class CommandLineReader {
 public:
  explicit CommandLineReader(std::span<const std::string> words) : words_(words) {}

  std::vector<Mention> read() {
    std::vector<Mention> mentions;
    while (next_ < words_.size()) mentions.push_back(read_option());
    return mentions;
  }

 private:
  Mention read_option() {
    const std::string& word = words_[next_++];
    if (!looks_like_option(word))
      fail(fmt::format("'{}' is not an option; a deck is given with '-i <file>'", word));
    const std::size_t equals = word.find('=');
    Mention mention{nullptr, word.substr(0, equals), {}};
    mention.option = find_word(mention.shown);
    if (mention.option == nullptr) fail_unknown(mention.shown);
    if (mention.option->name == "help") {
      if (next_ < words_.size()) mention.words.push_back(words_[next_]);
      next_ = words_.size();
      return mention;
    }
    if (std::holds_alternative<std::monostate>(mention.option->slot))
      fail(fmt::format("option '{}' is not supported yet", mention.shown));
    if (equals != std::string::npos) {
      mention.words = one_argument(*mention.option, word.substr(equals + 1));
    } else {
      take_words(mention);
    }
    for (std::string& value : mention.words) value = without_quotes(value);
    return mention;
  }

  [[noreturn]] static void fail_unknown(const std::string& shown) {
    if (shown.starts_with("--"))
      fail(fmt::format("unknown option '{}'{}", shown, did_you_mean_option(shown, "--")));
    std::vector<std::string> candidates;
    for (const OptionSpec& option : option_table()) {
      if (option.hidden) continue;
      if (!option.flag.empty()) candidates.emplace_back(option.flag);
      if (shown.size() > 3) candidates.push_back(fmt::format("--{}", option.name));
    }
    fail(fmt::format("unknown option '{}'{}", shown, did_you_mean(shown, candidates)));
  }

  static std::vector<std::string> one_argument(const OptionSpec& option, const std::string& text) {
    if (words_of_value(option) <= 1) return {text};
    return split_blanks(text);
  }

  // Takes the words that belong to the option from the front of what is left.
  void take_words(Mention& mention) {
    const std::size_t wanted = words_of_value(*mention.option);
    const std::string following = next_ < words_.size() ? lower(words_[next_]) : "";
    if (wanted == 0) {
      const bool plain =
          following == "true" || following == "false" || following == "on" || following == "off";
      if (plain || (mention.option->takes_argument && to_bool(following)))
        mention.words.push_back(words_[next_++]);
      return;
    }
    if (wanted > 1 && next_ < words_.size() && split_blanks(words_[next_]).size() > 1) {
      mention.words = split_blanks(words_[next_++]);
      return;
    }
    // Negative numbers are values, and so is an unknown word with a dash where exactly one or a few are
    // wanted: its type check says best what is wrong. A known option ends the value.
    while (next_ < words_.size() && mention.words.size() < wanted) {
      if (looks_like_option(words_[next_]) && find_word(words_[next_]) != nullptr) break;
      if (wanted == kManyWords && looks_like_option(words_[next_])) break;
      mention.words.push_back(words_[next_++]);
    }
  }

  std::span<const std::string> words_;
  std::size_t next_ = 0;
};

// The last mention of an option, or nullptr.
const Mention* last_mention(const std::vector<Mention>& mentions, std::string_view name) {
  const Mention* found = nullptr;
  for (const Mention& mention : mentions)
    if (mention.option->name == name) found = &mention;
  return found;
}

}  // namespace

CommandLine parse_command_line(std::span<const std::string> words, const ReadText& read_text) {
  CommandLine result;
  if (words.empty()) {
    result.action = Action::kHelp;
    return result;
  }
  const std::vector<Mention> mentions = CommandLineReader(words).read();
  if (const Mention* help = last_mention(mentions, "help")) {
    result.action = Action::kHelp;
    if (!help->words.empty()) result.help_topic = help->words[0];
    return result;
  }
  if (const Mention* file = last_mention(mentions, "input_file")) {
    Deck named;
    set_value(named, *file->option, file->words, kWhere, file->shown);
    if (!last_mention(mentions, "version"))
      result.deck = parse_deck(read_text(named.input_file), named.input_file);
  }
  std::set<std::string_view> seen;
  for (const Mention& mention : mentions) {
    if (seen.insert(mention.option->name).second) reset_value(result.deck, *mention.option);
    set_value(result.deck, *mention.option, mention.words, kWhere, mention.shown);
    result.deck.given_options.add(mention.option->name, kWhere);
  }
  if (result.deck.print_input) result.action = Action::kPrintInput;
  if (result.deck.version) result.action = Action::kVersion;
  return result;
}

}  // namespace sculpt
