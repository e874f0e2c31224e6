#pragma once
// The report's own optimisation (sections 2.12.3 and 2.12.4), for comparison: Jacobi passes with damping over
// the poor hexes, then single nodes chosen by colouring. Nodes of surfaces move along them, nodes of curves
// and vertices only where a hex is below the threshold of curves.
#include "sculpt/smooth/smooth.hpp"
#include "smooth/active_set.hpp"

namespace sculpt {

// Collective. geometry.onto is needed. improve_sweeps: Jacobi passes, target_rounds: passes of the colouring.
void optimise_as_published(ActiveSet& set, const Geometry& geometry, const SmoothOptions& options,
                           const Log& log);

}  // namespace sculpt
