#include "smooth/active_set.hpp"

#include <algorithm>

namespace sculpt {
namespace {

std::size_t at(LocalId id) { return static_cast<std::size_t>(id); }

}  // namespace

ActiveSet::ActiveSet(HexMesh& mesh)
    : mesh_(mesh), around_(mesh), quality_(mesh.hexes.size()), marked_(mesh.position.size(), 0),
      changed_(mesh.position.size(), 0), near_(mesh.position.size(), 0), far_moved_(mesh.position.size(), 0),
      chosen_(static_cast<std::size_t>(mesh.colours)), dirty_(mesh.hexes.size(), 0) {
  refresh_all_quality();
}

void ActiveSet::refresh_all_quality() {
  for (LocalId h = 0; h < mesh_.size(); ++h) quality_[at(h)] = static_cast<float>(scaled_jacobian(mesh_.corners(h)));
}

void ActiveSet::mark(LocalId node, std::vector<LocalId>& front) {
  if (marked_[at(node)]) return;
  marked_[at(node)] = 1;
  changed_[at(node)] = owned(node);
  front.push_back(node);
}

std::int64_t ActiveSet::choose(double quality, int layers, bool only_near) {
  std::fill(marked_.begin(), marked_.end(), std::uint8_t{0});
  std::vector<LocalId> front, next;
  for (LocalId h = 0; h < mesh_.size(); ++h)
    if (static_cast<double>(quality_[at(h)]) < quality)
      for (const LocalId n : mesh_.hexes[at(h)]) mark(n, front);
  for (int layer = 0; layer < layers; ++layer) {
    // A ghost may lie in a bad hex that only its owner sees.
    mesh_.node_exchange.copy_changed(std::span<std::uint8_t>(marked_), std::span<std::uint8_t>(changed_),
                                     [&](LocalId ghost) { front.push_back(ghost); });
    next.clear();
    for (const LocalId n : front)
      for (const std::int32_t item : around_[n])
        for (const LocalId other : mesh_.hexes[at(item / 8)]) mark(other, next);
    front.swap(next);
  }
  std::fill(changed_.begin(), changed_.end(), std::uint8_t{0});
  std::int64_t count = 0;
  for (auto& list : chosen_) list.clear();
  for (LocalId n = 0; n < mesh_.nodes(); ++n)
    if (marked_[at(n)] && owned(n) && (!only_near || near_[at(n)])) {
      chosen_[mesh_.colour[at(n)]].push_back(n);
      ++count;
    }
  return comm().sum(count);
}

std::int64_t ActiveSet::sweep(const std::function<bool(LocalId)>& step, double far) {
  std::int64_t moves = 0;
  moved_.clear();
  for (std::size_t colour = 0; colour < chosen_.size(); ++colour) {
    for (const LocalId n : chosen_[colour]) {
      const Vec3 before = mesh_.position[at(n)];
      if (!step(n)) continue;
      ++moves;
      moved_.push_back(n);
      changed_[at(n)] = 1;
      const Vec3 move = mesh_.position[at(n)] - before;
      far_moved_[at(n)] = dot(move, move) > far * far;
    }
    exchange_moves(far * far, static_cast<int>(colour));
  }
  std::fill(near_.begin(), near_.end(), std::uint8_t{0});
  for (const LocalId n : moved_) {
    changed_[at(n)] = 0;
    if (!far_moved_[at(n)]) continue;
    far_moved_[at(n)] = 0;
    for (const std::int32_t item : around_[n])
      for (const LocalId other : mesh_.hexes[at(item / 8)]) near_[at(other)] = 1;
  }
  refresh_quality();
  return comm().sum(moves);
}

void ActiveSet::exchange_moves(double far_squared, int colour) {
  using G = GhostExchange;
  mesh_.node_exchange.send_records(
      [&](LocalId n, std::vector<char>& bytes) {
        if (!changed_[at(n)] || mesh_.colour[at(n)] != colour) return;
        G::append(bytes, mesh_.position[at(n)]);
      },
      [&](LocalId ghost, const char* from) {
        const Vec3 before = mesh_.position[at(ghost)];
        G::take(from, mesh_.position[at(ghost)]);
        const Vec3 move = mesh_.position[at(ghost)] - before;
        far_moved_[at(ghost)] = dot(move, move) > far_squared;
        moved_.push_back(ghost);
        return from;
      });
}

void ActiveSet::refresh_quality() {
  std::vector<LocalId> hexes;
  for (const LocalId n : moved_)
    for (const std::int32_t item : around_[n])
      if (!dirty_[at(item / 8)]) {
        dirty_[at(item / 8)] = 1;
        hexes.push_back(item / 8);
      }
  for (const LocalId h : hexes) {
    dirty_[at(h)] = 0;
    quality_[at(h)] = static_cast<float>(scaled_jacobian(mesh_.corners(h)));
  }
}

ActiveSet::Worst ActiveSet::worst(double target) const {
  Worst w;
  for (std::size_t h = 0; h < quality_.size(); ++h) {
    if (mesh_.layer[h] != 0) continue;
    const double q = static_cast<double>(quality_[h]);
    w.not_positive += q <= 0;
    w.below_02 += q < 0.2;
    w.below_target += q < target;
    w.quality = std::min(w.quality, q);
  }
  std::array<std::int64_t, 3> counts{w.not_positive, w.below_02, w.below_target};
  comm().sum(counts);
  return {counts[0], counts[1], counts[2], comm().min(w.quality)};
}

double ActiveSet::least_determinant(const Vec3& scale) const {
  double least = 1;
  for (LocalId h = 0; h < mesh_.size(); ++h) {
    if (mesh_.layer[at(h)] != 0 || quality_[at(h)] >= 0.1F) continue;
    HexCorners p = mesh_.corners(h);
    for (Vec3& corner : p) corner = scaled(corner, scale);
    for (int c = 0; c < 8; ++c) least = std::min(least, corner_determinant(p, c));
  }
  return comm().min(least);
}

}  // namespace sculpt
