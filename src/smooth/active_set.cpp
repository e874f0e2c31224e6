#include "smooth/active_set.hpp"

#include <algorithm>
#include <array>

#include "sculpt/geom/hex_quality.hpp"

namespace sculpt {
ActiveSet::ActiveSet(HexMesh& mesh)
    : mesh_(mesh),
      around_(mesh),
      quality_(mesh.hexes.size()),
      marked_(mesh.position.size(), 0),
      changed_(mesh.position.size(), 0),
      near_(mesh.position.size(), 0),
      far_moved_(mesh.position.size(), 0),
      chosen_(static_cast<std::size_t>(mesh.colours)),
      dirty_(mesh.hexes.size(), 0) {
  refresh_all_quality();
}

void ActiveSet::refresh_all_quality() {
  std::fill(dirty_.begin(), dirty_.end(), std::uint8_t{1});
  refresh_dirty(0, mesh_.size());
}

// In ascending order, which is the order of memory.
void ActiveSet::refresh_dirty(LocalId first, LocalId last) {
  std::array<LocalId, 8> batch;
  std::size_t count = 0;
  const auto measure = [&] {
    const HexQuality q = quality_of(mesh_.hexes, mesh_.position, {batch.data(), count});
    for (std::size_t i = 0; i < count; ++i) quality_[at(batch[i])] = static_cast<float>(q.scaled_jacobian[i]);
    count = 0;
  };
  for (LocalId h = first; h < last; ++h) {
    if (!dirty_[at(h)]) continue;
    dirty_[at(h)] = 0;
    batch[count++] = h;
    if (count == batch.size()) measure();
  }
  if (count > 0) measure();
}

void ActiveSet::spread(std::vector<std::uint8_t>& marks, std::vector<LocalId>& front) {
  const std::size_t before = front.size();
  const auto mark = [&](LocalId n) {
    if (marks[at(n)]) return;
    marks[at(n)] = 1;
    front.push_back(n);
  };
  if (before >
      mesh_.position.size() / 32) {  // one pass over all hexes is cheaper than a walk from node to node
    for (const LocalId n : front) marks[at(n)] = 2;
    for (const Hex& hex : mesh_.hexes) {
      bool touches = false;
      for (const LocalId n : hex) touches = touches || marks[at(n)] == 2;
      if (touches)
        for (const LocalId n : hex) mark(n);
    }
    for (std::size_t i = 0; i < before; ++i) marks[at(front[i])] = 1;
  } else {
    for (std::size_t i = 0; i < before; ++i)
      for (const std::int32_t item : around_[front[i]])
        for (const LocalId other : mesh_.hexes[at(item / 8)]) mark(other);
  }
  front.erase(front.begin(), front.begin() + static_cast<std::ptrdiff_t>(before));
}

std::int64_t ActiveSet::choose(double quality, int layers, bool only_near) {
  std::fill(marked_.begin(), marked_.end(), std::uint8_t{0});
  std::vector<LocalId> front;
  for (LocalId h = 0; h < mesh_.size(); ++h)
    if (static_cast<double>(quality_[at(h)]) < quality)
      for (const LocalId n : mesh_.hexes[at(h)])
        if (!marked_[at(n)]) {
          marked_[at(n)] = 1;
          front.push_back(n);
        }
  for (int layer = 0; layer < layers; ++layer) {
    // A ghost may lie in a bad hex that only its owner sees.
    for (const LocalId n : front) changed_[at(n)] = owned(n);
    mesh_.node_exchange.copy_changed(std::span<std::uint8_t>(marked_), std::span<std::uint8_t>(changed_),
                                     [&](LocalId ghost) { front.push_back(ghost); });
    for (const LocalId n : front) changed_[at(n)] = 0;
    spread(marked_, front);
  }
  std::int64_t count = 0;
  for (auto& list : chosen_) list.clear();
  for (LocalId n = 0; n < mesh_.nodes(); ++n)
    if (marked_[at(n)] && owned(n) && (!only_near || near_[at(n)])) {
      chosen_[mesh_.colour[at(n)]].push_back(n);
      ++count;
    }
  return comm().sum(count);
}

std::int64_t ActiveSet::choose_if(const std::function<bool(LocalId)>& wanted) {
  std::int64_t count = 0;
  for (auto& list : chosen_) list.clear();
  for (LocalId n = 0; n < mesh_.nodes(); ++n)
    if (owned(n) && wanted(n)) {
      chosen_[mesh_.colour[at(n)]].push_back(n);
      ++count;
    }
  return comm().sum(count);
}

std::vector<LocalId> ActiveSet::chosen() const {
  std::vector<LocalId> all;
  for (const auto& list : chosen_) all.insert(all.end(), list.begin(), list.end());
  std::sort(all.begin(), all.end());
  return all;
}

std::int64_t ActiveSet::sweep(const std::function<bool(LocalId)>& step, double far) {
  std::int64_t moves = 0;
  moved_.clear();
  for (std::size_t colour = 0; colour < chosen_.size(); ++colour) {
    const auto& nodes = chosen_[colour];
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const LocalId n = nodes[i];
      if (i + 2 < nodes.size()) fetch_ahead(nodes[i + 2], nodes[i + 1]);
      const Vec3 before = mesh_.position[at(n)];
      if (!step(n)) continue;
      round_to_quantum(mesh_, mesh_.position[at(n)]);
      ++moves;
      moved_.push_back(n);
      changed_[at(n)] = 1;
      const Vec3 move = mesh_.position[at(n)] - before;
      far_moved_[at(n)] = dot(move, move) > far * far;
    }
    exchange_moves(far * far, static_cast<int>(colour));
  }
  std::fill(near_.begin(), near_.end(), std::uint8_t{0});
  std::vector<LocalId> far_nodes;
  for (const LocalId n : moved_) {
    changed_[at(n)] = 0;
    if (!far_moved_[at(n)]) continue;
    far_moved_[at(n)] = 0;
    near_[at(n)] = 1;
    far_nodes.push_back(n);
  }
  spread(near_, far_nodes);
  refresh_quality_around(moved_);
  return comm().sum(moves);
}

