#pragma once
// The shapes of diatom files: one table of their names and keywords (docs/shapes.md), and how they become
// solids.
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "input/diatom_words.hpp"
#include "input/placement.hpp"

namespace sculpt {

enum class ParameterKind : int {
  kPoint,         // x y z
  kDirection,     // x y z, not all zero
  kLength,        // > 0
  kLengthOrZero,  // >= 0
  kRadii,         // three lengths > 0
  kPair,          // two coordinates within a plane
  kPlane,         // a point and a direction
  kFile,          // a name
  kRotation,      // degrees, a direction and perhaps a point
  kTranslation,   // x y z
  kScale,         // > 0
};

enum class ParameterNeed { kOnce, kPerhaps, kRepeated };

struct ShapeParameter {
  KeywordNames names;
  ParameterKind kind;
  ParameterNeed need = ParameterNeed::kOnce;
};

// What a file gives a shape: numbers per parameter of its kind, none where it is not given.
using ShapeValues = std::vector<std::vector<double>>;

struct ShapeKind {
  KeywordNames names;
  std::vector<ShapeParameter> parameters;
  std::unique_ptr<Shape> (*make)(const ShapeValues&) = nullptr;  // null: an STL file
  bool along_axes = false;                                       // its numbers cannot say that it is turned
};

[[nodiscard]] std::span<const ShapeKind> shape_kinds();
// How any shape may be placed; these may be repeated.
[[nodiscard]] std::span<const ShapeParameter> placing_parameters();

[[nodiscard]] bool takes(ParameterKind kind, std::size_t count);
// "3 numbers (x y z)", for messages.
[[nodiscard]] std::string_view expected_numbers(ParameterKind kind);
// Throws Error, which says what was found and what is expected, when these, as many as the kind takes, are no
// values of it.
void check_numbers(ParameterKind kind, std::string_view name, std::span<const double> numbers);
// What the checked numbers of a placing parameter do.
[[nodiscard]] Placement placement_of(ParameterKind kind, std::span<const double> numbers);

// Throws Error when it scales or moves beyond what numbers can hold.
void check_placement(const Placement& placement);

// The solid of checked values, placed; not for STL files. Throws Error when it is none.
[[nodiscard]] std::unique_ptr<Shape> make_solid(const ShapeKind& kind, ShapeValues values,
                                                const Placement& placement);

}  // namespace sculpt
