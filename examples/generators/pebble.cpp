#include "pebble.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "random.hpp"

namespace microstructure {
namespace {

using Point = std::array<double, 3>;

constexpr double kHollow = 0.5;  // radius
constexpr int kBumps = 40;
constexpr double kSteepness = 0.8;  // cosine of the angle from a bump's top to its foot

Point towards(const Point& p) {
  const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
  return {p[0] / length, p[1] / length, p[2] / length};
}
Point half_way(const Point& a, const Point& b) { return towards({a[0] + b[0], a[1] + b[1], a[2] + b[2]}); }

class Pebble {
 public:
  explicit Pebble(std::uint64_t seed) {
    Random random(seed);
    while (tops_.size() < kBumps) {
      Point p{};
      for (double& x : p) x = static_cast<double>(random.between(-1000, 1000));
      if (p[0] * p[0] + p[1] * p[1] + p[2] * p[2] > 1) tops_.push_back(towards(p));
    }
  }
  [[nodiscard]] double radius(const Point& way) const {
    double radius = 1;
    for (const Point& top : tops_) {
      const double over = way[0] * top[0] + way[1] * top[1] + way[2] * top[2] - kSteepness;
      if (over > 0) radius += 3 * over * over;
    }
    return radius;
  }

 private:
  std::vector<Point> tops_;
};

class StlWriter {
 public:
  explicit StlWriter(const std::string& path) : path_(path), file_(path, std::ios::binary) {}

  void header(std::uint32_t triangles) {
    std::array<char, 80> text{};
    std::strncpy(text.data(), "pebble", text.size() - 1);
    file_.write(text.data(), text.size());
    put(triangles);
  }
  void triangle(const Point& a, const Point& b, const Point& c) {
    for (int d = 0; d < 3; ++d) put(0.0F);  // readers find the normal by the order of the corners
    for (const Point* p : {&a, &b, &c})
      for (const double x : *p) put(static_cast<float>(x));
    put(std::uint16_t{0});
  }
  void close() {
    file_.close();
    if (!file_) throw std::runtime_error("cannot write " + path_);
  }

 private:
  template <class T>
  void put(const T& value) {
    file_.write(reinterpret_cast<const char*>(&value), sizeof value);
  }
  std::string path_;
  std::ofstream file_;
};

// The triangles of a ball: those of an octahedron, each cut in four `level` times.
template <class Visit>
void divide(const Point& a, const Point& b, const Point& c, std::int64_t level, const Visit& visit) {
  if (level == 0) {
    visit(a, b, c);
    return;
  }
  const Point ab = half_way(a, b), bc = half_way(b, c), ca = half_way(c, a);
  divide(a, ab, ca, level - 1, visit);
  divide(ab, b, bc, level - 1, visit);
  divide(ca, bc, c, level - 1, visit);
  divide(ab, bc, ca, level - 1, visit);
}

}  // namespace

void write_pebble(const std::string& path, const PebbleOptions& options) {
  const Pebble pebble(options.seed);
  StlWriter stl(path);
  stl.header(16U << (2 * options.level));
  for (int octant = 0; octant < 8; ++octant) {
    const double x = octant & 1 ? -1 : 1, y = octant & 2 ? -1 : 1, z = octant & 4 ? -1 : 1;
    const Point px{x, 0, 0}, py{0, y, 0}, pz{0, 0, z};
    const bool outwards = x * y * z > 0;
    divide(px, outwards ? py : pz, outwards ? pz : py, options.level,
           [&](const Point& a, const Point& b, const Point& c) {
             const auto at = [](const Point& way, double r) {
               return Point{r * way[0], r * way[1], r * way[2]};
             };
             stl.triangle(at(a, pebble.radius(a)), at(b, pebble.radius(b)), at(c, pebble.radius(c)));
             stl.triangle(at(a, kHollow), at(c, kHollow), at(b, kHollow));
           });
  }
  stl.close();
}

}  // namespace microstructure