// Starts loading what the visits after the next one will read: hexes first, their positions when those are
// there.
void ActiveSet::fetch_ahead(LocalId hexes_of, LocalId positions_of) const {
  for (const std::int32_t item : around_[hexes_of]) __builtin_prefetch(&mesh_.hexes[at(item / 8)]);
  for (const std::int32_t item : around_[positions_of])
    for (const LocalId n : mesh_.hexes[at(item / 8)]) __builtin_prefetch(&mesh_.position[at(n)]);
}

void ActiveSet::exchange_moves(double far_squared, int colour) {
  using G = GhostExchange;
  mesh_.node_exchange.send_records(
      [&](LocalId n, std::vector<char>& bytes) {
        if (!changed_[at(n)] || mesh_.colour[at(n)] != colour) return;
        G::append(bytes, mesh_.position[at(n)]);
      },
      [&](LocalId ghost, const char* from) {
        Vec3& p = mesh_.position[at(ghost)];
        const Vec3 before = p;
        G::take(from, p);
        p = position_of_ghost(mesh_, ghost, p);
        const Vec3 move = p - before;
        far_moved_[at(ghost)] = dot(move, move) > far_squared;
        moved_.push_back(ghost);
        return from;
      });
}

void ActiveSet::refresh_quality_around(const std::vector<LocalId>& moved) {
  LocalId first = mesh_.size(), last = 0;
  for (const LocalId n : moved)
    for (const std::int32_t item : around_[n]) {
      dirty_[at(item / 8)] = 1;
      first = std::min(first, item / 8);
      last = std::max(last, item / 8 + 1);
    }
  refresh_dirty(first, last);
}

std::int64_t ActiveSet::mark_folded() {
  std::int64_t count = 0;
  for (LocalId h = 0; h < mesh_.size(); ++h) {
    if (static_cast<double>(quality_[at(h)]) >= kNeverFolds || is_positive_inside(mesh_.corners(h))) continue;
    quality_[at(h)] = 0;
    count += mesh_.layer[at(h)] == 0;
  }
  return comm().sum(count);
}

std::int64_t ActiveSet::mark_short(double edge) {
  std::int64_t count = 0;
  std::array<LocalId, 8> batch;
  for (LocalId first = 0; first < mesh_.size(); first += 8) {
    const auto size = static_cast<std::size_t>(std::min<LocalId>(8, mesh_.size() - first));
    for (std::size_t i = 0; i < size; ++i) batch[i] = first + static_cast<LocalId>(i);
    const HexQuality q = quality_of(mesh_.hexes, mesh_.position, {batch.data(), size});
    for (std::size_t i = 0; i < size; ++i) {
      if (!(q.shortest_edge[i] < edge * mesh_.hex_unit(batch[i]))) continue;
      quality_[at(batch[i])] = 0;
      count += mesh_.layer[at(batch[i])] == 0;
    }
  }
  return comm().sum(count);
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
    const Vec3 in_cells = (1 / mesh_.hex_unit(h)) * scale;
    for (Vec3& corner : p) corner = scaled(corner, in_cells);
    for (int c = 0; c < 8; ++c) least = std::min(least, corner_determinant(p, c));
  }
  return comm().min(least);
}

}  // namespace sculpt
