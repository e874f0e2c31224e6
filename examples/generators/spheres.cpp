#include "spheres.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "random.hpp"
#include "voxels.hpp"

namespace microstructure {
namespace {

constexpr std::int64_t kTries = 100000;  // places looked at for one ball

struct Sphere {
  std::int64_t x, y, z, radius;
};

bool overlap(const Sphere& a, const Sphere& b) {
  const std::int64_t dx = a.x - b.x, dy = a.y - b.y, dz = a.z - b.z, reach = a.radius + b.radius;
  return dx * dx + dy * dy + dz * dz < reach * reach;
}

// The radius of equal balls that fill 0.3 of the box: 14 count r^3 = box^3.
std::int64_t mean_radius(const SphereOptions& o) {
  std::int64_t r = 0;
  while (14 * o.count * (r + 1) * (r + 1) * (r + 1) <= o.box * o.box * o.box) ++r;
  return r;
}

}  // namespace

void write_spheres(const std::string& path, const SphereOptions& o) {
  const std::int64_t mean = mean_radius(o);
  if (mean < 5) throw std::runtime_error("the box is too small for so many spheres");
  Random random(o.seed);
  std::vector<std::int64_t> radii;
  for (std::int64_t s = 0; s < o.count; ++s) radii.push_back(random.between(3 * mean / 5, 6 * mean / 5));
  std::sort(radii.rbegin(), radii.rend());  // large ones find room first
  std::vector<Sphere> spheres;
  for (const std::int64_t radius : radii)
    for (std::int64_t tries = 1;; ++tries) {
      if (tries > kTries) throw std::runtime_error("no room for so many spheres");
      const Sphere s{random.between(0, o.box), random.between(0, o.box), random.between(0, o.box), radius};
      if (std::any_of(spheres.begin(), spheres.end(),
                      [&s](const Sphere& other) { return overlap(s, other); }))
        continue;
      spheres.push_back(s);
      break;
    }
  std::string text = "diatom\npackage 'spheres'\nmaterial 1\n";
  for (const Sphere& s : spheres)
    text += "insert sphere\ncenter = " + std::to_string(s.x) + " " + std::to_string(s.y) + " " +
            std::to_string(s.z) + "\nradius = " + std::to_string(s.radius) + "\nendinsert\n";
  write_text(path, text + "endpackage\nenddiatom\n");
}

}  // namespace microstructure
