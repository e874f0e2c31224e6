#include <algorithm>
#include <cmath>

#include "geom/line_pieces.hpp"
#include "geom/sheet_share.hpp"
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
  // The first one without the others.
  explicit Difference(std::vector<std::shared_ptr<const Shape>> shapes) : held_(std::move(shapes)) {
    for (const auto& shape : held_) shapes_.push_back(shape.get());
    const Box box = bounds();
    margin_ = 1e-9 * largest(box.hi - box.lo);
  }

  [[nodiscard]] Box bounds() const override { return from().bounds(); }

  [[nodiscard]] bool contains(const Box& box) const override {
    return from().contains(box) &&
           std::all_of(removed().begin(), removed().end(), [&](const Shape* s) { return s->misses(box); });
  }

  [[nodiscard]] bool misses(const Box& box) const override {
    return from().misses(box) ||
           std::any_of(removed().begin(), removed().end(), [&](const Shape* s) { return s->contains(box); });
  }

  [[nodiscard]] bool is_gentle(const Box& box) const override {
    const std::vector<const Shape*> reaching = surfaces_in(box);
    return reaching.empty() || (reaching.size() == 1 && reaching[0]->is_gentle(box));
  }

  [[nodiscard]] bool is_costly() const override { return true; }
  [[nodiscard]] std::optional<double> share_of(const Box& box) const override {
    return has_edges(box) ? std::nullopt : sheet_share(*this, box);
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

  void line_chords(std::span<const Vec3> starts, std::span<const Vec3> steps, ChordRow& row) const override {
    cut(
        starts.size(), [&](const Shape& shape, ChordRow& own) { shape.line_chords(starts, steps, own); },
        row);
  }

  // Nothing where the nearest surface of all is one that the others hide.
  [[nodiscard]] std::optional<Vec3> nearest_on_surface(const Vec3& p) const override {
    const Surface nearest = nearest_surface(p);
    if (!nearest.point || is_hidden(*nearest.point, nearest.shape)) return std::nullopt;
    return nearest.point;
  }

  [[nodiscard]] const Shape& within(const Box& box, std::unique_ptr<Shape>& storage) const override {
    auto* part = dynamic_cast<Difference*>(storage.get());
    if (part == nullptr) {
      std::unique_ptr<Difference> made(new Difference);
      part = made.get();
      storage = std::move(made);
    }
    part->storage_.resize(shapes_.size());
    part->shapes_.clear();
    for (std::size_t s = 0; s < shapes_.size(); ++s)
      part->shapes_.push_back(&shapes_[s]->within(box, part->storage_[s]));
    part->margin_ = margin_;
    return *part;
  }

 private:
  struct Surface {
    const Shape* shape;
    std::optional<Vec3> point;
  };

  Difference() = default;

  [[nodiscard]] const Shape& from() const { return *shapes_[0]; }
  [[nodiscard]] std::span<const Shape* const> removed() const { return std::span(shapes_).subspan(1); }

  // That of the first shape when none knows.
  [[nodiscard]] Surface nearest_surface(const Vec3& p) const {
    Surface best{&from(), std::nullopt};
    for (const Shape* const shape : shapes_) {
      const std::optional<Vec3> q = shape->nearest_on_surface(p);
      if (q && (!best.point || norm(*q - p) < norm(*best.point - p))) best = {shape, q};
    }
    return best;
  }

  // q on the surface of one of the shapes lies, or nearly so, in what the others leave out.
  [[nodiscard]] bool is_hidden(const Vec3& q, const Shape* of) const {
    const Vec3 margin{margin_, margin_, margin_};
    const Box box{q - margin, q + margin};
    if (of != &from() && !from().contains(box)) return true;
    return std::any_of(removed().begin(), removed().end(),
                       [&](const Shape* s) { return s != of && !s->misses(box); });
  }

  // The shapes whose surface may reach the box, unless the box misses this solid.
  [[nodiscard]] std::vector<const Shape*> surfaces_in(const Box& box) const {
    std::vector<const Shape*> found;
    if (misses(box)) return found;
    if (!from().contains(box)) found.push_back(&from());
    for (const Shape* const shape : removed())
      if (!shape->misses(box)) found.push_back(shape);
    return found;
  }

  template <class ChordsOf>
  void cut(std::size_t lines, const ChordsOf& chords_of, ChordRow& row) const {
    std::vector<ChordRow> own(shapes_.size());
    for (std::size_t s = 0; s < own.size(); ++s) {
      own[s].begin(lines);
      chords_of(*shapes_[s], own[s]);
    }
    LinePieces left;
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

  std::vector<std::shared_ptr<const Shape>> held_;
  std::vector<std::unique_ptr<Shape>> storage_;  // of the result of within()
  std::vector<const Shape*> shapes_;
  double margin_ = 0;  // length: nearer than this counts as touching
};

}  // namespace

std::unique_ptr<Shape> difference(std::unique_ptr<Shape> from,
                                  std::vector<std::shared_ptr<const Shape>> removed) {
  removed.insert(removed.begin(), std::move(from));
  return std::make_unique<Difference>(std::move(removed));
}

}  // namespace sculpt
