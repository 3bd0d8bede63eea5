#pragma once
// The parts of a mesh: facets joined by edges.

#include "geom/mesh/trimesh.h"

namespace geom {

struct MeshPart {
  std::vector<FacetId> facets;  ///< ascending
  double area = 0;
  bool closed = true;  ///< every edge has two facets
};

/// In the order of their first facets. O(F log F).
std::vector<MeshPart> mesh_parts(const Table<VertexId, Vec3>& vertices,
                                 const Table<FacetId, TriMesh::Facet>& facets);

double area_of(const std::vector<MeshPart>& parts);

/// The share of the area in parts that get fewer than `least` of n samples spread evenly. O(F log F).
double share_of_small_parts(const TriMesh& mesh, double n, double least);

/// What is too small to be meant.
struct CrumbLimits {
  double open_share = 0.01;    ///< of the area, or of the facets: an open part with less is a crumb
  double closed_share = 1e-3;  ///< of the area: likewise for closed parts
  std::size_t few_facets = 2;  ///< so many are a crumb if open
  double most_share = 0.2;     ///< of the area: crumbs of more in all are no crumbs, and stay
};

/// Removes parts below the limits; the largest (the first of them) stays. Returns the number of parts
/// removed.
std::size_t drop_crumbs(const Table<VertexId, Vec3>& vertices, Table<FacetId, TriMesh::Facet>& facets,
                        const CrumbLimits& limits);

/// Open parts of less area than that share of all are crumbs if they hang on a larger part, by vertices alone
/// or over other parts: what a scanner leaves at its jumps.
constexpr double hanging_share = 1e-3;
constexpr double most_hanging = 0.1;  ///< of the area: more in all are no crumbs, and stay

/// Removes those, and returns how many. A disk that hangs on a single vertex leaves the Euler number as it
/// was: its own is 1, of which the vertex that stays is 1. O(F log F).
std::size_t drop_hanging_crumbs(const Table<VertexId, Vec3>& vertices,
                                Table<FacetId, TriMesh::Facet>& facets);

}  // namespace geom
