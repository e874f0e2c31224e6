#pragma once
// Materials given by shapes, sampled where they are asked for. What no shape covers is the void.
#include <memory>
#include <string>
#include <vector>

#include "sculpt/facets/facet_mesh.hpp"
#include "sculpt/facets/faceted_solid.hpp"
#include "sculpt/input/material_source.hpp"

namespace sculpt {

struct MaterialShape {
  std::unique_ptr<Shape> shape;
  std::int64_t material = 0;  // the user's id, >= 1
  // Of faceted solids whose surfaces are asked for: divided into them. Null: the shape has one surface.
  std::shared_ptr<const FacetMesh> facets{};
  std::string package{};  // of a diatom file
  std::int64_t line = 0;  // of the package in the file
};

// Collective. The shapes, at least one, are in the order of insertion, the same on all ranks; `option` names
// them. solids: those that are among the shapes or parts of them, which ranks other than 0 know the bounds
// of. overlay: the bounds of an overlay mesh; without one the grid follows from the deck and the bounds of
// the shapes (geometry_grid.hpp), which the option align turns first. Throws AgreedError.
[[nodiscard]] std::unique_ptr<MaterialSource> shape_source(const Comm& comm, const Deck& deck,
                                                           const std::string& option,
                                                           std::vector<MaterialShape> shapes,
                                                           std::vector<FacetedSolid*> solids,
                                                           const std::optional<Box>& overlay, const Log& log);

}  // namespace sculpt
