#pragma once
// The console: one rank speaks, `quiet` silences it. Users parse this output, so it goes to stdout unbuffered
// by line.
#include <fmt/core.h>

#include <cstdio>
#include <utility>

namespace sculpt {

class Log {
 public:
  Log() = default;
  explicit Log(bool speaks) : speaks_(speaks) {}

  template <class... T>
  void line(fmt::format_string<T...> format, T&&... args) const {
    if (!speaks_) return;
    fmt::print(stdout, format, std::forward<T>(args)...);
    std::fputc('\n', stdout);
    std::fflush(stdout);
  }
  void line() const { line(""); }
  [[nodiscard]] bool speaks() const { return speaks_; }

 private:
  bool speaks_ = false;
};

}  // namespace sculpt
