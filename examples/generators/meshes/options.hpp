#pragma once
// The words of a command line: --name value pairs and one file name.
#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace hexmesh {

class Options {
 public:
  explicit Options(std::vector<std::string> words);

  // Values in lo .. hi; throw std::runtime_error for others.
  [[nodiscard]] std::int32_t integer(const std::string& name, std::int32_t unset, std::int32_t lo,
                                     std::int32_t hi);
  [[nodiscard]] double number(const std::string& name, double unset, double lo, double hi);
  [[nodiscard]] bool has(const std::string& name) const;
  // The file name. Throws when there is none or more than one, or an option that nobody asked for.
  [[nodiscard]] std::string file() const;

 private:
  [[nodiscard]] const std::string* value_of(const std::string& name);

  struct Given {
    std::string name, value;
  };
  std::vector<Given> given_;
  std::vector<std::string> files_;
  std::set<std::string> known_;
};

}  // namespace hexmesh
