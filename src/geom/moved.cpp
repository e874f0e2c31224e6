#include <cmath>
#include <vector>

#include "geom/largest_axis.hpp"
#include "geom/sheet_share.hpp"
#include "sculpt/geom/solids.hpp"

namespace sculpt {
namespace {

class Moved final : public Shape {
 public:
  Moved(std::unique_ptr<Shape> shape, const Frame& frame)
      : owned_(std::move(shape)), shape_(owned_.get()), frame_(frame) {}

  // Moves it on: its frame becomes what `frame` makes of it.
  void move(const Frame& frame) {
    frame_.origin = frame.origin + turned_outward(frame, frame_.origin);
    for (Vec3& axis : frame_.axis) axis = turned_outward(frame, axis);
  }

  [[nodiscard]] Box bounds() const override {
    const Box box = shape_->bounds();
    const Vec3 half = 0.5 * (box.hi - box.lo), middle = outward(0.5 * (box.lo + box.hi));
    Vec3 reach;
    for (std::size_t d = 0; d < 3; ++d)
      for (std::size_t a = 0; a < 3; ++a) reach[d] += std::fabs(frame_.axis[a][d]) * half[a];
    return {middle - reach, middle + reach};
  }
  [[nodiscard]] bool contains(const Box& box) const override { return shape_->contains(around(box)); }
  [[nodiscard]] bool misses(const Box& box) const override { return shape_->misses(around(box)); }
  [[nodiscard]] bool is_gentle(const Box& box) const override { return shape_->is_gentle(ball_of(box)); }
  [[nodiscard]] bool has_edges(const Box& box) const override { return shape_->has_edges(ball_of(box)); }

  [[nodiscard]] bool is_costly() const override { return true; }
  [[nodiscard]] std::optional<double> share_of(const Box& box) const override {
    return has_edges(box) ? std::nullopt : sheet_share(*this, box);
  }

  [[nodiscard]] std::size_t steepest_axis(const Vec3& point) const override {
    const std::optional<Vec3> near = nearest_on_surface(point);
    Vec3 normal = near ? *near - point : Vec3{};
    const Box box = shape_->bounds();
    if (largest(normal) < 1e-9 * norm(box.hi - box.lo))
      normal = frame_.axis[shape_->steepest_axis(inward(point))];
    return largest_axis(normal);
  }

  void chords(std::size_t axis, double u, std::span<const double> v, ChordRow& row) const override {
    Vec3 step, from;
    step[axis] = 1;
    from[(axis + 1) % 3] = u;
    std::vector<Vec3> starts;
    starts.reserve(v.size());
    for (const double w : v) {
      from[(axis + 2) % 3] = w;
      starts.push_back(inward(from));
    }
    shape_->line_chords(starts, std::vector<Vec3>(v.size(), turned_inward(step)), row);
  }

  void line_chords(std::span<const Vec3> from, std::span<const Vec3> step, ChordRow& row) const override {
    std::vector<Vec3> starts, steps;
    starts.reserve(from.size());
    steps.reserve(step.size());
    for (const Vec3& p : from) starts.push_back(inward(p));
    for (const Vec3& s : step) steps.push_back(turned_inward(s));
    shape_->line_chords(starts, steps, row);
  }

  [[nodiscard]] std::optional<Vec3> nearest_on_surface(const Vec3& p) const override {
    const std::optional<Vec3> near = shape_->nearest_on_surface(inward(p));
    if (!near) return std::nullopt;
    return outward(*near);
  }

  [[nodiscard]] const Shape& within(const Box& box, std::unique_ptr<Shape>& storage) const override {
    auto* part = dynamic_cast<Moved*>(storage.get());
    if (part == nullptr) {
      auto made = std::make_unique<Moved>(nullptr, frame_);
      part = made.get();
      storage = std::move(made);
    }
    part->shape_ = &shape_->within(around(box), part->owned_);
    part->frame_ = frame_;
    return *part;
  }

 private:
  [[nodiscard]] Vec3 turned_inward(const Vec3& v) const {
    return {dot(v, frame_.axis[0]), dot(v, frame_.axis[1]), dot(v, frame_.axis[2])};
  }
  [[nodiscard]] Vec3 inward(const Vec3& p) const { return turned_inward(p - frame_.origin); }
  [[nodiscard]] Vec3 outward(const Vec3& p) const { return frame_.origin + turned_outward(frame_, p); }
  [[nodiscard]] static Vec3 turned_outward(const Frame& frame, const Vec3& v) {
    return v.x * frame.axis[0] + v.y * frame.axis[1] + v.z * frame.axis[2];
  }
  // The box of the shape that holds this one.
  [[nodiscard]] Box around(const Box& box) const {
    const Vec3 half = 0.5 * (box.hi - box.lo), middle = inward(0.5 * (box.lo + box.hi));
    Vec3 reach;
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t d = 0; d < 3; ++d) reach[a] += std::fabs(frame_.axis[a][d]) * half[d];
    return {middle - reach, middle + reach};
  }

  // A cube of the shape in the same ball, for questions that balls answer.
  [[nodiscard]] Box ball_of(const Box& box) const {
    const double half = 0.5 * norm(box.hi - box.lo) / std::sqrt(3.0);
    const Vec3 middle = inward(0.5 * (box.lo + box.hi));
    return {middle - Vec3{half, half, half}, middle + Vec3{half, half, half}};
  }

  std::unique_ptr<Shape> owned_;  // of the result of within(): storage
  const Shape* shape_;
  Frame frame_;
};

}  // namespace

std::unique_ptr<Shape> moved(std::unique_ptr<Shape> shape, const Frame& frame) {
  if (auto* const earlier = dynamic_cast<Moved*>(shape.get())) {
    earlier->move(frame);
    return shape;
  }
  return std::make_unique<Moved>(std::move(shape), frame);
}

}  // namespace sculpt
