#pragma once
// Improvements that break the type of the remesh, taken back where they do.

#include <atomic>
#include <functional>

#include "fpo/remesh/dual.h"
#include "fpo/remesh/remembered_samples.h"

namespace fpo {

/// Samples at faults of the dual and in a ring around them, and those that were there, go back to where they
/// were before; again at the faults that are there then, in one more ring if these are not fewer; until there
/// is none, in ten rounds and five rings at most. `before`: the dual was right then. `dual`: that of the
/// domain as it is, and afterwards; `next_dual` makes it anew. Is it right? Deterministic.
bool take_back(SurfaceDomain& domain, const RememberedSamples& before, const std::function<Dual()>& next_dual,
               const std::atomic<bool>* interrupted, Dual& dual);

}  // namespace fpo
