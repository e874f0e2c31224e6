// The rules of csmooth on curves whose shape is known.
#include "contour/curve_rules.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace sculpt {
namespace {

constexpr CurveRule kShapeKeepers[] = {CurveRule::kCircle, CurveRule::kHermite, CurveRule::kAverageTangent,
                                       CurveRule::kVfrac};

using Curve = std::function<Vec3(double)>;

CurveNeighbourhood around(const Curve& curve, double t, double step) {
  return {curve(t - 2 * step), curve(t - step), curve(t), curve(t + step), curve(t + 2 * step)};
}

const Curve kLine = [](double t) { return Vec3{1 + 2 * t, -t, 3 + 0.5 * t}; };
const Curve kCircle = [](double t) { return Vec3{2, 5 * std::cos(t), 5 * std::sin(t)}; };
const Curve kHelix = [](double t) { return Vec3{3 * std::cos(t), 3 * std::sin(t), 0.7 * t}; };

TEST(CurveMove, LeavesAnEvenLineAlone) {
  for (const CurveRule rule : {CurveRule::kOff, CurveRule::kCircle, CurveRule::kHermite,
                               CurveRule::kAverageTangent, CurveRule::kVfrac, CurveRule::kLinear}) {
    EXPECT_NEAR(norm(curve_move(rule, around(kLine, 0.3, 0.4))), 0, 1e-12);
    CurveNeighbourhood ends = around(kLine, 0.3, 0.4);
    ends.before = ends.a;
    ends.after = ends.b;
    ends.ends_at_a = ends.ends_at_b = true;
    EXPECT_NEAR(norm(curve_move(rule, ends)), 0, 1e-12);
  }
}

TEST(CurveMove, EvensOutALineWithoutLeavingIt) {
  CurveNeighbourhood uneven = around(kLine, 0, 1);
  uneven.x = kLine(0.5);
  const Vec3 along = unit(uneven.b - uneven.a), all_the_way = kLine(0) - uneven.x;
  for (const CurveRule rule : {CurveRule::kCircle, CurveRule::kHermite, CurveRule::kAverageTangent,
                               CurveRule::kVfrac, CurveRule::kLinear}) {
    const Vec3 move = curve_move(rule, uneven);
    EXPECT_NEAR(norm(move - dot(move, along) * along), 0, 1e-12);
    EXPECT_GT(dot(move, all_the_way), 0) << "towards the middle";
    EXPECT_LE(norm(move), 1.3 * norm(all_the_way));
  }
}

// Terms of the second order in the step would be 0.5 R step^2 (1.25 of the step itself at R = 5).
TEST(CurveMove, LeavesAnEvenCircleAlone) {
  for (const double step : {0.1, 0.3}) {
    const CurveNeighbourhood c = around(kCircle, 0.7, step);
    const double fourth_order = 5 * step * step * step * step;
    for (const CurveRule rule : kShapeKeepers)
      EXPECT_LT(norm(curve_move(rule, c)), 0.2 * fourth_order) << "rule " << static_cast<int>(rule);
    // The straight rule cuts the corner by the height of the arc.
    EXPECT_NEAR(norm(curve_move(CurveRule::kLinear, c)), 5 * (1 - std::cos(step)), 1e-12);
  }
}

TEST(CurveMove, FollowsAHelix) {
  const double step = 0.2;
  for (const CurveRule rule : kShapeKeepers)
    EXPECT_LT(norm(curve_move(rule, around(kHelix, 1.1, step))), 3 * std::pow(step, 4));
}

TEST(CurveMove, TakesASpikeDown) {
  CurveNeighbourhood spike = around(kLine, 0, 1);
  const Vec3 off{0.1, 0.2, 0};  // across the line
  spike.x += off;
  for (const CurveRule rule : {CurveRule::kHermite, CurveRule::kAverageTangent, CurveRule::kLinear})
    EXPECT_LT(dot(curve_move(rule, spike), off), -0.4 * dot(off, off)) << static_cast<int>(rule);
  // These keep what is off the chord.
  for (const CurveRule rule : {CurveRule::kCircle, CurveRule::kVfrac})
    EXPECT_NEAR(norm(curve_move(rule, spike)), 0, 0.02);
}

// The centre of a very flat arc is far away; the point on it is not.
TEST(CurveMove, KeepsItsDigitsOnAFlatArc) {
  for (const double height : {1e-3, 1e-7, 1e-10}) {
    const CurveNeighbourhood flat{{-2, 0, 0}, {-1, 0, 0}, {0, height, 0}, {1, 0, 0}, {2, 0, 0}};
    EXPECT_NEAR(norm(curve_move(CurveRule::kCircle, flat)), 0, 1e-15);
  }
}

TEST(CurveMove, ByHand) {
  // A right angle after a straight piece: tangents (1,0,0) at a and (1,1,0)/2 at b.
  const CurveNeighbourhood bend{{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}};
  const Vec3 hermite = curve_move(CurveRule::kHermite, bend);
  EXPECT_NEAR(norm(hermite - Vec3{0.125, -0.125, 0}), 0, 1e-15);
  const double diagonal = std::sqrt(0.5);
  const Vec3 tangent = curve_move(CurveRule::kAverageTangent, bend);
  EXPECT_NEAR(norm(tangent - Vec3{0.25 * (1 - diagonal), -0.25 * diagonal, 0}), 0, 1e-15);
}

}  // namespace
}  // namespace sculpt
