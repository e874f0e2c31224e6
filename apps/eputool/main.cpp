// eputool -p N base: joins base.e.N.0 ... into base.e, with the options of SEACAS `epu` that Sculpt users
// know.
#include <fmt/core.h>

#include <charconv>
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "sculpt/base/error.hpp"
#include "sculpt/exo/merge_files.hpp"

namespace {

constexpr const char* kHelp = R"(Usage: eputool -p N [options] base
       eputool -auto base.e.N.r

Joins the files base.e.N.0 ... base.e.N.(N-1) of a parallel run into base.e.

  -p, -processor_count N    number of files
  -auto                     take base, extension and N from the name of one of the files
  -extension EXT            extension of the files (default: e)
  -output_extension EXT     extension of the joined file (default: that of the files)
  -output FILE              whole name of the joined file
  -version                  print the version and stop
  -help                     print this text and stop
)";

struct Request {
  bool help = false, version = false, automatic = false;
  int ranks = 0;
  std::string base;
  sculpt::MergeOptions merge;
};

int parse_count(std::string_view text, std::string_view what) {
  int count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || end != text.data() + text.size() || count < 1)
    throw sculpt::Error(fmt::format("{}: '{}' found, expected a number from 1 up", what, text));
  return count;
}

// base.e.10.07 -> base, e, 10
void take_apart(Request& request) {
  const std::string name = request.base;
  const std::size_t rank = name.rfind('.'),
                    ranks = rank == std::string::npos ? rank : name.rfind('.', rank - 1);
  const std::size_t extension =
      ranks == std::string::npos || ranks == 0 ? std::string::npos : name.rfind('.', ranks - 1);
  if (extension == std::string::npos || extension == 0)
    throw sculpt::Error(fmt::format("-auto: '{}' found, expected a name such as mesh.e.4.0", name));
  request.ranks = parse_count(std::string_view(name).substr(ranks + 1, rank - ranks - 1), "-auto " + name);
  request.merge.extension = name.substr(extension + 1, ranks - extension - 1);
  request.base = name.substr(0, extension);
}

Request parse(const std::vector<std::string>& words) {
  Request request;
  for (std::size_t n = 0; n < words.size(); ++n) {
    std::string option = words[n];
    if (option.size() > 2 && option.starts_with("--")) option.erase(0, 1);
    const auto value = [&]() -> const std::string& {
      if (n + 1 == words.size()) throw sculpt::Error(fmt::format("option {} needs a value", option));
      return words[++n];
    };
    if (option == "-help" || option == "-h") {
      request.help = true;
    } else if (option == "-version") {
      request.version = true;
    } else if (option == "-auto") {
      request.automatic = true;
    } else if (option == "-p" || option == "-processor_count") {
      request.ranks = parse_count(value(), option);
    } else if (option == "-extension") {
      request.merge.extension = value();
    } else if (option == "-output_extension") {
      request.merge.output_extension = value();
    } else if (option == "-output") {
      request.merge.output = value();
    } else if (option.starts_with("-")) {
      throw sculpt::Error(fmt::format("unknown option '{}'; see eputool -help", words[n]));
    } else if (!request.base.empty()) {
      throw sculpt::Error(fmt::format("'{}' found after '{}', expected one base name", option, request.base));
    } else {
      request.base = option;
    }
  }
  if (request.help || request.version) return request;
  if (request.base.empty()) throw sculpt::Error("no base name given; see eputool -help");
  if (request.automatic) take_apart(request);
  if (request.ranks == 0) throw sculpt::Error("the number of files is missing: eputool -p N base");
  return request;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows beyond `ulimit -f` is an error with a message
  try {
    const Request request = parse({argv + 1, argv + argc});
    if (request.help) return std::fputs(kHelp, stdout) < 0;
    if (request.version) return std::puts("eputool " SCULPT_VERSION) < 0;
    const sculpt::MergeResult joined = sculpt::merge_files(request.base, request.ranks, request.merge);
    fmt::print("{}: {} nodes, {} elements, {} blocks, {} side sets, {} node sets from {} file{}\n",
               joined.path, joined.nodes, joined.elements, joined.blocks, joined.side_sets, joined.node_sets,
               request.ranks, request.ranks == 1 ? "" : "s");
    if (joined.element_variables > 0)
      fmt::print("{} element variable{} at {} time step{}\n", joined.element_variables,
                 joined.element_variables == 1 ? "" : "s", joined.time_steps,
                 joined.time_steps == 1 ? "" : "s");
    if (joined.dropped_variables > 0)
      fmt::print("warning: {} variables of nodes, sets or the whole mesh were left out\n",
                 joined.dropped_variables);
    return 0;
  } catch (const std::exception& e) {
    fmt::print(stderr, "eputool: {}\n", e.what());
    return 1;
  }
}
