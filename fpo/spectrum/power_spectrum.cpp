#include "fpo/spectrum/power_spectrum.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geom/check.h"

namespace fpo {
namespace {

/// The sums that a straight line through (x, y) needs.
struct Line {
  double count = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  void add(double at, double value) {
    count += 1;
    x += at;
    y += value;
    xx += at * at;
    xy += at * value;
    yy += value * value;
  }
  double mean() const { return y / count; }
  /// Of the values around the line of least squares.
  double variance() const {
    if (count < 3) return std::numeric_limits<double>::quiet_NaN();
    const double sxx = xx - x * x / count, sxy = xy - x * y / count, syy = yy - y * y / count;
    const bool sloped = sxx > 1e-12 * xx;
    return std::max(0.0, syy - (sloped ? sxy * sxy / sxx : 0)) / (count - (sloped ? 2 : 1));
  }
};

}  // namespace

RadialCurve radial_curve(const PowerSpectrum& s, double width) {
  const double reach = std::min(s.half_x * s.step.x(), s.half_y * s.step.y());
  const auto last_ring = static_cast<std::size_t>(std::max(0.0, std::floor(reach / width + 1e-9)));
  std::vector<Line> rings(last_ring + 1);
  for (int j = 0; j <= s.half_y; ++j) {
    for (int i = j == 0 ? 1 : -s.half_x; i <= s.half_x; ++i) {
      const double f = std::hypot(i * s.step.x(), j * s.step.y());
      const auto ring = static_cast<std::size_t>(std::lround(f / width));
      if (ring >= 1 && ring <= last_ring) rings[ring].add(f - static_cast<double>(ring) * width, s.at(i, j));
    }
  }
  RadialCurve curve;
  for (std::size_t k = 1; k <= last_ring; ++k) {
    const Line& ring = rings[k];
    if (ring.count == 0) continue;
    curve.frequency.push_back(static_cast<double>(k) * width);
    curve.mean.push_back(ring.mean());
    curve.anisotropy.push_back(s.smoothing * ring.variance() / (ring.mean() * ring.mean()));
  }
  return curve;
}

PowerSpectrum mean_spectrum(std::span<const PowerSpectrum> spectra) {
  geom::require(!spectra.empty(), "there is no spectrum to average");
  PowerSpectrum mean = spectra.front();
  double variance = 0;
  for (const PowerSpectrum& s : spectra) {
    geom::ensure(s.step == mean.step && s.half_x == mean.half_x && s.half_y == mean.half_y,
                 "mean_spectrum: grids differ");
    if (&s != &spectra.front())
      for (std::size_t i = 0; i < s.power.size(); ++i) mean.power[i] += s.power[i];
    variance += 1 / s.smoothing;
  }
  const auto count = static_cast<double>(spectra.size());
  for (double& p : mean.power) p /= count;
  mean.smoothing = count / variance;
  return mean;
}

double decibel(double ratio) { return 10 * std::log10(ratio); }

}  // namespace fpo
