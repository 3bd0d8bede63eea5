#include "fpo/spectrum/periodogram.h"

#include <cmath>
#include <complex>
#include <numbers>

#include "geom/check.h"
#include "geom/parallel.h"

namespace fpo {
namespace {

using geom::Vec2;
using Complex = std::complex<double>;

/// exp(-2 pi i k x), k = 0, ..., last, for each x: a row a sample.
Eigen::MatrixXcd waves(std::span<const Vec2> samples, Eigen::Index axis, double period, int last) {
  Eigen::MatrixXcd rows(static_cast<Eigen::Index>(samples.size()), last + 1);
  for (Eigen::Index s = 0; s < rows.rows(); ++s)
    for (int k = 0; k <= last; ++k)
      rows(s, k) =
          std::polar(1.0, -2 * std::numbers::pi * k * samples[static_cast<std::size_t>(s)][axis] / period);
  return rows;
}

/// Samples whose waves are kept at a time.
constexpr std::size_t block = 4096;

}  // namespace

PowerSpectrum periodogram(std::span<const Vec2> samples, const geom::FlatTorus& torus, double max_frequency,
                          int threads) {
  geom::require(!samples.empty(), "a periodogram needs samples");
  const auto n = static_cast<double>(samples.size());
  const double r = std::sqrt(2 / std::numbers::sqrt3 * torus.area() / n);
  const Vec2 step = r * torus.period().cwiseInverse();
  const int half_x = static_cast<int>(max_frequency / step.x());
  const int half_y = static_cast<int>(max_frequency / step.y());
  geom::require(half_x > 0 && half_y > 0, "too few samples for a periodogram up to that frequency");
  geom::require(double(half_x) * half_y < 1e7, "too many frequencies for a periodogram: lower the largest");
  PowerSpectrum spectrum(step, half_x, half_y);
  // sums(i, j) for (+i, j) and (-i, j); j >= 0 is enough.
  Eigen::MatrixXcd plus = Eigen::MatrixXcd::Zero(half_x + 1, half_y + 1), minus = plus;
  for (std::size_t first = 0; first < samples.size(); first += block) {
    const auto part = samples.subspan(first, std::min(block, samples.size() - first));
    const Eigen::MatrixXcd x = waves(part, 0, torus.period().x(), half_x);
    const Eigen::MatrixXcd y = waves(part, 1, torus.period().y(), half_y);
    geom::parallel_ranges(
        static_cast<std::size_t>(half_y) + 1, 8, threads, [&](std::size_t a, std::size_t b) {
          const auto from = static_cast<Eigen::Index>(a), count = static_cast<Eigen::Index>(b - a);
          plus.middleCols(from, count).noalias() += x.transpose() * y.middleCols(from, count);
          minus.middleCols(from, count).noalias() += x.adjoint() * y.middleCols(from, count);
        });
  }
  for (int i = 0; i <= half_x; ++i) {
    for (int j = 0; j <= half_y; ++j) {
      spectrum.at(i, j) = spectrum.at(-i, -j) = std::norm(plus(i, j)) / n;
      spectrum.at(-i, j) = spectrum.at(i, -j) = std::norm(minus(i, j)) / n;
    }
  }
  spectrum.at(0, 0) = 0;
  return spectrum;
}

}  // namespace fpo
