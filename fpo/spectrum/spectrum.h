#pragma once
// Differential domain analysis (Wei, Wang 2011): the power spectrum of samples, uniform or adaptive, in the
// plane or on a surface, from the differences between them (paper, section 6, figures 7 to 9).

#include <functional>
#include <vector>

#include "fpo/spectrum/power_spectrum.h"
#include "fpo/spectrum/spectrum_point.h"

namespace fpo {

/// Samples and the domain that they were drawn from; spectrum_set.h makes them.
struct SpectrumSet {
  std::vector<SpectrumPoint> samples;
  std::vector<SpectrumPoint> copies;  ///< periodic copies of samples that are near enough to be seen
  /// The domain as pieces in each of which `mass` samples are expected, n in all: coarse ones to look from,
  /// fine ones (with their periodic copies) to look at. Empty: a uniform torus.
  std::vector<SpectrumMass> viewpoints, background;
};

struct SpectrumOptions {
  double radius = 12;        ///< R: differentials up to this length count, in units of the spacing
  double max_frequency = 3;  ///< along each axis, in units of 1 / spacing
  int threads = 1;
  /// Called with the share that is done, in (0, 1], maybe by other threads, but one at a time. Must not
  /// throw.
  std::function<void(double)> on_progress{};
};

// With d(x, y) the differential from x to y, W(r) = cos^2(pi r / 2R) for r < R, T the squared cosine of the
// angle between the normals at x and y (0 beyond 90 degrees), and nu = (samples) - (samples to expect), a
// measure that is +1 at each sample and minus the density elsewhere,
//   P(f) = (1/n) double integral of W(|d(x, y)|) T(x, y) cos(2 pi f.d(x, y)) nu(dx) nu(dy).
// On a uniform torus this is 1 + (1/n) sum_{i != j} W(|d_ij|) cos(2 pi f.d_ij) - lambda * integral of
// W(r) J0(2 pi |f| r) 2 pi r dr, lambda = 2 / sqrt(3). Elsewhere the sums over pairs of samples are corrected
// by those between samples and pieces of the domain, and between pieces: they remove what any samples of that
// density would show (the border, the curvature, sheets that turn away), so that independent samples have
// P = 1 on every domain. Subtracting it on one side only would leave an error linear in nu, which for blue
// noise exceeds P. T lets what turns away fade out: cutting it off leaks as much as P is at small
// frequencies. The expected part matters at small frequencies only, while its sums over pieces go wrong at
// large ones: it fades out from background_full to background_none. Where spacings differ fivefold over some
// tens of samples, white noise has up to 1.1 below f = .5 (bench-spectrum; 1.00 with 2000 samples).
inline constexpr double background_full = 0.7, background_none = 1.0;
/// How many pieces a sample, at least.
inline constexpr double background_density = 4, viewpoint_density = 1;

/// The spectrum of one set. The window smooths it over about 1 / R, as convolution with its transform does;
/// PowerSpectrum::smoothing is n^2 / sum W(|d_ij|)^2, the inverse of an isotropic set's variance / mean^2.
/// Frequencies are 1 / (4 R) apart. Throws geom::InputError if radius or max_frequency is out of range or
/// there are fewer than two samples. Cost: about ten times the pairs of samples within R; shared among
/// threads, with the same result for any number of them.
PowerSpectrum differential_spectrum(const SpectrumSet& set, const SpectrumOptions& options);

/// W(r).
double spectrum_window(double r, double radius);

/// The width of rings for radial_curve() that suits the grid: 1 / (2 R).
double ring_width(const SpectrumOptions& options);

}  // namespace fpo
