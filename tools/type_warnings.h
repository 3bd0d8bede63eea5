#pragma once
// What is said where a remesh is not what was asked for: its topological type, its smallest angle.

#include <string>
#include <vector>

#include "fpo/remesh/pipeline.h"

namespace tools {

/// One line each, without end; none if the remesh is a 2-manifold of the input's type: what differs, in how
/// many places, where the first one is, and what to do.
std::vector<std::string> type_warnings(const geom::TriMesh& input, const fpo::RemeshResult& result,
                                       const fpo::RemeshOptions& options);

/// Lines on angles below 30 degrees and on feature edges that are missing.
std::vector<std::string> shape_warnings(const fpo::RemeshResult& result);

}  // namespace tools
