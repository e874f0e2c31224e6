#include "input/diatom.hpp"

#include <fmt/core.h>

#include "input/deck_grid.hpp"
#include "input/diatom_file.hpp"
#include "input/shape_source.hpp"
#include "input/stl.hpp"
#include "input/text_file.hpp"

namespace sculpt {
namespace {

// Collective. The shapes with the solids of their STL files; without those that are empty.
std::vector<MaterialShape> with_solids(const Comm& comm, const std::string& path,
                                       std::vector<DiatomShape> parsed, const Log& log) {
  std::vector<StlFile> files;
  for (const DiatomShape& shape : parsed)
    if (shape.shape == nullptr)
      files.push_back({shape.stl_file, fmt::format("{}, line {}", path, shape.line)});
  std::vector<std::unique_ptr<FacetedSolid>> solids = open_solids(comm, files, log);
  std::vector<MaterialShape> shapes;
  std::size_t next = 0;
  for (DiatomShape& shape : parsed) {
    if (shape.shape == nullptr) shape.shape = std::move(solids[next++]);
    if (shape.shape != nullptr) shapes.push_back({std::move(shape.shape), shape.material});
  }
  if (shapes.empty())
    throw AgreedError(fmt::format("{}: none of its STL files holds a facet, expected a shape", path));
  return shapes;
}

}  // namespace

std::unique_ptr<MaterialSource> open_diatom(const Comm& comm, const Deck& deck, const Log& log,
                                            const std::optional<Box>& overlay) {
  const std::string& path = deck.diatom_file;
  Grid grid;
  std::string text;
  log.line("initializing geometry...");
  log.line(" Parsing diatom input");
  collectively(comm, "opening " + path, [&] {
    if (!overlay) grid = deck_box_grid(deck, "diatom_file");
    if (comm.rank() != 0) return;
    const TextFile file(path, "diatom_file");
    text.resize(static_cast<std::size_t>(file.size()));
    file.read(0, text);
  });
  log.line(" Finished loading diatom master buffer");
  text = comm.broadcast(std::move(text), 0);
  log.line(" Finished communicating diatom master buffer");
  std::vector<DiatomShape> parsed;
  collectively(comm, "reading " + path, [&] { parsed = parse_diatom(text, path); });
  std::vector<MaterialShape> shapes = with_solids(comm, path, std::move(parsed), log);
  collectively(comm, "opening " + path, [&] {
    if (overlay) grid = grid_over(*overlay, shapes.size());
  });
  log.line(" Finished creating diatoms");
  return shape_source(deck, std::move(shapes), std::move(grid), log);
}

}  // namespace sculpt
