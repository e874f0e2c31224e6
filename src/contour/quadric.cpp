#include "sculpt/contour/quadric.hpp"

#include <algorithm>
#include <cmath>

namespace sculpt {
namespace {

constexpr std::size_t kTerms = 5;
constexpr double kLeastPivot = 1e-8;  // of the largest diagonal entry
constexpr double kRidge = 1e-3;       // added to the quadratic block where the points do not decide it
constexpr double kTiny = 1e-300;

using Row = std::array<double, kTerms>;
struct NormalEquations {
  std::array<Row, kTerms> matrix{};
  Row right{};
};

// Cholesky; false when a pivot is too small.
bool solve(NormalEquations e, Row& x) {
  double most = 0;
  for (std::size_t i = 0; i < kTerms; ++i) most = std::max(most, e.matrix[i][i]);
  auto& m = e.matrix;
  for (std::size_t i = 0; i < kTerms; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (std::size_t k = 0; k < j; ++k) m[i][j] -= m[i][k] * m[j][k];
      m[i][j] /= m[j][j];
    }
    for (std::size_t k = 0; k < i; ++k) m[i][i] -= m[i][k] * m[i][k];
    if (!(m[i][i] > kLeastPivot * most)) return false;
    m[i][i] = std::sqrt(m[i][i]);
  }
  for (std::size_t i = 0; i < kTerms; ++i) {
    x[i] = e.right[i];
    for (std::size_t k = 0; k < i; ++k) x[i] -= m[i][k] * x[k];
    x[i] /= m[i][i];
  }
  for (std::size_t i = kTerms; i-- > 0;) {
    for (std::size_t k = i + 1; k < kTerms; ++k) x[i] -= m[k][i] * x[k];
    x[i] /= m[i][i];
  }
  return true;
}

// Two unit vectors across the normal; the first from the axis least aligned with it (ties: the lowest).
void tangents(Quadric& q) {
  std::size_t axis = 0;
  for (std::size_t d = 1; d < 3; ++d)
    if (std::fabs(q.normal[d]) < std::fabs(q.normal[axis])) axis = d;
  Vec3 e;
  e[axis] = 1;
  q.t1 = unit(e - dot(e, q.normal) * q.normal);
  q.t2 = cross(q.normal, q.t1);
}

}  // namespace

Quadric fit_quadric(const Vec3& p, const Vec3& normal, std::span<const Vec3> around) {
  Quadric q;
  q.origin = p;
  q.normal = normal;
  tangents(q);
  for (const Vec3& x : around) q.reach += norm(x - p) / static_cast<double>(around.size());
  if (!(q.reach > 0)) return q;
  NormalEquations e;
  for (const Vec3& point : around) {
    const Vec3 off = (1 / q.reach) * (point - p);
    const double u = dot(off, q.t1), v = dot(off, q.t2), height = dot(off, normal);
    const double weight = 1 / std::max(norm(off), kTiny);
    const Row terms{u, v, u * u, u * v, v * v};
    for (std::size_t i = 0; i < kTerms; ++i) {
      for (std::size_t j = 0; j < kTerms; ++j) e.matrix[i][j] += weight * terms[i] * terms[j];
      e.right[i] += weight * terms[i] * height;
    }
  }
  Row a{};
  bool solved = around.size() >= kTerms && solve(e, a);
  if (!solved) {
    for (std::size_t i = 2; i < kTerms; ++i) e.matrix[i][i] += kRidge;
    solved = solve(e, a);
  }
  if (!solved) return q;
  q.a = {a[0], a[1], a[2] / q.reach, a[3] / q.reach, a[4] / q.reach};
  return q;
}

Vec3 onto_quadric(const Quadric& q, const Vec3& p) {
  double u = dot(p - q.origin, q.t1), v = dot(p - q.origin, q.t2);
  const double far = std::sqrt(u * u + v * v);
  if (far > q.reach) {
    u *= q.reach / far;
    v *= q.reach / far;
  }
  const double height = q.a[0] * u + q.a[1] * v + q.a[2] * u * u + q.a[3] * u * v + q.a[4] * v * v;
  return q.origin + u * q.t1 + v * q.t2 + std::clamp(height, -0.5 * q.reach, 0.5 * q.reach) * q.normal;
}

}  // namespace sculpt
