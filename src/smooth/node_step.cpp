#include "smooth/node_step.hpp"

#include <algorithm>
#include <cmath>

namespace sculpt {
namespace {

constexpr double kStepOfEdge = 0.5;  // longest step, of the shortest edge at the node
constexpr double kStepFloor =
    0.2;  // an edge counts at least this long there, in cells, so that collapsed ones open

// Solves H d = -g for a symmetric H (xx xy xz yy yz zz); false when H is not safely positive definite.
bool descend(const double (&h)[6], const Vec3& g, Vec3& d) {
  if (!(h[0] > 0)) return false;
  const double l00 = std::sqrt(h[0]), l10 = h[1] / l00, l20 = h[2] / l00;
  const double b = h[3] - l10 * l10;
  if (!(b > 1e-14 * std::fabs(h[3]))) return false;
  const double l11 = std::sqrt(b), l21 = (h[4] - l20 * l10) / l11;
  const double c = h[5] - l20 * l20 - l21 * l21;
  if (!(c > 1e-14 * std::fabs(h[5]))) return false;
  const double l22 = std::sqrt(c);
  const double u = -g.x / l00, v = (-g.y - l10 * u) / l11, w = (-g.z - l20 * u - l21 * v) / l22;
  d.z = w / l22;
  d.y = (v - l21 * d.z) / l11;
  d.x = (u - l10 * d.y - l20 * d.z) / l00;
  return true;
}

// Newton direction; a multiple of the identity is added until the Hessian is positive definite.
bool newton_direction(const double (&hessian)[6], const Vec3& g, Vec3& d) {
  const double trace = hessian[0] + hessian[3] + hessian[5];
  double add = 0;
  for (int attempt = 0; attempt < 14; ++attempt) {
    const double h[6] = {hessian[0] + add, hessian[1], hessian[2],
                         hessian[3] + add, hessian[4], hessian[5] + add};
    if (descend(h, g, d)) return std::isfinite(dot(d, d));
    add = attempt == 0 ? 1e-3 * std::fabs(trace) + 1e-30 : 10 * add;
  }
  return false;
}

// Takes the directions in which the node cannot move out of the problem.
void restrict_to(const Freedom& free, double (&h)[6], Vec3& g) {
  const double trace = h[0] + h[3] + h[5];
  if (free.dimensions < 3) {
    g = free.along(g);
    std::array<Vec3, 3> rows{Vec3{h[0], h[1], h[2]}, Vec3{h[1], h[3], h[4]}, Vec3{h[2], h[4], h[5]}};
    for (Vec3& row : rows) row = free.along(row);
    const std::array<Vec3, 3> columns{free.along({rows[0].x, rows[1].x, rows[2].x}),
                                      free.along({rows[0].y, rows[1].y, rows[2].y}),
                                      free.along({rows[0].z, rows[1].z, rows[2].z})};
    constexpr std::size_t kEntry[6][2] = {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}};
    for (std::size_t e = 0; e < 6; ++e) {
      const auto [i, j] = kEntry[e];
      Vec3 axis;
      axis[i] = 1;
      h[e] = columns[j][i] + trace * (axis - free.along(axis))[j];
    }
    return;
  }
  constexpr int kDiagonal[3] = {0, 3, 5};
  constexpr int kOff[3][2] = {{1, 2}, {1, 4}, {2, 4}};
  for (std::size_t d = 0; d < 3; ++d) {
    if (!(free.fixed_axes & kAxisSides[d])) continue;
    g[d] = 0;
    h[kOff[d][0]] = h[kOff[d][1]] = 0;
    h[kDiagonal[d]] = trace;
  }
}

double quadratic(const std::array<double, 6>& w, const Vec3& d) {
  return w[0] * d.x * d.x + w[3] * d.y * d.y + w[5] * d.z * d.z +
         2 * (w[1] * d.x * d.y + w[2] * d.x * d.z + w[4] * d.y * d.z);
}

}  // namespace

Vec3 Geometry::onto(LocalId entry, const Vec3& p) const {
  const Vec3& to = target[at(entry)];
  if (origin[at(entry)] != kNone) return contour(origin[at(entry)], to, p);
  if (!surface.empty() && surface[at(entry)] != kNone) return on_surface(surface[at(entry)], p);
  const auto& w = weight[at(entry)];
  const Vec3 d = p - to;
  const Vec3 held = {(w[0] - kSliding) * d.x + w[1] * d.y + w[2] * d.z,
                     w[1] * d.x + (w[3] - kSliding) * d.y + w[4] * d.z,
                     w[2] * d.x + w[4] * d.y + (w[5] - kSliding) * d.z};
  return p - (1 / (1 - kSliding)) * held;
}

