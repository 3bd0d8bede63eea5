#pragma once
// The remesh as what is left of the surface when all its vertices but the samples have collapsed. Where there
// are too few samples for the diagram to have the surface's topological type (paper, section 5: the
// topological ball property) this has it, for each step keeps it. How few vertices do depends on which ones
// go first: a torus, which needs seven, comes down to eight at times.

#include <atomic>
#include <cstddef>
#include <optional>

#include "fpo/remesh/sampled_surface.h"

namespace fpo {

struct CollapsedMesh {
  geom::TriMesh mesh;  ///< vertex i is sample i
  /// Samples that are elsewhere, at vertices on the surface: later ones count.
  struct Exchange {
    geom::SiteId x;
    SurfaceSample place;
  };
  std::vector<Exchange> exchanged;
};

/// Puts the samples into the surface (sampled_surface.h). If there are to be any iterations, those that are
/// not on features are spread along it by farthest point optimization (farthest_vertices.h). Then takes every
/// other vertex into one it is joined to, as the link condition allows (edited_mesh.h), vertices of curves
/// along these; edges are flipped where that makes better angles (better_flips.h). At first no facet is
/// turned by much and none becomes a needle, later, where nothing else is possible, any. A vertex that cannot
/// go at last becomes a sample, and one that can, but none of the features, is none any more: that with the
/// shortest edge in units of `wanted`, the lengths at the samples. Facets without area come last. Of the
/// surface's type, with all edges of curves that are between samples. None if there are vertices left, if the
/// surface is no manifold, or if it was interrupted. Deterministic. About O(V log V).
std::optional<CollapsedMesh> collapsed_mesh(const SamplesToPut& put, std::span<const double> wanted,
                                            const std::atomic<bool>* interrupted = nullptr,
                                            int iterations = 0);

}  // namespace fpo
