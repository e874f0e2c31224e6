#pragma once
// Finds thickening values that bring materials to given volumes.
#include <cstdint>
#include <functional>
#include <vector>

namespace sculpt {

// One line of thicken_material.
struct Thickening {
  std::int32_t material;  // dense index
  double value;
  bool automatic;
};

// What follows from a set of lines, per material: volume in cells, and interface area in faces of cells.
struct ThickeningTrial {
  std::vector<double> volume, area;
};

struct ThickeningResult {
  int trials = 0;
  double error = 0;  // largest relative error of volume of a material with an automatic line
};

// Sets the values of the automatic lines such that the volumes of their materials come as close to `target`
// as they can; values stay in 0 to 1, so a material that is too large already keeps 0. Every trial changes
// all values at once: by the volume missing over the area at first, by the secant of the last two trials
// then. Calls run(lines) a few times, last for the lines it settles on. Collective when run is; all ranks
// must get the same answers from it.
ThickeningResult find_thickening(std::vector<Thickening>& lines, const std::vector<double>& target,
                                 const std::function<ThickeningTrial(const std::vector<Thickening>&)>& run);

}  // namespace sculpt
