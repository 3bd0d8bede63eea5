#pragma once
// Which creases are kept, seen from the remeshes that they lead to.

#include "fpo/remesh/pipeline.h"

namespace fpo {

/// Without any crease.
RemeshOptions without_creases(RemeshOptions options);

/// Creases that nobody asked for are kept unless that alone does harm. Where they have no room, those that
/// have are tried first. Where the result is of no use with all of them, or has many small angles, the
/// strongest are tried alone, then none.
RemeshResult remesh_with_useful_creases(const geom::TriMesh& surface, const RemeshOptions& options);

}  // namespace fpo
