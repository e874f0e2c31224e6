#pragma once
// The volume fractions of shapes in one box or hex at a time, by sample points (vfrac_method = points).
#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "input/inserted_shape.hpp"
#include "sculpt/geom/hex.hpp"
#include "sculpt/input/material_source.hpp"

namespace sculpt {

// Asks of the midpoints of 5 x 5 x 5 equal parts which shape, the first one, has them (the report, section
// 2.3). Of a hex the parts are equal in its parameters.
class PointMeter {
 public:
  PointMeter(std::span<const InsertedShape> shapes, std::int32_t outside)
      : shapes_(shapes), outside_(outside) {}

  // Appends the fractions of a cell to the list. `candidates`: shapes that may reach it, in the order of
  // insertion.
  void measure(const Box& cell, std::span<const std::int32_t> candidates, Fractions& fractions);
  void measure(const HexCorners& hex, std::span<const std::int32_t> candidates, Fractions& fractions);

 private:
  static constexpr std::size_t kPerAxis = 5;
  static constexpr int kPoints = 125;
  using Row = std::array<double, kPerAxis>;

  template <class Chords>
  void sample(const Box& bounds, std::span<const std::int32_t> candidates, const Row& along,
              const Chords& chords);
  void take(std::size_t plane, const Row& along, std::int32_t material);
  void append(Fractions& fractions);

  std::span<const InsertedShape> shapes_;
  std::int32_t outside_;
  std::array<std::int32_t, kPoints> material_{};  // of each point; kNone: of none yet
  ChordRow row_;
  std::unique_ptr<Shape> storage_;
};

}  // namespace sculpt
