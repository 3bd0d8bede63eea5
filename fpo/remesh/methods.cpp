#include "fpo/remesh/methods.h"

#include <algorithm>
#include <array>

#include "fpo/baselines/cps.h"
#include "fpo/baselines/cvt.h"
#include "fpo/baselines/mps.h"
#include "geom/check.h"

namespace fpo {

std::span<const MethodFacts> methods() {
  // By measurement (bench-adaptive) local iterations past 40 change nothing.
  static constexpr std::array<MethodFacts, 4> table = {
      {{Method::fpo, "fpo", "FPO", nullptr, 100, 40},
       {Method::cvt, "cvt", "CVT", centroidal_tessellation, 100, 100},
       {Method::cps, "cps", "CPS", constrained_poisson_disks, 20, 20},
       {Method::mps, "mps", "MPS", maximal_poisson_disks, 20, 20}}};
  return table;
}

const MethodFacts& facts_of(Method method) {
  const auto found = std::ranges::find(methods(), method, &MethodFacts::method);
  geom::ensure(found != methods().end(), "a method without a line in the table of methods");
  return *found;
}

}  // namespace fpo
