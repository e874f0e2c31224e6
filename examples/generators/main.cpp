// microstructure KIND ... FILE: makes the inputs of the examples and benchmarks. The same command gives the
// same bytes on every machine.
#include <charconv>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "balls.hpp"
#include "fractions.hpp"
#include "grains.hpp"
#include "pebble.hpp"
#include "phases.hpp"
#include "spheres.hpp"
#include "spray.hpp"

namespace {

using microstructure::Counts;

constexpr const char* kHelp = R"(Usage:
  microstructure grains NX NY NZ GRAINS SEED FILE.spn     polycrystal, rough grain boundaries
  microstructure phases NX NY NZ RADIUS SEED FILE.spn     two interwoven phases, ids 1 and 2
  microstructure spray NX NY NZ SEED FILE.spn             spray deposit: 1 pores, 2 and 3 splats
  microstructure balls NX NY NZ COUNT SEED FILE.spn       balls (2) in a matrix (1)
  microstructure fractions NX NY NZ GRAINS SEED FILE.tec  polycrystal as volume fractions
  microstructure spheres BOX COUNT SEED FILE.diatom       balls of several sizes in the cube from 0 to BOX
  microstructure pebble LEVEL SEED FILE.stl               a bumpy hollow body of 16 * 4^LEVEL triangles

NX, NY, NZ: number of cells, up to 600. An .spn file has z fastest and x slowest, one row of the file per row of cells along z.
)";

class Arguments {
 public:
  explicit Arguments(std::vector<std::string> words) : words_(std::move(words)) {}

  std::string text() {
    if (at_ == words_.size()) throw std::runtime_error("too few arguments; see microstructure -h");
    return words_[at_++];
  }
  std::int64_t number(std::int64_t lo, std::int64_t hi) {
    const std::string word = text();
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || value < lo || value > hi)
      throw std::runtime_error("found '" + word + "', expected an integer from " + std::to_string(lo) +
                               " to " + std::to_string(hi));
    return value;
  }
  Counts counts() {
    Counts n;
    for (std::int64_t& c : n) c = number(1, 600);
    return n;
  }
  std::uint64_t seed() { return static_cast<std::uint64_t>(number(0, INT32_MAX)); }

 private:
  std::vector<std::string> words_;
  std::size_t at_ = 0;
};

void make(Arguments& arguments) {
  const std::string kind = arguments.text();
  if (kind == "-h" || kind == "--help") {
    std::fputs(kHelp, stdout);
  } else if (kind == "grains" || kind == "fractions") {
    microstructure::GrainOptions options;
    options.n = arguments.counts();
    options.grains = arguments.number(1, 1000000);
    options.seed = arguments.seed();
    if (kind == "grains") {
      write_spn(arguments.text(), make_grains(options));
      return;
    }
    for (std::int64_t& c : options.n) c *= 2;
    options.warp *= 4;
    options.sweeps = 0;
    write_fractions(arguments.text(), make_grains(options), static_cast<std::int32_t>(options.grains));
  } else if (kind == "phases") {
    const Counts n = arguments.counts();
    const std::int64_t radius = arguments.number(1, 29);  // more could overflow the sums
    const std::uint64_t seed = arguments.seed();
    write_spn(arguments.text(), microstructure::make_two_phases(n, radius, seed));
  } else if (kind == "spray") {
    const Counts n = arguments.counts();
    const std::uint64_t seed = arguments.seed();
    write_spn(arguments.text(), microstructure::make_spray(n, seed));
  } else if (kind == "balls") {
    microstructure::BallOptions options;
    options.n = arguments.counts();
    options.count = arguments.number(1, 10000);
    options.seed = arguments.seed();
    write_spn(arguments.text(), make_balls(options));
  } else if (kind == "spheres") {
    microstructure::SphereOptions options;
    options.box = arguments.number(1, 100000);
    options.count = arguments.number(1, 5000);
    options.seed = arguments.seed();
    write_spheres(arguments.text(), options);
  } else if (kind == "pebble") {
    microstructure::PebbleOptions options;
    options.level = arguments.number(0, 10);
    options.seed = arguments.seed();
    write_pebble(arguments.text(), options);
  } else {
    throw std::runtime_error("found '" + kind +
                             "', expected grains, phases, spray, balls, fractions, spheres or pebble");
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Arguments arguments({argv + 1, argv + argc});
    make(arguments);
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "microstructure: %s\n", e.what());
    return 1;
  }
}
