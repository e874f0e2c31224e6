#pragma once
// Points on circles, with the same bits on every machine: libraries differ in the last digits of sin and cos.
namespace hexmesh {

struct Direction {
  double cos, sin;
};
// At a part of a full turn, from 0 to 1, counted from the x axis towards y.
[[nodiscard]] Direction direction(double turn);

}  // namespace hexmesh
