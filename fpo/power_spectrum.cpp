#include "fpo/power_spectrum.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geom/check.h"

namespace fpo {
namespace {

/// Mean and variance of a stream of numbers (Welford).
struct Moments {
  std::size_t count = 0;
  double mean = 0, squares = 0;
  void add(double x) {
    const double from_old = x - mean;
    mean += from_old / static_cast<double>(++count);
    squares += from_old * (x - mean);
  }
};

}  // namespace

RadialCurve radial_curve(const PowerSpectrum& s, double width) {
  const double reach = std::min(s.half_x * s.step.x(), s.half_y * s.step.y());
  const auto last_ring = static_cast<std::size_t>(std::max(0.0, std::floor(reach / width + 1e-9)));
  std::vector<Moments> rings(last_ring + 1);
  for (int j = 0; j <= s.half_y; ++j) {
    for (int i = j == 0 ? 1 : -s.half_x; i <= s.half_x; ++i) {
      const double f = std::hypot(i * s.step.x(), j * s.step.y());
      const auto ring = static_cast<std::size_t>(std::lround(f / width));
      if (ring >= 1 && ring <= last_ring) rings[ring].add(s.at(i, j));
    }
  }
  RadialCurve curve;
  for (std::size_t k = 1; k <= last_ring; ++k) {
    const Moments& ring = rings[k];
    if (ring.count == 0) continue;
    curve.frequency.push_back(static_cast<double>(k) * width);
    curve.mean.push_back(ring.mean);
    const double variance = ring.count > 1 ? ring.squares / static_cast<double>(ring.count - 1)
                                           : std::numeric_limits<double>::quiet_NaN();
    curve.anisotropy.push_back(s.smoothing * variance / (ring.mean * ring.mean));
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
