#pragma once
// Faults of the dual that one sample less mends, or one that is a little aside: two sheets whose samples are
// in each other's way, say.

#include <atomic>
#include <cstddef>
#include <functional>

#include "fpo/remesh/dual.h"

namespace fpo {

/// x, which is not fixed, leaves for the farthest point of all, and those around its old place follow in
/// their 2-rings. False if there is no empty circle: then nothing moves.
bool send_to_farthest(SurfaceDomain& domain, SiteId x);

/// Where the dual has few faults: one of the samples near them leaves for the farthest point of all, those
/// around it follow, and that stays if there are fewer faults then. As long as that helps, in some fifty
/// trials at most; fixed samples stay. `best`: the dual of the domain as it is, and afterwards; `next_dual`
/// makes it anew. How many left. Deterministic.
std::size_t send_away(SurfaceDomain& domain, const std::function<Dual()>& next_dual,
                      const std::atomic<bool>* interrupted, Dual& best);

/// Where the dual has few faults: one of the samples near them is put aside by a fifth of the wanted length,
/// or two, and stays there if there are fewer faults then. As long as one of twenty places helps; the
/// rest as above. How many were put aside.
std::size_t nudge_aside(SurfaceDomain& domain, const std::function<Dual()>& next_dual,
                        const std::atomic<bool>* interrupted, Dual& best);

}  // namespace fpo
