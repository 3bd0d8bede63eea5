#pragma once
// A power spectrum on a grid of frequencies, its mean over directions and its anisotropy (paper, section 6,
// figures 7 to 9).

#include <cstddef>
#include <span>
#include <vector>

#include "geom/vec.h"

namespace fpo {

/// Power P at the frequencies (i step.x, j step.y), |i| <= half_x, |j| <= half_y; P(-f) = P(f). Frequencies
/// are in units of 1 / r, r the spacing of a hexagonal arrangement of the same density; independent samples
/// (white noise) have P = 1.
struct PowerSpectrum {
  geom::Vec2 step{1, 1};
  int half_x = 0, half_y = 0;
  std::vector<double> power;  ///< row by row, j = -half_y first
  /// Into how many sets' worth of independent estimates each P is smoothed already: an isotropic set has
  /// variance / mean^2 = 1 / smoothing over directions. 1 for a periodogram.
  double smoothing = 1;

  PowerSpectrum() = default;
  PowerSpectrum(const geom::Vec2& step, int half_x, int half_y)
      : step(step), half_x(half_x), half_y(half_y), power(std::size_t(2 * half_x + 1) * (2 * half_y + 1)) {}
  double& at(int i, int j) { return power[index(i, j)]; }
  double at(int i, int j) const { return power[index(i, j)]; }

 private:
  std::size_t index(int i, int j) const { return std::size_t(j + half_y) * (2 * half_x + 1) + (i + half_x); }
};

/// Mean and anisotropy in rings of the frequency plane; rings without a frequency of the grid are left out.
struct RadialCurve {
  std::vector<double> frequency;  ///< the middle of the ring
  std::vector<double> mean;       ///< of P over the ring
  /// Variance over the ring / mean^2, times `smoothing`: 1 for one isotropic set, 1 / M for the mean spectrum
  /// of M of them, more where power depends on the direction. The variance is that around a line in |f|, so
  /// that a steep spectrum does not count as anisotropic. NaN in a ring of fewer than three frequencies.
  std::vector<double> anisotropy;
};

/// Rings |f| in [(k - 1/2) width, (k + 1/2) width), k = 1, 2, ..., as long as they fit into the grid. Each
/// pair f, -f counts once.
RadialCurve radial_curve(const PowerSpectrum& spectrum, double width);

/// The mean of spectra on one grid. Throws geom::InputError if there is none, geom::Bug if grids differ.
PowerSpectrum mean_spectrum(std::span<const PowerSpectrum> spectra);

/// 10 log10.
double decibel(double ratio);

}  // namespace fpo
