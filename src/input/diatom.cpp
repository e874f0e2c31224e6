#include "input/diatom.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "input/diatom_file.hpp"
#include "input/geometry_grid.hpp"
#include "input/shape_source.hpp"
#include "input/text_file.hpp"

namespace sculpt {
namespace {

using SharedShapes = std::vector<std::shared_ptr<const Shape>>;

bool overlap(const Box& a, const Box& b) {
  for (std::size_t d = 0; d < 3; ++d)
    if (a.lo[d] > b.hi[d] || b.lo[d] > a.hi[d]) return false;
  return true;
}

// The solids of a file's packages, once its STL files are read.
class Assembly {
 public:
  Assembly(DiatomFile& file, std::vector<StlSolid>& stl, const std::string& path, const Log& log)
      : file_(file), stl_(stl), path_(path), log_(log) {}

  // Warns of packages without a solid.
  std::vector<MaterialShape> shapes() {
    for (DiatomPackage& package : file_.packages) {
      const std::size_t first = shapes_.size();
      assemble(package);
      if (shapes_.size() > first) continue;
      log_.line("WARNING: {}, line {}: package '{}' fills nothing: it has no solid", path_, package.line,
                package.name);
    }
    if (shapes_.empty()) throw Error(path_ + ": all of its STL files are empty, expected at least one solid");
    return std::move(shapes_);
  }

 private:
  void assemble(DiatomPackage& package) {
    const SharedShapes of_package = shared(package.deleted);
    for (DiatomInsert& insert : package.inserts) {
      MaterialShape shape = solid_of(insert.solid);
      SharedShapes removed = shared(insert.deleted);
      if (shape.shape == nullptr) continue;
      removed.insert(removed.end(), of_package.begin(), of_package.end());
      cut(shape, std::move(removed), insert.line);
      shape.material = package.material;
      shape.package = package.name;
      shape.line = package.line;
      shapes_.push_back(std::move(shape));
    }
  }
  // Without a shape when the STL file holds no facets.
  MaterialShape solid_of(DiatomSolid& solid) {
    if (solid.shape != nullptr) return {std::move(solid.shape)};
    StlSolid& stl = stl_[solid.stl_file];
    return {std::move(stl.solid), 0, std::move(stl.facets)};
  }
  SharedShapes shared(std::vector<DiatomSolid>& solids) {
    SharedShapes shapes;
    for (DiatomSolid& solid : solids)
      if (MaterialShape shape = solid_of(solid); shape.shape) shapes.push_back(std::move(shape.shape));
    return shapes;
  }
  // The surface that deleting makes is in no file: the curves of such an STL solid are not captured.
  void cut(MaterialShape& shape, SharedShapes removed, std::int64_t line) {
    const Box bounds = shape.shape->bounds();
    std::erase_if(removed, [&](const auto& other) { return !overlap(bounds, other->bounds()); });
    if (removed.empty()) return;
    shape.shape = difference(std::move(shape.shape), std::move(removed));
    if (shape.facets == nullptr) return;
    shape.facets = nullptr;
    log_.line(
        "WARNING: {}, line {}: parts of the STL solid are deleted, it counts as one surface without curves",
        path_, line);
  }

  DiatomFile& file_;
  std::vector<StlSolid>& stl_;
  const std::string& path_;
  const Log& log_;
  std::vector<MaterialShape> shapes_;
};

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
  DiatomFile file;
  collectively(comm, "reading " + path, [&] { file = parse_diatom(text, path); });
  std::vector<StlSolid> stl = open_solids(comm, deck, file.stl_files, log);
  const std::vector<FacetedSolid*> solids = solids_of(stl);
  std::vector<MaterialShape> shapes;
  collectively(comm, "making the solids of " + path,
               [&] { shapes = Assembly(file, stl, path, log).shapes(); });
  log.line(" Finished creating diatoms");
  return shape_source(comm, deck, "diatom_file", std::move(shapes), solids, overlay, log);
}

}  // namespace sculpt
