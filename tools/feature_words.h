#pragma once
// What users are told about the number of samples that features need.

#include <string>

#include "fpo/remesh/pipeline.h"

namespace tools {

/// One line: from which number on all curves are kept and none is in the way of another's edges, why it is so
/// many, and how many edges are proven with the samples there are. Empty if there are enough, or no features.
std::string feature_bound_line(const fpo::RemeshResult& result);
/// Why it is so many, in a few words.
const char* feature_need(fpo::FeatureNeed need);

}  // namespace tools
