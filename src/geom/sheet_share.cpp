#include "geom/sheet_share.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace sculpt {
namespace {

constexpr std::size_t kNodes = 4, kTests = 2;  // per direction
constexpr double kMostOff = 2e-4;              // of the box: an interpolated height against a true one
constexpr double kFar = 2;  // boxes: heights farther from that in the middle are other sheets

using Weights = std::array<double, kNodes>;

// Of the polynomial through the nodes 0, 1/3 .. 1, at t.
constexpr Weights weights_at(double t) {
  Weights w{};
  for (std::size_t k = 0; k < kNodes; ++k) {
    w[k] = 1;
    for (std::size_t m = 0; m < kNodes; ++m)
      if (m != k)
        w[k] *=
            (t * (kNodes - 1) - static_cast<double>(m)) / (static_cast<double>(k) - static_cast<double>(m));
  }
  return w;
}

// At the middles of equal parts.
template <std::size_t kLines>
constexpr std::array<Weights, kLines> kMiddles = [] {
  std::array<Weights, kLines> all{};
  for (std::size_t l = 0; l < kLines; ++l) all[l] = weights_at((static_cast<double>(l) + 0.5) / kLines);
  return all;
}();

class Sheet {
 public:
  Sheet(const Shape& shape, const Box& box)
      : shape_(shape), box_(box), axis_(shape.steepest_axis(0.5 * (box.lo + box.hi))) {}

  // Whether the sheet could be found.
  bool find() {
    constexpr double kMiddle = 0.5;
    row_at(kMiddle, std::array{kMiddle});
    if (!choose_side()) return false;
    for (std::size_t i = 0; i < kNodes; ++i) {
      row_at(node(i), nodes());
      for (std::size_t j = 0; j < kNodes; ++j)
        if (!height(j, heights_[i][j])) return false;
    }
    constexpr std::array<double, kTests> kBetween{1.0 / 6, 5.0 / 6};
    for (const double u : kBetween) {
      row_at(u, kBetween);
      for (std::size_t j = 0; j < kTests; ++j) {
        double there = 0;
        if (!height(j, there)) return false;
        if (std::fabs(there - at(weights_at(u), weights_at(kBetween[j]))) > kMostOff * length()) return false;
      }
    }
    return true;
  }

  // The midpoint rule across, with the error that falls with the square of the number of lines cancelled.
  [[nodiscard]] double share() const {
    return std::clamp(4.0 / 3 * mean<16>() - 1.0 / 3 * mean<8>(), 0.0, 1.0);
  }

 private:
  [[nodiscard]] double length() const { return box_.hi[axis_] - box_.lo[axis_]; }
  static double node(std::size_t i) { return static_cast<double>(i) / (kNodes - 1); }
  static std::array<double, kNodes> nodes() {
    std::array<double, kNodes> all{};
    for (std::size_t i = 0; i < kNodes; ++i) all[i] = node(i);
    return all;
  }

  // Cuts the lines at u and v, which are shares of the box.
  template <std::size_t kLines>
  void row_at(double u, const std::array<double, kLines>& v) {
    const std::size_t axis_u = (axis_ + 1) % 3, axis_v = (axis_ + 2) % 3;
    std::array<double, kLines> place;
    for (std::size_t l = 0; l < kLines; ++l)
      place[l] = box_.lo[axis_v] + v[l] * (box_.hi[axis_v] - box_.lo[axis_v]);
    row_.begin(kLines);
    shape_.chords(axis_, box_.lo[axis_u] + u * (box_.hi[axis_u] - box_.lo[axis_u]), place, row_);
  }

  // The end that is nearest to the middle of the box, on the line there, belongs to the sheet.
  bool choose_side() {
    const double middle = 0.5 * (box_.lo[axis_] + box_.hi[axis_]);
    double least = kFar * length();
    bool found = false;
    for (std::size_t k = 0; k < row_.layers(); ++k) {
      const double lo = row_.lo(k)[0], hi = row_.hi(k)[0];
      if (!(lo < hi)) continue;
      for (const bool ends : {false, true}) {
        const double end = ends ? hi : lo;
        if (!(std::fabs(end - middle) < least)) continue;
        least = std::fabs(end - middle);
        first_ = end;
        ends_ = ends;
        found = true;
      }
    }
    return found;
  }
  // The height of the sheet on a line of the row; false also where another sheet passes the box there.
  bool height(std::size_t line, double& h) const {
    double least = kFar * length();
    bool found = false;
    int within = 0;
    for (std::size_t k = 0; k < row_.layers(); ++k) {
      const double lo = row_.lo(k)[line], hi = row_.hi(k)[line];
      if (!(lo < hi)) continue;
      within += is_within(lo) + is_within(hi);
      const double end = ends_ ? hi : lo;
      if (!(std::fabs(end - first_) < least)) continue;
      least = std::fabs(end - first_);
      h = end;
      found = true;
    }
    return found && within == is_within(h);
  }
  [[nodiscard]] int is_within(double height) const {
    return box_.lo[axis_] < height && height < box_.hi[axis_] ? 1 : 0;
  }

  [[nodiscard]] double at(const Weights& u, const Weights& v) const {
    double sum = 0;
    for (std::size_t i = 0; i < kNodes; ++i)
      for (std::size_t j = 0; j < kNodes; ++j) sum += u[i] * v[j] * heights_[i][j];
    return sum;
  }

  // Of the shares of lines in the middles of equal parts.
  template <std::size_t kLines>
  [[nodiscard]] double mean() const {
    double sum = 0;
    for (const Weights& u : kMiddles<kLines>) {
      Weights across{};
      for (std::size_t i = 0; i < kNodes; ++i)
        for (std::size_t j = 0; j < kNodes; ++j) across[j] += u[i] * heights_[i][j];
      for (const Weights& v : kMiddles<kLines>) {
        double h = 0;
        for (std::size_t j = 0; j < kNodes; ++j) h += v[j] * across[j];
        sum += std::clamp(ends_ ? h - box_.lo[axis_] : box_.hi[axis_] - h, 0.0, length());
      }
    }
    return sum / (static_cast<double>(kLines * kLines) * length());
  }

  const Shape& shape_;
  const Box& box_;
  std::size_t axis_;
  ChordRow row_;
  bool ends_ = false;  // the solid is below the sheet
  double first_ = 0;   // height in the middle
  std::array<Weights, kNodes> heights_{};
};

}  // namespace

std::optional<double> sheet_share(const Shape& shape, const Box& box) {
  Sheet sheet(shape, box);
  return sheet.find() ? std::optional(sheet.share()) : std::nullopt;
}

}  // namespace sculpt
