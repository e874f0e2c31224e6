#include <array>

#include "input/cart_exo.hpp"
#include "input/diatom.hpp"
#include "input/micro.hpp"
#include "input/spn.hpp"
#include "input/stl.hpp"
#include "sculpt/input/material_source.hpp"

namespace sculpt {
namespace {

using Open = std::unique_ptr<MaterialSource> (*)(const Comm&, const Deck&, const Log&,
                                                 const std::optional<Box>& overlay);

// A source whose data have a grid of their own.
template <auto open>
std::unique_ptr<MaterialSource> on_its_grid(const Comm& comm, const Deck& deck, const Log& log,
                                            const std::optional<Box>&) {
  return open(comm, deck, log);
}

struct Format {
  const char* option;
  std::string Deck::*path;
  Open open;  // null: not supported yet
};

constexpr std::array<Format, 6> kFormats{{
    {"input_spn", &Deck::input_spn, on_its_grid<open_spn>},
    {"input_micro", &Deck::input_micro, on_its_grid<open_micro>},
    {"diatom_file", &Deck::diatom_file, open_diatom},
    {"input_cart_exo", &Deck::input_cart_exo, on_its_grid<open_cart_exo>},
    {"stl_file", &Deck::stl_file, open_stl},
    {"input_stitch", &Deck::input_stitch, nullptr},
}};

}  // namespace

std::unique_ptr<MaterialSource> open_source(const Comm& comm, const Deck& deck, const Log& log,
                                            const std::optional<Box>& overlay) {
  const Format* chosen = nullptr;
  collectively(comm, "choosing the input", [&] {
    for (const Format& format : kFormats) {
      if ((deck.*format.path).empty()) continue;
      if (chosen != nullptr)
        throw Error(std::string("both ") + chosen->option + " and " + format.option +
                    " are given, expected one source of materials");
      if (format.open == nullptr) throw Error(std::string(format.option) + " is not supported yet");
      chosen = &format;
    }
    if (chosen == nullptr)
      throw Error(
          "no source of materials: expected one of input_spn, input_micro, diatom_file, stl_file and "
          "input_cart_exo");
  });
  return chosen->open(comm, deck, log, overlay);
}

}  // namespace sculpt
