#pragma once
// Eight doubles side by side, and vectors of them. Every operation works lane by lane and the lanes are
// combined in a fixed order, so that the result does not depend on the instruction set. The kernels are
// compiled for several instruction sets; lanes make the result the same in all of them.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && defined(__GNUC__) && !defined(__clang__)
#define SCULPT_KERNEL __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define SCULPT_KERNEL
#endif
#define SCULPT_INLINE inline __attribute__((always_inline))
#pragma GCC diagnostic ignored "-Wpsabi"  // everything is inlined, so it does not matter how lanes are passed

namespace sculpt {

using Lanes = double __attribute__((vector_size(64), aligned(64)));

SCULPT_INLINE Lanes splat(double x) { return Lanes{x, x, x, x, x, x, x, x}; }
SCULPT_INLINE Lanes largest(const Lanes& a, const Lanes& b) { return a > b ? a : b; }
SCULPT_INLINE Lanes smallest(const Lanes& a, const Lanes& b) { return a < b ? a : b; }
SCULPT_INLINE Lanes root(const Lanes& a) {
  Lanes r;
  for (int l = 0; l < 8; ++l) r[l] = __builtin_sqrt(a[l]);
  return r;
}
SCULPT_INLINE double sum(const Lanes& a) {
  return ((a[0] + a[1]) + (a[2] + a[3])) + ((a[4] + a[5]) + (a[6] + a[7]));
}
SCULPT_INLINE double least(const Lanes& a) {
  double m = a[0];
  for (int l = 1; l < 8; ++l) m = a[l] < m ? a[l] : m;
  return m;
}

struct Vec3Lanes {
  Lanes x, y, z;
};
SCULPT_INLINE Vec3Lanes operator-(const Vec3Lanes& a, const Vec3Lanes& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
SCULPT_INLINE Vec3Lanes operator+(const Vec3Lanes& a, const Vec3Lanes& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
SCULPT_INLINE Lanes dot(const Vec3Lanes& a, const Vec3Lanes& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
SCULPT_INLINE Vec3Lanes cross(const Vec3Lanes& a, const Vec3Lanes& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace sculpt
