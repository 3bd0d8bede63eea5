#pragma once
// What is said where a remesh is not what was asked for: its topological type, its smallest angle.

#include <cstddef>
#include <string>
#include <vector>

#include "fpo/remesh/pipeline.h"

namespace tools {

/// About how many samples would do, the same in all lines: the most of those for the type and for the edges
/// of features. For the type it is the estimate (TypeAdvice); if most edges are missing, which spoils it,
/// at most three times what keeps all; if most samples are on features, no more than that. For edges it is
/// the number from which on all are kept (samples_for_features.h) or, from there on and where there is none,
/// an estimate by those that are missing (edge_advice.h): from there on at most twice as many as there are. A
/// number from which on all are kept that is more than 100 times as large is not told. 0: nothing calls for
/// more.
std::size_t enough_samples(const fpo::RemeshResult& result);

/// One line each, without end; none if the remesh is a 2-manifold of the input's type: what differs, in how
/// many places, where the first one is, and what to do: --repair if the input has edges of more than two
/// facets, more samples. If the input meets itself in vertices, its type is
/// that with these split (geom::SurfaceType); then a line tells the numbers that this has changed.
std::vector<std::string> type_warnings(const geom::TriMesh& input, const fpo::RemeshResult& result,
                                       const fpo::RemeshOptions& options);

/// Lines on features that are given up, on a part that is cut off, on the shortest edge if it is shorter than
/// half of what was wanted, or of an even spacing, on angles below 30 degrees and on feature edges that are
/// missing.
std::vector<std::string> shape_warnings(const geom::TriMesh& input, const fpo::RemeshResult& result,
                                        const fpo::RemeshOptions& options);

}  // namespace tools
