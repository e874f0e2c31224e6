#include <algorithm>
#include <cmath>

#include "geom/line_pieces.hpp"
#include "sculpt/geom/solids.hpp"

namespace sculpt {
namespace {

// Takes a piece out of those of the line that begin at `first`.
void take(const Interval& piece, std::size_t first, std::vector<Interval>& pieces) {
  if (!(piece.lo < piece.hi)) return;
  const std::size_t before = pieces.size();
  for (std::size_t i = first; i < before; ++i) {
    const Interval old = pieces[i];
    if (old.hi <= piece.lo || piece.hi <= old.lo) continue;
    pieces[i].hi = std::max(old.lo, piece.lo);
    if (piece.hi < old.hi) pieces.push_back({piece.hi, old.hi});
  }
}

class Difference final : public Shape {
 public:
  Difference(std::unique_ptr<Shape> from, std::vector<std::shared_ptr<const Shape>> removed)
      : from_(std::move(from)), removed_(std::move(removed)) {
    const Box box = bounds();
    margin_ = 1e-9 * largest(box.hi - box.lo);
  }

  [[nodiscard]] Box bounds() const override { return from_->bounds(); }

  [[nodiscard]] bool contains(const Box& box) const override {
    return from_->contains(box) && std::all_of(removed_.begin(), removed_.end(),
                                               [&](const auto& shape) { return shape->misses(box); });
  }

  [[nodiscard]] bool misses(const Box& box) const override {
    return from_->misses(box) || std::any_of(removed_.begin(), removed_.end(),
                                             [&](const auto& shape) { return shape->contains(box); });
  }

  [[nodiscard]] bool is_gentle(const Box& box) const override {
    const std::vector<const Shape*> reaching = surfaces_in(box);
    return reaching.empty() || (reaching.size() == 1 && reaching[0]->is_gentle(box));
  }

  [[nodiscard]] bool has_edges(const Box& box) const override {
    const std::vector<const Shape*> reaching = surfaces_in(box);
    return reaching.size() > 1 || (reaching.size() == 1 && reaching[0]->has_edges(box));
  }

  // That of the nearest surface.
  [[nodiscard]] std::size_t steepest_axis(const Vec3& point) const override {
    return nearest_surface(point).shape->steepest_axis(point);
  }

  void chords(std::size_t axis, double u, std::span<const double> v, ChordRow& row) const override {
    cut(
        v.size(), [&](const Shape& shape, ChordRow& own) { shape.chords(axis, u, v, own); }, row);
  }

  void line_chords(std::span<const Vec3> from, std::span<const Vec3> step, ChordRow& row) const override {
    cut(
        from.size(), [&](const Shape& shape, ChordRow& own) { shape.line_chords(from, step, own); }, row);
  }

  // Nothing where the nearest surface of all is one that the others hide.
  [[nodiscard]] std::optional<Vec3> nearest_on_surface(const Vec3& p) const override {
    const Surface nearest = nearest_surface(p);
    if (!nearest.point || is_hidden(*nearest.point, nearest.shape)) return std::nullopt;
    return nearest.point;
  }

 private:
  struct Surface {
    const Shape* shape;
    std::optional<Vec3> point;
  };

  // That of `from` when no shape knows.
  [[nodiscard]] Surface nearest_surface(const Vec3& p) const {
    Surface best{from_.get(), from_->nearest_on_surface(p)};
    for (const auto& shape : removed_) {
      const std::optional<Vec3> q = shape->nearest_on_surface(p);
      if (q && (!best.point || norm(*q - p) < norm(*best.point - p))) best = {shape.get(), q};
    }
    return best;
  }

  // q on the surface of one of the shapes lies, or nearly so, in what the others leave out.
  [[nodiscard]] bool is_hidden(const Vec3& q, const Shape* of) const {
    const Vec3 margin{margin_, margin_, margin_};
    const Box box{q - margin, q + margin};
    if (of != from_.get() && !from_->contains(box)) return true;
    return std::any_of(removed_.begin(), removed_.end(),
                       [&](const auto& shape) { return shape.get() != of && !shape->misses(box); });
  }

  // The shapes whose surface may reach the box, unless the box misses this solid.
  [[nodiscard]] std::vector<const Shape*> surfaces_in(const Box& box) const {
    std::vector<const Shape*> found;
    if (misses(box)) return found;
    if (!from_->contains(box)) found.push_back(from_.get());
    for (const auto& shape : removed_)
      if (!shape->misses(box)) found.push_back(shape.get());
    return found;
  }

  template <class ChordsOf>
  void cut(std::size_t lines, const ChordsOf& chords_of, ChordRow& row) const {
    std::vector<ChordRow> own(removed_.size() + 1);
    for (std::size_t s = 0; s < own.size(); ++s) {
      own[s].begin(lines);
      chords_of(s == 0 ? *from_ : *removed_[s - 1], own[s]);
    }
    LinePieces left(lines);
    for (std::size_t l = 0; l < lines; ++l) {
      for (std::size_t k = 0; k < own[0].layers(); ++k)
        if (own[0].lo(k)[l] < own[0].hi(k)[l]) left.pieces().push_back({own[0].lo(k)[l], own[0].hi(k)[l]});
      for (std::size_t s = 1; s < own.size(); ++s)
        for (std::size_t k = 0; k < own[s].layers(); ++k)
          take({own[s].lo(k)[l], own[s].hi(k)[l]}, left.line_begin(), left.pieces());
      left.end_line();
    }
    left.append_to(row);
  }

  std::unique_ptr<Shape> from_;
  std::vector<std::shared_ptr<const Shape>> removed_;
  double margin_ = 0;  // length: nearer than this counts as touching
};

}  // namespace

std::unique_ptr<Shape> difference(std::unique_ptr<Shape> from,
                                  std::vector<std::shared_ptr<const Shape>> removed) {
  return std::make_unique<Difference>(std::move(from), std::move(removed));
}

}  // namespace sculpt
