#pragma once
// From one mesh of vertices to another one of the same vertices, by flips, as far as that goes: where the
// other one is no surface something is left.

#include <vector>

#include "geom/mesh/edges.h"

namespace fpo {

/// Flips edges that the goal has not, to such that it has, where that turns no facet over, and else, but for
/// those that it has, where angles become better (better_flips.h), in turn until nothing changes. `kept`,
/// ascending, are not flipped. The mesh stays of its type, whatever the goal is. O(F log F) for each turn, at
/// most eight.
geom::TriMesh flipped_towards(const geom::TriMesh& mesh, const geom::TriMesh& goal,
                              const std::vector<geom::MeshEdge>& kept);

}  // namespace fpo
