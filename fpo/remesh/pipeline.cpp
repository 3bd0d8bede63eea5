#include "fpo/remesh/pipeline.h"

#include <algorithm>
#include <string>

#include "fpo/remesh/far_part.h"
#include "fpo/remesh/remesh_surface.h"
#include "fpo/remesh/remesh_task.h"
#include "fpo/remesh/unit_box.h"
#include "geom/check.h"

namespace fpo {
namespace {

/// And what is far from it. Lengths that were to be even are what was asked for, where they are less, too.
RemeshResult remesh_and_look(const geom::TriMesh& surface, const RemeshOptions& options) {
  RemeshResult result = remesh_surface(surface, options);
  VertexField wanted = result.sizing;
  if (options.sizing == SizingKind::uniform) {
    const double even = even_spacing(surface, options);
    for (double& h : wanted) h = std::max(h, even);
  }
  result.far_part = far_part(surface, wanted, result.mesh, result.samples);
  return result;
}

}  // namespace

RemeshResult remesh(const geom::TriMesh& input, const RemeshOptions& options) try {
  geom::require(options.num_samples > 0, "the number of samples must be at least 1");
  geom::require(options.disk_radius == 0 || options.sizing == SizingKind::uniform,
                "a radius of disks goes with uniform sizing only");
  return remesh_in_unit_box(input, options, remesh_and_look);
} catch (const geom::Bug& bug) {
  throw geom::Bug("seed " + std::to_string(options.seed) + ", " + bug.what());
}

}  // namespace fpo
