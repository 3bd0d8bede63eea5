#pragma once
// The methods of the paper's table 1 that are here, in one table that the pipeline, the options of the tools
// and the reports read: another method is a line there and a file in fpo/baselines.

#include <span>

#include "fpo/baselines/baseline.h"

namespace fpo {

/// How samples are distributed: the paper's way, or one of those it compares with. A line of the table that
/// no code names needs no name here: Method{8}.
enum class Method { fpo, cvt, cps, pps, mps, ccst, vbs, hps };

struct MethodFacts {
  Method method;
  const char* name;     ///< on the command line
  const char* acronym;  ///< in the paper's tables
  /// Samples from nothing. Null: farthest point optimization, which the pipeline does itself.
  BaselineResult (*distribute)(const BaselineTask&, const OptimizeOptions&);
  int iterations;  ///< more change little; disks: radii tried for the number wanted; ccst: as in the paper
  int adaptive_iterations;  ///< the same unless the sizing is uniform
};

/// All of them: ours, then the others in the paper's order.
std::span<const MethodFacts> methods();

/// Throws Bug if the method has no line in the table.
const MethodFacts& facts_of(Method method);

}  // namespace fpo
