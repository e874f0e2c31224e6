#include "options.hpp"

#include <charconv>
#include <stdexcept>

namespace hexmesh {
namespace {

template <class T>
T parsed(const std::string& name, const std::string& text, T lo, T hi, const char* kind) {
  T value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error == std::errc() && stop == end && value >= lo && value <= hi) return value;
  throw std::runtime_error("--" + name + ": found '" + text + "', expected " + kind + " from " +
                           std::to_string(lo) + " to " + std::to_string(hi));
}

}  // namespace

Options::Options(std::vector<std::string> words) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (!words[i].starts_with("--")) {
      files_.push_back(words[i]);
      continue;
    }
    if (i + 1 == words.size()) throw std::runtime_error(words[i] + ": no value");
    given_.push_back({words[i].substr(2), words[i + 1]});
    ++i;
  }
}

const std::string* Options::value_of(const std::string& name) {
  known_.insert(name);
  for (const Given& g : given_)
    if (g.name == name) return &g.value;
  return nullptr;
}

std::int32_t Options::integer(const std::string& name, std::int32_t unset, std::int32_t lo, std::int32_t hi) {
  const std::string* text = value_of(name);
  return text == nullptr ? unset : parsed(name, *text, lo, hi, "an integer");
}

double Options::number(const std::string& name, double unset, double lo, double hi) {
  const std::string* text = value_of(name);
  return text == nullptr ? unset : parsed(name, *text, lo, hi, "a number");
}

bool Options::has(const std::string& name) const {
  for (const Given& g : given_)
    if (g.name == name) return true;
  return false;
}

std::string Options::file() const {
  for (const Given& g : given_)
    if (!known_.contains(g.name)) {
      std::string names;
      for (const std::string& k : known_) names += " --" + k;
      throw std::runtime_error("no option --" + g.name + " here; there are" + names);
    }
  if (files_.size() != 1)
    throw std::runtime_error("found " + std::to_string(files_.size()) + " file names, expected one");
  return files_[0];
}

}  // namespace hexmesh
