#pragma once
// Which cells are halved: the criteria of adapt_type (the report, section 2.5; docs/adaptivity.md). Local.
#include <vector>

#include "sculpt/adapt/forest.hpp"
#include "sculpt/grid/grid.hpp"
#include "sculpt/input/material_source.hpp"

namespace sculpt {

enum class AdaptMeasure {
  // The fractions of the eight parts of a cell differ from their average, or those just inside one of its
  // sides from those just outside.
  kFractions,
  kFacetToSurface,    // distance of the geometry from the plane that stands for it in the cell
  kSurfaceToFacet,    // distance of that plane from the geometry
  kSurfaceToSurface,  // distance of the planes in the parts of the cell from its plane
  kMaterial,          // a material is in the cell, or near it
};

struct AdaptCriterion {
  AdaptMeasure measure = AdaptMeasure::kFractions;
  double threshold = 0;  // fraction or length; a cell is halved when its measure is larger
  struct Material {
    std::int32_t material;  // dense index
    int levels;             // how often its cells may be halved
    double fraction;        // halved when the cell holds more than this
    double distance;        // or a box this much larger on every side does; a length
  };
  std::vector<Material> materials;  // of kMaterial
  bool non_manifold = false;        // cells around a non-manifold node are halved as well
  ExactSurface exact;               // of kFacetToSurface and kSurfaceToFacet
};

// Marks the cells of a part of the grid that the criterion asks for, and their parts in turn. The field must
// know the cells, one cell of the grid around them, and what the distances of the materials reach.
void mark_cells(const Grid& grid, const IndexBox& cells, MaterialField& field,
                const AdaptCriterion& criterion, Forest& forest);

}  // namespace sculpt
