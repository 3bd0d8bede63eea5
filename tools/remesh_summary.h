#pragma once
// What fpo-remesh says of its result.

#include "fpo/measure/hausdorff.h"
#include "fpo/remesh/at_least.h"
#include "tools/remesh_arguments.h"
#include "tools/remesh_report.h"
#include "tools/summary.h"

namespace tools {

/// Keys and words. delta and mean_delta are those of uniform sizing, as fpo-quality has them; of another they
/// are delta_of_wanted and mean_delta_of_wanted, in units of the wanted length at each sample. `distance`: of
/// the remesh from the input in percent of its diagonal, if it was asked for.
Summary summary_of(const RemeshArguments& a, const geom::TriMesh& input, const fpo::AtLeastResult& found,
                   const RemeshRun& run, const std::optional<fpo::SurfaceDistance>& distance);

}  // namespace tools
