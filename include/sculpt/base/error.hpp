#pragma once
// The kinds of failure of docs/architecture.md: the user's (Error) and a broken promise of ours (check).
#include <stdexcept>
#include <string>
#include <string_view>

namespace sculpt {

// Bad deck, file or geometry. The text names file and place, what was found and what was expected.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A promise between rooms that did not hold: a defect of the program, never the user's fault.
class BrokenPromise : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

// Always compiled in; meant for the end of a stage, not for inner loops.
inline void check(bool promise, std::string_view what) {
  if (!promise) throw BrokenPromise("internal error: " + std::string(what));
}

}  // namespace sculpt
