#pragma once
// The plain spectrum of uniform samples on a torus.

#include <span>

#include "fpo/spectrum/power_spectrum.h"
#include "geom/regular/flat_torus.h"

namespace fpo {

/// P(f) = |sum_i exp(-2 pi i f.x_i)|^2 / n at all frequencies of the torus, f = (i / Lx, j / Ly), with both
/// components up to max_frequency (in units of 1 / r, r = sqrt(2 / sqrt(3) area / n)). P(0), which is n
/// whatever the samples, is set to 0. Frequencies in the result are in units of 1 / r. Throws
/// geom::InputError without samples or frequencies. Cost: n times frequencies; the sums are shared among
/// threads, with the same result for any number of them.
PowerSpectrum periodogram(std::span<const geom::Vec2> samples, const geom::FlatTorus& torus,
                          double max_frequency, int threads);

}  // namespace fpo
