#pragma once
// All that remesh() does on a surface that is in the unit box: which features, which ways, and whether the
// surface, a smoothed one or one without teeth is remeshed.

#include "fpo/remesh/pipeline.h"

namespace fpo {

/// On a smooth surface where this one is noise or, if it is folded, no remesh of it is of its type; or on
/// itself. What stands in for a surface (stand_in_remesh.h) is remeshed by it, too.
RemeshResult remesh_surface(const geom::TriMesh& surface, const RemeshOptions& options);

}  // namespace fpo
