#pragma once
// The flat torus: a rectangle whose opposite sides are joined (the periodic boundary of the paper's figure
// 3).

#include <cmath>

#include "geom/check.h"
#include "geom/vec.h"

namespace geom {

/// Periods and coordinate grid. Sample coordinates are multiples of grid() = 2^-50 U in [0, period), U the
/// least power of two that no period exceeds. Sums and differences of grid points below 8 U are therefore
/// exact doubles: a site and its periodic copies have exact coordinates.
class FlatTorus {
 public:
  static constexpr double least_period = 1e-15, largest_period = 1e15, largest_aspect = 256;

  /// Periods are rounded to the grid. Throws InputError outside [least_period, largest_period] or if one
  /// exceeds the other largest_aspect times.
  explicit FlatTorus(const Vec2& period) {
    const double low = period.minCoeff(), high = period.maxCoeff();
    require(low >= least_period && high <= largest_period,  // false for NaN
            "a period must be a number between 1e-15 and 1e15");
    require(high <= largest_aspect * low, "one period must not exceed the other more than 256 times");
    unit_ = std::exp2(std::ceil(std::log2(high)));
    if (unit_ < high) unit_ *= 2;
    grid_ = unit_ * 0x1p-50;
    per_unit_ = 1 / grid_;
    period_ = {std::round(period.x() / grid_) * grid_, std::round(period.y() / grid_) * grid_};
    half_ = period_ / 2;
  }

  const Vec2& period() const { return period_; }
  double unit() const { return unit_; }
  double grid() const { return grid_; }
  double area() const { return period_.x() * period_.y(); }

  /// The shortest among the periodic copies of a coordinate difference. |d| < 3/2 period. Exact on the grid.
  double shortest_x(double d) const { return shortest(d, period_.x(), half_.x()); }
  double shortest_y(double d) const { return shortest(d, period_.y(), half_.y()); }
  Vec2 shortest(const Vec2& d) const { return {shortest_x(d.x()), shortest_y(d.y())}; }

  /// A coordinate in (-period, 2 period) brought to [0, period]; `period` itself only by rounding.
  double wrap_x(double x) const { return wrap(x, period_.x()); }
  double wrap_y(double y) const { return wrap(y, period_.y()); }

  /// Is a coordinate difference shorter than half a period, so that shortest() can recover it?
  bool is_short(double dx, double dy) const { return std::abs(dx) < half_.x() && std::abs(dy) < half_.y(); }

  /// The nearest grid point of the torus to any finite location.
  Vec2 snap(const Vec2& x) const { return {snap(x.x(), period_.x()), snap(x.y(), period_.y())}; }

 private:
  static double shortest(double d, double period, double half) {
    if (d > half) return d - period;
    if (d < -half) return d + period;
    return d;
  }
  static double wrap(double x, double period) {
    if (x < 0) return x + period;
    if (x >= period) return x - period;
    return x;
  }
  double snap(double x, double period) const {
    if (!(x >= 0 && x < period)) x -= std::floor(x / period) * period;
    x = std::round(x * per_unit_) * grid_;
    return x >= 0 && x < period ? x : 0.0;
  }

  Vec2 period_, half_;
  double unit_, grid_, per_unit_;  ///< grid points per unit of length
};

}  // namespace geom
