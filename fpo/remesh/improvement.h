#pragma once
// What follows the optimization: angles (paper, section 5), fidelity and closeness to the surface, the edges
// of curves proven, and what is mended at the end.

#include "fpo/features/feature_samples.h"
#include "fpo/remesh/dual.h"
#include "fpo/remesh/pipeline.h"
#include "fpo/surface/surface_domain.h"

namespace fpo {

struct Improvement {
  const SharedSizing& shared;
  const WantedType& type;
  const Features* curves;  ///< of the domain's mesh; null: their edges are not to be proven
  AngleOptions angles;
};

/// Those of the options, and who interrupts.
AngleOptions angle_options(const RemeshOptions& options);

/// The dual of the samples, improved as far as that leaves it of the input's type: where it was right before,
/// what breaks it is taken back around (taken_back.h); if that is no help, without fidelity, then without
/// angles, too. What is past mending (attempts.h) is mended first, and improved only if it is of the type
/// then, and stays so. The result is told what was done.
Dual improved_dual(SurfaceDomain& domain, const Improvement& how, RemeshOptions options,
                   RemeshResult& result);

}  // namespace fpo
