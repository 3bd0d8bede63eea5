#pragma once
// A surface cut open along edges.

#include "geom/disjoint_sets.h"
#include "geom/mesh/trimesh.h"

namespace geom {

/// Sides of a cut have vertices of their own. `origin` says whose place each has.
struct OpenedMesh {
  TriMesh mesh;
  Table<VertexId, VertexId> origin;
};

/// Corner i of facet t, at 3 t + i: corners at a vertex that are one set stay one vertex. The facets keep
/// their ids. O(F).
OpenedMesh opened(const TriMesh& mesh, DisjointSets& corners);

}  // namespace geom
