#include "fpo/remesh/methods.h"

#include <algorithm>

#include "fpo/baselines/ccst.h"
#include "fpo/baselines/cps.h"
#include "fpo/baselines/cvt.h"
#include "fpo/baselines/hps.h"
#include "fpo/baselines/mps.h"
#include "fpo/baselines/pps.h"
#include "fpo/baselines/vbs.h"
#include "geom/check.h"

namespace fpo {

std::span<const MethodFacts> methods() {
  // By measurement (bench-adaptive) local iterations past 40 change nothing.
  static constexpr MethodFacts table[] = {
      {Method::fpo, "fpo", "FPO", nullptr, 100, 40},
      {Method::cvt, "cvt", "CVT", centroidal_tessellation, 100, 100},
      {Method::cps, "cps", "CPS", constrained_poisson_disks, 20, 20},
      {Method::pps, "pps", "PPS", parallel_poisson_disks, 10, 10},
      {Method::mps, "mps", "MPS", maximal_poisson_disks, 20, 20},
      {Method::ccst, "ccst", "CCST", capacity_constrained_triangulation, 4, 4},
      {Method::vbs, "vbs", "VBS", variational_blue_noise, 100, 100},
      {Method::hps, "hps", "HPS", hierarchical_poisson_disks, 20, 20}};
  return table;
}

const MethodFacts& facts_of(Method method) {
  const auto found = std::ranges::find(methods(), method, &MethodFacts::method);
  geom::ensure(found != methods().end(), "a method without a line in the table of methods");
  return *found;
}

}  // namespace fpo
