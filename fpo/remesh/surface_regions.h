#pragma once
// The parts of a surface that are nearer to one sample than to others along its edges: Voronoi cells of the
// surface itself, which do not reach through space.

#include "fpo/remesh/sampled_surface.h"

namespace fpo {

struct SurfaceRegions {
  geom::Table<geom::VertexId, geom::SiteId> of;  ///< none: nothing leads there
  geom::Table<geom::VertexId, double> distance;
  /// The next vertex on the way to the sample. None: it is there.
  geom::Table<geom::VertexId, geom::VertexId> next;
};

/// Vertices of curves that have samples belong to these. O(V log V).
SurfaceRegions surface_regions(const SampledSurface& surface);

/// At each vertex the length of its region (`wanted`: of the samples, positive), but in no place so much more
/// than at others near that fans of edges would come together there; the greatest of all where nothing leads.
geom::Table<geom::VertexId, double> graded_lengths(const SampledSurface& surface,
                                                   std::span<const double> wanted);

/// Splits edges longer than `most` times the graded length at one of their ends, the longest first. Ends at
/// `most_vertices`.
void split_long_edges(SampledSurface& surface, std::span<const double> wanted, double most,
                      std::size_t most_vertices);

}  // namespace fpo
