#include "fpo/spectrum/differential_histogram.h"

#include <array>
#include <cmath>
#include <numbers>

#include "geom/check.h"
#include "geom/parallel.h"

namespace fpo {

using geom::Vec2;

namespace {

/// Grid points a period of the highest frequency.
constexpr double oversampling = 8;
constexpr double largest_grid = 4096;

/// The cubic B-spline at the four grid points around a place that is `t` in [0, 1) behind the second.
std::array<double, 4> spline(double t) {
  const double u = 1 - t;
  return {u * u * u / 6, (4 - 6 * t * t + 3 * t * t * t) / 6, (4 - 6 * u * u + 3 * u * u * u) / 6,
          t * t * t / 6};
}

/// The transform of the cubic B-spline on grid points `cell` apart.
double spline_transform(double f, double cell) {
  const double x = std::numbers::pi * f * cell;
  const double sinc = x == 0 ? 1 : std::sin(x) / x;
  return sinc * sinc * sinc * sinc;
}

/// cos and sin of 2 pi f x, divided by the spline's transform.
struct Waves {
  Eigen::MatrixXd cosine, sine;  ///< a row a grid point, a column a frequency 0, step, 2 step, ...
  Waves(int size, int center, double cell, double step, int half)
      : cosine(size, half + 1), sine(size, half + 1) {
    for (int k = 0; k <= half; ++k) {
      const double gain = 1 / spline_transform(k * step, cell);
      for (int g = 0; g < size; ++g) {
        const double phase = 2 * std::numbers::pi * k * step * (g - center) * cell;
        cosine(g, k) = gain * std::cos(phase);
        sine(g, k) = gain * std::sin(phase);
      }
    }
  }
};

}  // namespace

DifferentialHistogram::DifferentialHistogram(double reach, double max_frequency)
    : reach_(reach), max_frequency_(max_frequency), cell_(1 / (oversampling * max_frequency)) {
  geom::require(reach > 0 && max_frequency > 0 && 2 * reach / cell_ < largest_grid,
                "the spectrum's radius times its largest frequency is too large");
  center_ = static_cast<int>(std::ceil(reach / cell_)) + 2;
  size_ = 2 * center_ + 1;
  mass_.assign(static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_), 0.0);
}

void DifferentialHistogram::add(const Vec2& d, double weight) {
  geom::ensure(std::abs(d.x()) <= reach_ && std::abs(d.y()) <= reach_, "differential beyond its histogram");
  const double x = d.x() / cell_ + center_, y = d.y() / cell_ + center_;
  const double column = std::floor(x), row = std::floor(y);
  const std::array<double, 4> along_x = spline(x - column), along_y = spline(y - row);
  double* at =
      mass_.data() + (static_cast<std::ptrdiff_t>(row) - 1) * size_ + static_cast<std::ptrdiff_t>(column) - 1;
  for (int b = 0; b < 4; ++b, at += size_) {
    const double share = weight * along_y[static_cast<std::size_t>(b)];
    for (int a = 0; a < 4; ++a) at[a] += share * along_x[static_cast<std::size_t>(a)];
  }
}

void DifferentialHistogram::merge(const DifferentialHistogram& other) {
  geom::ensure(size_ == other.size_ && cell_ == other.cell_, "histograms of different shapes");
  for (std::size_t i = 0; i < mass_.size(); ++i) mass_[i] += other.mass_[i];
}

std::vector<double> DifferentialHistogram::transform(double step, int half, int threads) const {
  geom::ensure(half >= 0 && half * step <= max_frequency_ * (1 + 1e-9), "frequency beyond the histogram's");
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<const RowMajor> mass(mass_.data(), size_, size_);
  const Waves waves(size_, center_, cell_, step, half);
  // sum m cos(a + b) = sum m (cos a cos b - sin a sin b), with a the phase along x and b that along y.
  const std::size_t side = 2 * static_cast<std::size_t>(half) + 1;
  std::vector<double> result(side * side);
  geom::parallel_ranges(
      static_cast<std::size_t>(half) + 1, 16, threads, [&](std::size_t first, std::size_t last) {
        const auto from = static_cast<Eigen::Index>(first), count = static_cast<Eigen::Index>(last - first);
        const Eigen::MatrixXd even = waves.cosine.transpose() * (mass * waves.cosine.middleCols(from, count));
        const Eigen::MatrixXd odd = waves.sine.transpose() * (mass * waves.sine.middleCols(from, count));
        for (Eigen::Index i = 0; i < count; ++i) {
          const int column = static_cast<int>(from + i);
          for (int j = 0; j <= half; ++j) {
            const auto put = [&](int x, int y, double value) {
              result[static_cast<std::size_t>(y + half) * side + static_cast<std::size_t>(x + half)] = value;
            };
            const double same = even(j, i) - odd(j, i), opposite = even(j, i) + odd(j, i);
            put(column, j, same);
            put(-column, -j, same);
            put(-column, j, opposite);
            put(column, -j, opposite);
          }
        }
      });
  return result;
}

}  // namespace fpo
