#pragma once
// Solids of STL files, and `stl_file`: one of them as material 1.
#include <memory>
#include <string>
#include <vector>

#include "input/placement.hpp"
#include "sculpt/facets/facet_mesh.hpp"
#include "sculpt/input/material_source.hpp"

namespace sculpt {

// A file that is to be read, what names it, for messages ("stl_file" or "deck.diatom, line 7"), and where its
// solid goes.
struct StlFile {
  std::string path, named_by;
  Placement placement{};
};

struct StlSolid {
  std::unique_ptr<Shape> shape;             // null: the file holds no facets
  std::shared_ptr<const FacetMesh> facets;  // divided into smooth surfaces; null unless these are asked for
};

// Collective. The solids of the files, the same on all ranks; a file without facets is told by a warning.
// Rank 0 reads, repairs and reports. Files that cannot be opened are named together. Throws AgreedError.
[[nodiscard]] std::vector<StlSolid> open_solids(const Comm& comm, const Deck& deck,
                                                const std::vector<StlFile>& files, const Log& log);

// Collective. Throws AgreedError.
[[nodiscard]] std::unique_ptr<MaterialSource> open_stl(const Comm& comm, const Deck& deck, const Log& log,
                                                       const std::optional<Box>& overlay);

}  // namespace sculpt
