#include "input/diatom.hpp"

#include <fmt/core.h>

#include "input/diatom_file.hpp"
#include "input/geometry_grid.hpp"
#include "input/shape_source.hpp"
#include "input/stl.hpp"
#include "input/text_file.hpp"

namespace sculpt {
namespace {

// Collective. The shapes with the solids of their STL files; without those that are empty.
std::vector<MaterialShape> with_solids(const Comm& comm, const Deck& deck, const std::string& path,
                                       std::vector<DiatomShape> parsed, const Log& log) {
  std::vector<StlFile> files;
  for (const DiatomShape& shape : parsed)
    if (shape.shape == nullptr)
      files.push_back({shape.stl_file, fmt::format("{}, line {}", path, shape.line)});
  std::vector<StlSolid> solids = open_solids(comm, deck, files, log);
  std::vector<MaterialShape> shapes;
  std::size_t next = 0;
  for (DiatomShape& shape : parsed) {
    std::shared_ptr<const FacetMesh> facets;
    if (shape.shape == nullptr) {
      shape.shape = std::move(solids[next].solid);
      facets = std::move(solids[next++].facets);
    }
    if (shape.shape != nullptr)
      shapes.push_back({std::move(shape.shape), shape.material, std::move(facets), std::move(shape.package)});
  }
  if (shapes.empty())
    throw AgreedError(fmt::format("{}: none of its STL files holds a facet, expected a shape", path));
  return shapes;
}

}  // namespace

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
  std::vector<DiatomShape> parsed;
  collectively(comm, "reading " + path, [&] { parsed = parse_diatom(text, path); });
  std::vector<MaterialShape> shapes = with_solids(comm, deck, path, std::move(parsed), log);
  log.line(" Finished creating diatoms");
  return shape_source(comm, deck, "diatom_file", std::move(shapes), overlay, log);
}

}  // namespace sculpt
