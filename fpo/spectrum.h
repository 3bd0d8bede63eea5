#pragma once
// Differential domain analysis (Wei, Wang 2011): the power spectrum of samples, uniform or adaptive, in the
// plane or on a surface, from the differences between them (paper, section 6, figures 7 to 9).

#include <span>
#include <vector>

#include "fpo/power_spectrum.h"
#include "fpo/spectrum_point.h"

namespace fpo {

/// A place that stands for a piece of the domain in which `mass` samples are expected.
struct BackgroundPoint {
  SpectrumPoint at;
  double mass = 0;
};

/// Samples and the domain that they were drawn from; spectrum_set.h makes them.
struct SpectrumSet {
  std::vector<SpectrumPoint> samples;
  std::vector<SpectrumPoint> copies;        ///< periodic copies of samples that are near enough to be seen
  std::vector<BackgroundPoint> background;  ///< of the whole domain, copies included; empty: a uniform torus
};

struct SpectrumOptions {
  double radius = 12;        ///< R: differentials up to this length count, in units of the spacing
  double max_frequency = 3;  ///< along each axis, in units of 1 / spacing
  int threads = 1;
};

// With W(r) = cos^2(pi r / 2R) for r < R and d the differentials,
//   P(f) = 1 + (1/n) sum_i [ sum_{j != i} W(|d_ij|) cos(2 pi f.d_ij) - integral of the same over the domain
//   ],
// the integral taken over all places y where a sample could be instead of x_j, by the density of samples. It
// removes what any samples of that density would show: the shape of the domain (its border, its curvature,
// the sheets that turn away), so that independent samples have P = 1 on every domain. On a uniform torus it
// is lambda W(|d|) over the plane, lambda = 2 / sqrt(3), whose transform is lambda times the integral of W(r)
// J0(2 pi |f| r) 2 pi r dr. Elsewhere it is a sum over background points. It matters at small frequencies
// only (below about 3 / R, at borders and folds more), while the sum has errors at large ones: it fades out
// between background_full and background_none.
inline constexpr double background_full = 0.8, background_none = 1.2;
/// How many background points a sample: spaced well below 1 / background_none.
inline constexpr double background_points_per_sample = 8;

/// The spectrum of one set. The window smooths it as convolution with its transform does, over about 1 / R;
/// PowerSpectrum::smoothing is n^2 / sum W(|d_ij|)^2, the inverse of an isotropic set's variance / mean^2.
/// Frequencies are 1 / (4 R) apart. Throws geom::InputError if radius or max_frequency is out of range or
/// there are fewer than two samples. Cost: samples within R of each sample, ten times as many background
/// points; shared among threads, with the same result for any number of them.
PowerSpectrum differential_spectrum(const SpectrumSet& set, const SpectrumOptions& options);

/// W(r).
double spectrum_window(double r, double radius);

/// The width of rings for radial_curve() that suits the grid: 1 / (2 R).
double ring_width(const SpectrumOptions& options);

}  // namespace fpo
