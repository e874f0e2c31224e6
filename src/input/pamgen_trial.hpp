#pragma once
// Trying a description of Pamgen out. Pamgen ends the whole process at some mistakes (by an assertion, a null
// pointer or a division by zero), so the first try is made in a process of its own.
#include <string>

namespace sculpt {

struct PamgenTrial {
  int parts = 0;        // the most, up to the number asked for, that Pamgen can cut the mesh in; 0 = no mesh
  std::string problem;  // why there is none
};

// Local. Whether Pamgen takes the description of `path`, and in how many parts. Throws Error when the system
// does not let it try.
[[nodiscard]] PamgenTrial try_pamgen(const std::string& path, const std::string& text, int most_parts);

// What Pamgen repeats of a description up to its first complaint -> "line 7: complaint"; empty = none.
[[nodiscard]] std::string first_complaint(const std::string& echo);

}  // namespace sculpt
