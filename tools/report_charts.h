#pragma once
// The charts of a report.

#include <span>
#include <vector>

#include "fpo/optimize.h"
#include "fpo/surface/sizing.h"
#include "io/chart.h"

namespace tools {

/// All angles of a mesh, in bins of 2 degrees.
io::Chart angle_histogram(const geom::TriMesh& mesh);

/// Edge lengths over the geometric mean of the lengths wanted at their ends, in bins of .02; those beyond 2.5
/// count in the last.
io::Chart length_histogram(const geom::TriMesh& mesh, const fpo::VertexField& wanted);

/// delta and its mean by iteration.
io::Chart convergence_chart(std::span<const fpo::IterationReport> iterations);

}  // namespace tools
