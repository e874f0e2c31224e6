// solid KIND [--option value ...] FILE.stl: makes the STL files of examples.
#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>

#include "solids/solids.hpp"

namespace {

using sculpt::examples::Facets;

constexpr const char* kHelp =
    "Usage: solid KIND [--option value ...] FILE.stl\n\n"
    "  sphere    --levels N (4): an octahedron cut N times; --radius R (1)\n"
    "  box       --x A --y B --z C (1): half its size\n"
    "  cylinder  --radius R (1) --half-height H (1) --sides N (64)\n"
    "  bracket   --sides N (32): of the two holes, a multiple of 4\n\n"
    "For all kinds:\n"
    "  --about-z A --about-x B   turned by these degrees, about z first\n"
    "  --ascii 1                 as text";

// The options of the command line: every one has a number.
class Options {
 public:
  Options(int argc, char** argv) {
    for (int i = 2; i + 1 < argc; i += 2) {
      const std::string name = argv[i];
      if (name.rfind("--", 0) != 0) throw std::runtime_error("found " + name + ", expected an option");
      value_[name.substr(2)] = std::stod(argv[i + 1]);
    }
  }
  double take(const std::string& name, double otherwise) {
    const auto found = value_.find(name);
    if (found == value_.end()) return otherwise;
    const double value = found->second;
    value_.erase(found);
    return value;
  }
  int take_count(const std::string& name, int otherwise) { return static_cast<int>(take(name, otherwise)); }
  void check_all_taken() const {
    if (!value_.empty()) throw std::runtime_error("unknown option --" + value_.begin()->first);
  }

 private:
  std::map<std::string, double> value_;
};

Facets make(const std::string& kind, Options& options) {
  if (kind == "sphere") {
    const double radius = options.take("radius", 1);
    Facets facets = sculpt::examples::sphere(options.take_count("levels", 4));
    for (auto& facet : facets)
      for (sculpt::Vec3& p : facet) p = radius * p;
    return facets;
  }
  if (kind == "box")
    return sculpt::examples::box({options.take("x", 1), options.take("y", 1), options.take("z", 1)});
  if (kind == "cylinder")
    return sculpt::examples::cylinder(options.take("radius", 1), options.take("half-height", 1),
                                      options.take_count("sides", 64));
  if (kind == "bracket") return sculpt::examples::bracket(options.take_count("sides", 32));
  throw std::runtime_error("unknown kind '" + kind + "'; there are: sphere, box, cylinder, bracket");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3 || argc % 2 == 0) {
    std::puts(kHelp);
    return 1;
  }
  try {
    Options options(argc - 1, argv);
    const std::string kind = argv[1], file = argv[argc - 1];
    Facets facets = make(kind, options);
    sculpt::examples::turn(facets, options.take("about-z", 0), options.take("about-x", 0));
    const bool ascii = options.take("ascii", 0) != 0;
    options.check_all_taken();
    std::ofstream out(file, std::ios::binary);
    out << (ascii ? sculpt::examples::ascii_stl(facets, kind) : sculpt::examples::binary_stl(facets, kind));
    if (!out.flush()) throw std::runtime_error("cannot write " + file);
    std::printf("%s: %zu facets\n", file.c_str(), facets.size());
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "solid: %s\n", e.what());
    return 1;
  }
}
