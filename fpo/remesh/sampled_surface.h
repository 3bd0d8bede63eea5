#pragma once
// A surface that has all samples among its vertices: where a remesh by collapses begins.

#include <span>

#include "fpo/features/feature_samples.h"
#include "fpo/features/features.h"
#include "fpo/remesh/curve_edges.h"
#include "fpo/remesh/edited_mesh.h"

namespace fpo {

/// What is put in: samples, of which the first are those of the features, with facets of the surface.
struct SamplesToPut {
  const geom::TriMesh& surface;
  const Features& features;
  const FeatureSamples& of_features;
  std::span<const SurfaceSample> samples;
};

struct SampledSurface {
  EditedMesh mesh;  ///< the surface's vertices first
  CurveEdges curves;
  geom::Table<geom::SiteId, geom::VertexId> vertex_of;  ///< a sample
  geom::Table<geom::FacetId, geom::FacetId> parents;    ///< of its facets, those of the surface
};

/// A new vertex on an edge, on the curve that the edge is on.
geom::VertexId split_edge(SampledSurface& surface, geom::VertexId a, geom::VertexId b, const geom::Vec3& at);

/// Facets are split at the samples in them, edges of curves at the samples on these, in their order along
/// the curve, other edges at samples that are as good as on them; a sample at a vertex is that vertex. Where
/// facets of one facet of the surface have larger angles across an edge than the other edge would give them
/// it is flipped: in the plane that makes the Delaunay triangulation. The surface must be a manifold; it
/// stays of its type whatever is rounded. O(samples) steps, each of O(square root of the samples in a facet).
SampledSurface sampled_surface(const SamplesToPut& put);

}  // namespace fpo
