#pragma once
// A point or direction in space. Plain doubles; every operation is written out so that its rounding is fixed.
#include <cmath>
#include <cstddef>

namespace sculpt {

struct Vec3 {
  double x = 0, y = 0, z = 0;

  double& operator[](std::size_t axis) { return (&x)[axis]; }
  double operator[](std::size_t axis) const { return (&x)[axis]; }
  bool operator==(const Vec3&) const = default;
  Vec3& operator+=(const Vec3& b) {
    x += b.x;
    y += b.y;
    z += b.z;
    return *this;
  }
};

inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
inline Vec3 operator*(double s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }
// The direction of a, or the zero vector when a has no direction.
inline Vec3 unit(const Vec3& a) {
  const double n = norm(a);
  return n > 1e-300 ? (1 / n) * a : Vec3{};
}
// Componentwise product: coordinates in another unit per axis.
inline Vec3 scaled(const Vec3& a, const Vec3& s) { return {a.x * s.x, a.y * s.y, a.z * s.z}; }
inline double largest(const Vec3& a) {
  return std::fmax(std::fabs(a.x), std::fmax(std::fabs(a.y), std::fabs(a.z)));
}

}  // namespace sculpt
