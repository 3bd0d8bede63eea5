#pragma once
// A power spectrum as the paper's figures 7 to 9 show it.

#include <span>

#include "fpo/spectrum/power_spectrum.h"
#include "io/svg.h"

namespace tools {

/// The mean spectrum of some sets and its curve.
struct MeanSpectrum {
  fpo::PowerSpectrum spectrum;
  fpo::RadialCurve curve;
  std::size_t num_sets = 1;
};

/// The ranges of its curves; charts grow where a curve leaves them.
struct SpectrumScale {
  double most_power = 1.2;                       ///< of the radial mean
  double least_decibels = 0, most_decibels = 0;  ///< of the anisotropy; equal: 8 about the isotropic one
};

/// The least that shows all of these, so that eyes can compare them.
SpectrumScale scale_of(std::span<const MeanSpectrum* const> spectra);

/// Left the power at all frequencies, right its radial mean above its anisotropy. The power P is shown as
/// brightness P / (1 + P): black is 0, mid gray that of white noise. About 120 KB at most.
io::Svg draw_spectrum(const MeanSpectrum& mean, const SpectrumScale& scale = {});

}  // namespace tools
