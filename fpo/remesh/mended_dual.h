#pragma once
// The mesh of the samples, mended where it is no surface or of another type.

#include "fpo/remesh/pipeline.h"

namespace fpo {

/// After some rounds that bring samples to where the dual has defects (dual.h): the one with the fewest.
/// Where more than a tenth of the samples are at fault two rounds in vain are enough. Of few faults that are
/// left some are mended by samples that leave (sent_away.h).
/// `counts`: its protection and its number of samples brought grow.
Dual mended_dual(SurfaceDomain& domain, const FeatureSamples& features, const WantedType& type,
                 const RemeshOptions& options, RemeshResult& counts);

}  // namespace fpo
