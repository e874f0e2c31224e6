#pragma once
// The volume fractions of shapes in one box or hex at a time.
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "input/inserted_shape.hpp"
#include "sculpt/geom/trilinear.hpp"
#include "sculpt/input/material_source.hpp"

namespace sculpt {

// Measures by lines along the axis in which the surface is steepest: exact along the line, midpoint rule
// across, extrapolated where surfaces are gentle. Of balls with a radius of 0.6 edges of the box or more the
// shares are within 1e-3 of the box, mostly 1e-4; within 3e-3 where several meet. Where shapes
// have edges the box is halved in all directions, again and again, until the parts are measured so: within
// 1e-3 of the box. A hex is measured in the
// same way along lines on which one of its parameters varies.
class CellMeter {
 public:
  CellMeter(std::span<const InsertedShape> shapes, std::int32_t outside)
      : shapes_(shapes), outside_(outside) {}

  // Appends the fractions of a cell to the list. `candidates`: shapes that may reach it, in the order of
  // insertion; those that do not change nothing.
  void measure(const Box& cell, std::span<const std::int32_t> candidates, Fractions& fractions);
  void measure(const HexCorners& hex, std::span<const std::int32_t> candidates, Fractions& fractions);
  // The material that fills the cell; nothing when only a measurement could tell.
  [[nodiscard]] std::optional<std::int32_t> sole_material(const Box& cell,
                                                          std::span<const std::int32_t> candidates);

 private:
  static constexpr std::size_t kMostLines = 32;  // per direction across a cell
  using Row = std::array<double, kMostLines>;
  struct Piece {
    double from, to;
  };
  struct BoxLines {
    const Box& cell;
    std::size_t axis;
  };
  struct Lines {
    std::size_t first, last;  // half open
  };
  // What a shape cuts from the lines of one row. It has no chords beyond its rows and columns.
  struct Chords {
    Lines rows, columns;
    ChordRow row;  // the present one
    Row length;    // by column: what the shape has got so far
  };
  struct Share {
    std::int32_t material;
    double value;
  };

  [[nodiscard]] const Shape& shape(std::size_t s) const { return *local_[s]; }
  [[nodiscard]] std::int32_t material(std::size_t s) const { return shapes_[reaching_[s]].material; }
  void select(const Box& bounds, std::span<const std::int32_t> candidates);
  template <class Cell>
  void measure_cell(const Cell& cell, std::span<const std::int32_t> candidates, Fractions& fractions);
  template <class Cell>
  void add_shares(const Cell& part, std::size_t depth, double weight);
  template <class Cell>
  void add_eighths(const Cell& part, std::size_t depth, double weight);
  [[nodiscard]] std::optional<std::int32_t> sole_selected() const;
  template <class Steepest>
  [[nodiscard]] bool is_gentle(const Box& bounds, const Steepest& steepest) const;
  template <class Steepest>
  [[nodiscard]] bool is_rough(const Box& bounds, const Steepest& steepest) const;
  [[nodiscard]] static BoxLines lines_of(const Box& cell, std::size_t axis);
  [[nodiscard]] static HexLines lines_of(const HexCorners& hex, std::size_t axis);
  void sample(const BoxLines& box, std::size_t lines, double weight);
  void sample(const HexLines& hex, std::size_t lines, double weight);
  void add_hex_row(const HexLines& hex, double u, std::size_t lines, double& volume);
  [[nodiscard]] static Lines lines_between(const Box& cell, std::size_t axis, std::size_t lines,
                                           const Box& bounds);
  void add_row(double from, double to, std::size_t lines);
  static void add_pieces(const ChordRow& row, const Piece& piece, Row& sum);
  static void add_common(const ChordRow& a, const ChordRow& b, double sign, const Piece& piece, Row& sum);
  void share_line(const Piece& whole, std::size_t column);
  [[nodiscard]] double take(const Piece& chord);
  [[nodiscard]] std::optional<double> share_of_one(const Box& cell) const;
  [[nodiscard]] static std::optional<double> share_of_one(const HexCorners& hex);
  void look_into(const Box& bounds);
  void append(Fractions& fractions);

  std::span<const InsertedShape> shapes_;
  std::int32_t outside_;
  std::vector<std::size_t> reaching_;  // positions in shapes_
  std::vector<const Shape*> local_;    // the same as they are within the cell
  std::vector<std::unique_ptr<Shape>> storage_;
  bool filled_ = false;              // the last of them fills the cell
  std::vector<double> covered_;      // per reaching shape: its share of the cell
  std::vector<Chords> chords_;       // per reaching shape
  std::vector<std::size_t> in_row_;  // the reaching shapes that may meet the present row
  std::vector<Piece> left_, next_;
  std::array<HexLines::Line, kMostLines> line_;  // the present row of a hex
  std::array<Vec3, kMostLines> from_, step_;
  std::vector<Share> shares_;
};

}  // namespace sculpt
