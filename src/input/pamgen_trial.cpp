#include "input/pamgen_trial.hpp"

#include <create_inline_mesh.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <climits>
#include <cstring>
#include <string_view>

#include "sculpt/base/error.hpp"

namespace sculpt {
namespace {

constexpr char kFailed = '!';  // the first character of an answer that is a problem

// One blank for every run of blanks and ends of lines, none at the ends.
std::string tidy(std::string_view text) {
  std::string tidied;
  for (const char c : text) {
    if (tidied.ends_with('.') && c == 'T') tidied += ' ';  // Pamgen joins "....Terminating from ..."
    if (std::isspace(static_cast<unsigned char>(c)) == 0)
      tidied += c;
    else if (!tidied.empty() && tidied.back() != ' ')
      tidied += ' ';
  }
  while (tidied.ends_with(' ') || tidied.ends_with('.')) tidied.pop_back();
  return tidied;
}

std::string stream_text(long long (*size)(), char* (*copy)(char*)) {
  std::string text(static_cast<std::size_t>(size()) + 1, '\0');
  copy(text.data());
  return text.c_str();
}

std::string complaint(long long code) {
  if (code == ERROR_PARSING_DEFINITION) {
    // Mistakes of grammar are in the echo, others in the error stream, which is there once a type is known.
    const std::string where = first_complaint(stream_text(getPamgenEchoStreamSize, getPamgenEchoStream));
    if (!where.empty()) return where;
  }
  const std::string told = tidy(stream_text(getPamgenErrorStreamSize, getPamgenErrorStream));
  return told.empty() ? fmt::format("Pamgen makes no mesh of it (code {})", code) : told;
}

// In the process of the trial: the number of parts, or what went wrong.
std::string answer(const std::string& text, int most_parts) {
  std::string problem;
  for (int parts = most_parts; parts >= 1; --parts) {
    const long long code = Create_Pamgen_Mesh(text.c_str(), 3, 0, parts, INT_MAX);
    if (code == ERROR_FREE_CREATION) return std::to_string(parts);
    if (problem.empty()) problem = kFailed + complaint(code);
    if (code == ERROR_PARSING_DEFINITION) break;
    Delete_Pamgen_Mesh();
  }
  return problem;
}

void send(int pipe, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t done = ::write(pipe, bytes.data(), bytes.size());
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return;
    bytes.remove_prefix(static_cast<std::size_t>(done));
  }
}

std::string receive(int pipe) {
  std::string bytes;
  std::array<char, 4096> piece{};
  for (;;) {
    const ssize_t got = ::read(pipe, piece.data(), piece.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return bytes;
    bytes.append(piece.data(), static_cast<std::size_t>(got));
  }
}

[[noreturn]] void run_trial(int pipe, const std::string& text, int most_parts) {
  const int nowhere = ::open("/dev/null", O_WRONLY);
  if (nowhere >= 0) {
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
  }
  send(pipe, answer(text, most_parts));
  ::_exit(0);
}

}  // namespace

std::string first_complaint(const std::string& echo) {
  constexpr std::string_view kMark = "***** ERROR Parsing: ";
  const std::size_t mark = echo.find(kMark);
  if (mark == std::string::npos) return {};
  // Pamgen numbers the lines that it repeats: "    9:     gmn =". Those of earlier descriptions come
  // first, and the last of each has no end of line.
  int line = 0;
  for (std::size_t at = 0; at < mark; at = std::min(echo.find('\n', at), mark - 1) + 1) {
    std::size_t digit = echo.find_first_not_of(' ', at);
    int number = 0;
    for (; digit < mark && std::isdigit(static_cast<unsigned char>(echo[digit])) != 0; ++digit)
      number = 10 * number + (echo[digit] - '0');
    if (number > 0 && digit < mark && echo[digit] == ':') line = number;
  }
  // The complaint ends with its line; what was expected may stand on the next one.
  std::string_view rest = std::string_view(echo).substr(mark + kMark.size());
  const std::string first = tidy(rest.substr(0, rest.find('\n')));
  rest.remove_prefix(std::min(rest.size(), rest.find('\n')));
  std::string second;
  if (rest.starts_with("\nexpected")) second = tidy(rest.substr(0, rest.find('\n', 1)).substr(1));
  return fmt::format("line {}: {}{}{}", line, first, second.empty() ? "" : ", ", second);
}

PamgenTrial try_pamgen(const std::string& path, const std::string& text, int most_parts) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    throw Error(fmt::format("'{}': cannot start Pamgen: {}", path, std::strerror(errno)));
  const pid_t child = ::fork();
  if (child < 0) {
    const int cause = errno;
    ::close(ends[0]);
    ::close(ends[1]);
    throw Error(fmt::format("'{}': cannot start Pamgen: {}", path, std::strerror(cause)));
  }
  if (child == 0) run_trial(ends[1], text, most_parts);
  ::close(ends[1]);
  const std::string told = receive(ends[0]);
  ::close(ends[0]);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (told.empty())
    return {
        0,
        "Pamgen crashes on it; expected 'mesh', the type of the geometry, an 'end' for it, for each further "
        "part and for the mesh, and no value or word left out"};
  if (told[0] == kFailed) return {0, told.substr(1)};
  return {std::stoi(told), ""};
}

}  // namespace sculpt
