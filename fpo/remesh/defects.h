#pragma once
// Where a remesh is no surface: vertices whose triangles form neither one fan nor one disk.

#include <cstddef>
#include <map>
#include <vector>

#include "fpo/features/feature_samples.h"
#include "geom/mesh/edges.h"

namespace fpo {

/// Edges of a remesh that have more than two triangles, as the input has facets there; how many.
using BranchEdges = std::map<geom::MeshEdge, std::size_t>;

/// Those between samples that follow each other on curves where the input has more than two facets.
BranchEdges branch_edges(const FeatureSamples& features);

/// A sample whose triangles form neither one fan nor one disk, or that has none.
struct Defect {
  geom::SiteId at;
  geom::SiteId towards;  ///< the other end of an edge with more than two triangles, if there is one
};

/// All of them, ascending; not those whose triangles are connected by edges and are as many at each edge as
/// there are to be.
std::vector<Defect> find_defects(const geom::TriMesh& mesh, const BranchEdges& branches = {});

}  // namespace fpo
