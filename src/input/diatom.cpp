#include "input/diatom.hpp"

#include "input/diatom_file.hpp"
#include "input/geometry_grid.hpp"
#include "input/shape_source.hpp"
#include "input/text_file.hpp"

namespace sculpt {
std::unique_ptr<MaterialSource> open_diatom(const Comm& comm, const Deck& deck, const Log& log,
                                            const std::optional<Box>& overlay) {
  const std::string& path = deck.diatom_file;
  std::string text;
  log.line("initializing geometry...");
  log.line(" Parsing diatom input");
  collectively(comm, "opening " + path, [&] {
    if (!overlay) check_geometry_grid(deck, "diatom_file");
    if (comm.rank() != 0) return;
    const TextFile file(path, "diatom_file");
    text.resize(static_cast<std::size_t>(file.size()));
    file.read(0, text);
  });
  log.line(" Finished loading diatom master buffer");
  text = comm.broadcast(std::move(text), 0);
  log.line(" Finished communicating diatom master buffer");
  std::unique_ptr<MaterialSource> source;
  collectively(comm, "reading " + path, [&] {
    std::vector<MaterialShape> shapes = parse_diatom(text, path);
    log.line(" Finished creating diatoms");
    source = shape_source(deck, "diatom_file", std::move(shapes), overlay, log);
  });
  return source;
}

}  // namespace sculpt