Vec3 NodeStep::deviation(LocalId entry, LocalId node) const {
  return scaled(mesh_.position[at(node)] - geometry_.target[at(entry)], scale_at(node));
}

double NodeStep::price(LocalId node, const StepRules& rules) const {
  double price = rules.penalty * star_.tets();
  if (geometry_.on_curve[at(geometry_.index[at(node)])]) {
    if (rules.release_curves_below < 0)
      price *= 10;
    else if (star_.shape({}).scaled_jacobian < rules.release_curves_below)
      price *= 0.1;
  }
  return price;
}

Vec3 NodeStep::towards_geometry(LocalId node, const Vec3& from) const {
  return held(mesh_, node, from, geometry_.onto(geometry_.index[at(node)], from) - from);
}

// A node that is beyond the limit already may come nearer.
bool NodeStep::too_far(LocalId node, const Vec3& step, double farthest) const {
  const Vec3& here = mesh_.position[at(node)];
  const Vec3 scale = scale_at(node);
  Vec3 there = here;
  for (std::size_t d = 0; d < 3; ++d) there[d] += step[d] / scale[d];
  const double distance = norm(towards_geometry(node, there));
  return distance > limit(node, farthest) && distance >= norm(towards_geometry(node, here));
}

Vec3 NodeStep::landed(LocalId node, const Freedom& free, const Vec3& step, const Vec3& scale) const {
  if (free.dimensions == 3) return step;
  const Vec3 per_scale{1 / scale.x, 1 / scale.y, 1 / scale.z};
  return scaled(held(mesh_, node, mesh_.position[at(node)], scaled(step, per_scale)), scale);
}

bool NodeStep::fit(LocalId node, const StepRules& rules) {
  const Vec3 scale = scale_at(node);
  star_.gather(mesh_.hexes, mesh_.position, around_[node], node, scale, Star::Target::kPresent);
  const Star::Shape now = star_.shape({});
  Vec3& p = mesh_.position[at(node)];
  Vec3 move = towards_geometry(node, p);
  for (int halving = 0; halving < 4; ++halving, move = 0.5 * move) {
    move = held(mesh_, node, p, move);
    const Star::Shape there = star_.shape(scaled(move, scale));
    if (there.scaled_jacobian < std::min(now.scaled_jacobian, rules.least_quality) ||
        there.edge < std::min(now.edge, rules.least_edge))
      continue;
    p += move;
    return true;
  }
  return false;
}

bool NodeStep::pull_back(LocalId node, double farthest) {
  constexpr int kTries = 40, kCareful = 5;  // the point of the geometry moves with the node
  constexpr double kInside = 0.98;
  if (geometry_.index[at(node)] == kNone) return false;
  Vec3& p = mesh_.position[at(node)];
  const double most = limit(node, farthest);
  bool moved = false;
  for (int i = 0; i < kTries; ++i) {
    const Vec3 back = towards_geometry(node, p);
    const double distance = norm(back);
    if (!(distance > most)) break;
    p += i < kCareful ? held(mesh_, node, p, (1 - kInside * most / distance) * back) : back;
    moved = true;
  }
  return moved;
}

bool NodeStep::newton(LocalId node, const StepRules& rules) {
  const Vec3 scale = scale_at(node);
  star_.gather(mesh_.hexes, mesh_.position, around_[node], node, scale, rules.target_lengths);
  Derivatives at0 = star_.derivatives(rules.power, rules.eps);
  const LocalId entry = geometry_.index[at(node)];
  const double price_of = entry == kNone ? 0 : price(node, rules);
  Vec3 off;
  if (entry != kNone) {
    const auto& w = geometry_.weight[at(entry)];
    off = deviation(entry, node);
    at0.gradient +=
        2 * price_of *
        Vec3{w[0] * off.x + w[1] * off.y + w[2] * off.z, w[1] * off.x + w[3] * off.y + w[4] * off.z,
             w[2] * off.x + w[4] * off.y + w[5] * off.z};
    for (std::size_t i = 0; i < 6; ++i) at0.hessian[i] += 2 * price_of * w[i];
    at0.energy += price_of * quadratic(w, off);
  }
  const Freedom free = freedom(mesh_, node, mesh_.position[at(node)]);
  if (free.dimensions == 0) return false;
  restrict_to(free, at0.hessian, at0.gradient);
  Vec3 step;
  if (!newton_direction(at0.hessian, at0.gradient, step)) return false;
  step = free.along(step);
  const double longest = kStepOfEdge * std::max(star_.shortest_edge(), kStepFloor), length = norm(step);
  if (length > longest) step = (longest / length) * step;
  if (!(std::min(length, longest) >= rules.least_move)) return false;

  const bool limited = entry != kNone && std::isfinite(rules.farthest);
  Star::Shape floor{-2, 0};
  if (rules.guarded) {
    const Star::Shape now = star_.shape({});
    floor = {std::min(now.scaled_jacobian, rules.least_quality), std::min(now.edge, rules.least_edge)};
  }
  const Vec3 towards = step;
  for (int halving = 0; halving < 6; ++halving) {
    step = landed(node, free, std::ldexp(1.0, -halving) * towards, scale);
    const Star::Value there = star_.value(step, rules.power, rules.eps);
    const double energy = entry == kNone
                              ? there.energy
                              : there.energy + price_of * quadratic(geometry_.weight[at(entry)], off + step);
    if (!(energy < at0.energy) || there.not_positive > at0.not_positive) continue;
    if (limited && too_far(node, step, rules.farthest)) continue;
    if (rules.guarded) {
      const Star::Shape shape = star_.shape(step);
      if (shape.scaled_jacobian < floor.scaled_jacobian || shape.edge < floor.edge) continue;
    }
    Vec3& p = mesh_.position[at(node)];
    for (std::size_t d = 0; d < 3; ++d)
      if (step[d] != 0) p[d] += step[d] / scale[d];
    return true;
  }
  return false;
}

