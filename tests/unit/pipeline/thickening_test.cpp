#include "pipeline/thickening.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sculpt {
namespace {

// Three materials share 100 cells; growing one takes from the others. Volumes follow the values with a bend.
ThickeningTrial shares(const std::vector<Thickening>& lines, const std::vector<double>& start) {
  ThickeningTrial t{start, {20, 30, 25}};
  for (const Thickening& l : lines) {
    const auto m = static_cast<std::size_t>(l.material);
    const double gain = t.area[m] * (0.8 * l.value + 0.6 * l.value * l.value);
    t.volume[m] += gain;
    t.volume[(m + 1) % 3] -= 0.7 * gain;
    t.volume[(m + 2) % 3] -= 0.3 * gain;
  }
  return t;
}

TEST(FindThickening, ReachesTheVolumesOfSeveralMaterials) {
  std::vector<Thickening> lines{{0, 0, true}, {2, 0, true}};
  const std::vector<double> target{16, 54, 30};
  int runs = 0;
  std::vector<Thickening> last;
  const ThickeningResult r = find_thickening(lines, target, [&](const std::vector<Thickening>& trial) {
    ++runs;
    last = trial;
    return shares(trial, {10, 63, 27});
  });
  const ThickeningTrial reached = shares(lines, {10, 63, 27});
  EXPECT_NEAR(reached.volume[0], 16, 0.16);
  EXPECT_NEAR(reached.volume[2], 30, 0.30);
  EXPECT_LE(r.error, 0.01);
  EXPECT_LE(runs, 8);
  EXPECT_EQ(last[0].value, lines[0].value) << "the last run is the one that counts";
  EXPECT_EQ(last[1].value, lines[1].value);
}

TEST(FindThickening, LeavesGivenValuesAlone) {
  std::vector<Thickening> lines{{1, 0.25, false}, {0, 0, true}};
  find_thickening(lines, {14, 50, 36}, [&](const std::vector<Thickening>& t) {
    return shares(t, {10, 50, 40});
  });
  EXPECT_EQ(lines[0].value, 0.25);
  EXPECT_GT(lines[1].value, 0);
}

TEST(FindThickening, CannotShrinkAMaterial) {
  std::vector<Thickening> lines{{0, 0, true}};
  const ThickeningResult r = find_thickening(lines, {8, 52, 40}, [&](const std::vector<Thickening>& t) {
    return shares(t, {10, 50, 40});
  });
  EXPECT_EQ(lines[0].value, 0);
  EXPECT_NEAR(r.error, 0.25, 1e-12) << "what is left is told";
}

TEST(FindThickening, StaysInRangeWhenTheVolumeIsOutOfReach) {
  std::vector<Thickening> lines{{0, 0, true}};
  const ThickeningResult r = find_thickening(lines, {99, 1, 0}, [&](const std::vector<Thickening>& t) {
    return shares(t, {10, 50, 40});
  });
  EXPECT_LE(lines[0].value, 1);
  EXPECT_GT(r.error, 0.5);
}

}  // namespace
}  // namespace sculpt
