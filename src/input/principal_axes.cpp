#include "input/principal_axes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace sculpt {
namespace {

constexpr std::int64_t kPoints = 96;  // per axis
constexpr double kSame = 0.01;        // moments that differ by less, relative to the largest, are one

using Axes = std::array<Vec3, 3>;
constexpr Axes kCoordinateAxes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

// Second moments of the points inside about their centre; false when there are none.
bool moments(const Box& bounds, const std::function<bool(const Vec3&)>& inside, Eigen::Matrix3d& result) {
  // Whole numbers: twice the index of a point, plus one.
  std::int64_t count = 0;
  std::array<std::int64_t, 3> first{};
  std::array<std::array<std::int64_t, 3>, 3> second{};
  const Vec3 step = (0.5 / kPoints) * (bounds.hi - bounds.lo);
  for (std::int64_t k = 0; k < kPoints; ++k)
    for (std::int64_t j = 0; j < kPoints; ++j)
      for (std::int64_t i = 0; i < kPoints; ++i) {
        const std::array<std::int64_t, 3> at{2 * i + 1, 2 * j + 1, 2 * k + 1};
        const Vec3 off{static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])};
        if (!inside(bounds.lo + scaled(off, step))) continue;
        ++count;
        for (std::size_t d = 0; d < 3; ++d) {
          first[d] += at[d];
          for (std::size_t e = 0; e < 3; ++e) second[d][e] += at[d] * at[e];
        }
      }
  if (count == 0) return false;
  const auto n = static_cast<double>(count);
  for (std::size_t d = 0; d < 3; ++d)
    for (std::size_t e = 0; e < 3; ++e) {
      const double mean = static_cast<double>(second[d][e]) / n -
                          static_cast<double>(first[d]) / n * (static_cast<double>(first[e]) / n);
      result(static_cast<Eigen::Index>(d), static_cast<Eigen::Index>(e)) = mean * step[d] * step[e];
    }
  return true;
}

// The coordinate axes turned by the least rotation that takes the nearest of them to the direction.
Axes turned_to(const Vec3& direction) {
  std::size_t d = 0;
  for (std::size_t e = 1; e < 3; ++e)
    if (std::fabs(direction[e]) > std::fabs(direction[d])) d = e;
  const Vec3 to = direction[d] < 0 ? -direction : direction;
  const Vec3 from = kCoordinateAxes[d], across = cross(from, to);
  const double cosine = dot(from, to);
  Axes axes;
  for (std::size_t e = 0; e < 3; ++e) {  // Rodrigues' formula
    const Vec3& v = kCoordinateAxes[e];
    axes[e] = cosine * v + cross(across, v) + (dot(across, v) / (1 + cosine)) * across;
  }
  return axes;
}

// The order and signs of three directions that are nearest to the coordinate axes.
Axes in_order(const Axes& direction) {
  std::array<std::size_t, 3> order{0, 1, 2}, best = order;
  double most = -1;
  do {
    double sum = 0;
    for (std::size_t d = 0; d < 3; ++d) sum += std::fabs(direction[order[d]][d]);
    if (sum > most) {
      most = sum;
      best = order;
    }
  } while (std::next_permutation(order.begin(), order.end()));
  Axes axes;
  std::size_t least = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    axes[d] = direction[best[d]];
    if (axes[d][d] < 0) axes[d] = -axes[d];
    if (axes[d][d] < axes[least][least]) least = d;
  }
  if (dot(cross(axes[0], axes[1]), axes[2]) < 0) axes[least] = -axes[least];
  return axes;
}

}  // namespace

std::array<Vec3, 3> principal_axes(const Box& bounds, const std::function<bool(const Vec3&)>& inside) {
  Eigen::Matrix3d tensor;
  if (!moments(bounds, inside, tensor)) return kCoordinateAxes;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(tensor);
  const auto& value = solver.eigenvalues();  // ascending
  const auto direction = [&](Eigen::Index i) {
    const auto v = solver.eigenvectors().col(i);
    return unit({v(0), v(1), v(2)});
  };
  const double margin = kSame * value(2);
  const bool low = value(1) - value(0) < margin, high = value(2) - value(1) < margin;
  if (low && high) return kCoordinateAxes;
  if (low) return turned_to(direction(2));
  if (high) return turned_to(direction(0));
  return in_order({direction(0), direction(1), direction(2)});
}

}  // namespace sculpt
