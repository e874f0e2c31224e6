#pragma once
// Where a node of a curve wants to go, from the nodes before and after it (the rules of csmooth that look at
// the curve alone). Pure.
#include "sculpt/base/vec3.hpp"
#include "sculpt/contour/interface_smoothing.hpp"

namespace sculpt {

// Nodes in a row along a curve: before, a, x, b, after; x is the one to move. Where the curve ends at a or b
// there is no node beyond.
struct CurveNeighbourhood {
  Vec3 before, a, x, b, after;
  bool ends_at_a = false, ends_at_b = false;
};

// The move of x. On a straight line and on a circle with even spacing every rule but kLinear leaves x where
// it is, up to terms of the fourth order in the angle between neighbours. Zero for kOff;
// kNeighbourSurfaceNormal looks at surfaces and is not answered here.
[[nodiscard]] Vec3 curve_move(CurveRule rule, const CurveNeighbourhood& c);

}  // namespace sculpt