bool NodeStep::climb(LocalId node, const StepRules& rules) {
  constexpr double kDifference = 1e-5, kBand = 0.02;
  constexpr int kMost = 10;
  bool any = false;
  Vec3& p = mesh_.position[at(node)];
  const Vec3 scale = scale_at(node);
  const bool limited = geometry_.index[at(node)] != kNone && std::isfinite(rules.farthest);
  for (int round = 0; round < 5; ++round) {
    const Freedom free = freedom(mesh_, node, p);
    if (free.dimensions == 0) return false;
    star_.gather(mesh_.hexes, mesh_.position, around_[node], node, scale, Star::Target::kPresent);
    const Star::Shape now = star_.shape({});
    // Gradients of the corners near the worst one: differences of the exact corner values.
    std::vector<std::pair<double, Vec3>> corners;
    for (const std::int32_t item : around_[node]) {
      HexCorners hex = mesh_.corners(item / 8);
      for (Vec3& corner : hex) corner = scaled(corner - p, scale);
      const auto moving = static_cast<std::size_t>(item % 8);
      std::array<int, 4> near{item % 8, kCornerNeighbours[moving][0], kCornerNeighbours[moving][1],
                              kCornerNeighbours[moving][2]};
      for (const int c : near) {
        const double here = corner_scaled_jacobian(hex, c);
        if (here > now.scaled_jacobian + kBand) continue;
        Vec3 gradient;
        for (std::size_t d = 0; d < 3; ++d) {
          HexCorners moved = hex;
          moved[moving][d] += kDifference;
          const double ahead = corner_scaled_jacobian(moved, c);
          moved[moving][d] -= 2 * kDifference;
          gradient[d] = (ahead - corner_scaled_jacobian(moved, c)) / (2 * kDifference);
        }
        corners.emplace_back(here, free.along(gradient));
      }
    }
    std::stable_sort(corners.begin(), corners.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    if (corners.size() > kMost) corners.resize(kMost);
    // The shortest vector in the hull of the gradients raises all of them (Frank-Wolfe).
    Vec3 up = corners.front().second;
    for (int i = 0; i < 40; ++i) {
      const auto least = std::min_element(corners.begin(), corners.end(), [&](const auto& a, const auto& b) {
        return dot(up, a.second) < dot(up, b.second);
      });
      const Vec3 towards = least->second - up;
      const double square = dot(towards, towards), share = square > 1e-20 ? -dot(up, towards) / square : 0;
      if (share <= 1e-6) break;
      up += std::min(share, 1.0) * towards;
    }
    if (norm(up) < 1e-4) break;
    const Vec3 upwards = (0.25 * now.edge) * unit(up);
    bool raised = false;
    for (int halving = 0; halving < 7 && !raised; ++halving) {
      const Vec3 step = landed(node, free, std::ldexp(1.0, -halving) * upwards, scale);
      const Star::Shape there = star_.shape(step);
      if (there.scaled_jacobian <= now.scaled_jacobian + 1e-4 ||
          there.edge < std::min(now.edge, rules.least_edge))
        continue;
      if (limited && too_far(node, step, rules.farthest)) continue;
      for (std::size_t d = 0; d < 3; ++d)
        if (step[d] != 0) p[d] += step[d] / scale[d];
      raised = any = true;
    }
    if (!raised) break;
  }
  return any;
}

}  // namespace sculpt
