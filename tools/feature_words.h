#pragma once
// What users are told about the number of samples that features need.

#include <string>

#include "fpo/remesh/pipeline.h"

namespace tools {

/// One line: from which number on all curves are kept and their edges are proven, why, and what of that is so
/// with the samples there are. Empty if there are enough, or no features.
std::string feature_bound_line(const fpo::RemeshResult& result);

}  // namespace tools
