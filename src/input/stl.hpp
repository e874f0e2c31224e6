#pragma once
// Solids of STL files, and `stl_file`: one of them as material 1.
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "input/placement.hpp"
#include "sculpt/facets/facet_mesh.hpp"
#include "sculpt/facets/faceted_solid.hpp"
#include "sculpt/input/material_source.hpp"

namespace sculpt {

// A file that is to be read, what names it, for messages ("stl_file" or "deck.diatom, line 7"), and where its
// solid goes.
struct StlFile {
  std::string path, named_by;
  Placement placement{};
};

struct StlSolid {
  std::unique_ptr<FacetedSolid> solid;      // null: the file holds no facets
  std::shared_ptr<const FacetMesh> facets;  // all of them, divided into smooth surfaces, on every rank; null
                                            // unless these are asked for
};

// Collective. The solids of the files; a file without facets is told by a warning. Rank 0 reads, repairs and
// reports; the others know the bounds only, until hand_out() is called. Files that cannot be opened are named
// together. Throws AgreedError.
[[nodiscard]] std::vector<StlSolid> open_solids(const Comm& comm, const Deck& deck,
                                                const std::vector<StlFile>& files, const Log& log);

// Those that there are, in order.
[[nodiscard]] std::vector<FacetedSolid*> solids_of(std::span<const StlSolid> stl);

// Collective. Every rank gets of the solids what it needs in its region (known to all ranks); rank 0 drops
// the rest.
void hand_out(const Comm& comm, std::span<FacetedSolid* const> solids, std::span<const Box> regions);

// Collective. Throws AgreedError.
[[nodiscard]] std::unique_ptr<MaterialSource> open_stl(const Comm& comm, const Deck& deck, const Log& log,
                                                       const std::optional<Box>& overlay);

}  // namespace sculpt
