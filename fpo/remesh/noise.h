#pragma once
// A smooth surface to optimize on where the given one is noise finer than the spacing.
//
// A scan may have dozens of facets in each cell, folded against each other. Its cells are heaps of scraps, a
// move costs milliseconds, and its area is several times that of the body. What is finer than the spacing
// matters nothing to where samples go. So they are optimized on the surface without it and brought to the
// nearest points of the given one, which are near, for its facets are small. (Not in the paper, which names
// noise as its limit, section 7.)

#include <cstddef>
#include <vector>

#include "fpo/remesh/pipeline.h"

namespace fpo {

/// Whether half of the edges inside are folded by more than 30 degrees. O(F).
bool is_folded(const geom::TriMesh& surface);

/// Whether it is, and n cells have 6 facets each and more. Folds of larger facets are shapes, unless without
/// smoothing the remesh is of another type.
bool has_noise(const geom::TriMesh& surface, std::size_t n);

/// Whether nothing is asked for that needs the surface itself: fixed points, marked features, a maximal set,
/// another method than fpo.
bool may_be_smoothed(const RemeshOptions& options);

/// The same facets, each vertex moved towards the mean of those around, as many times as average over some .3
/// spacings of n samples (at most 200 times); at borders of those along them. O(F) each time. Deterministic.
geom::TriMesh smoothed(const geom::TriMesh& surface, std::size_t n);

/// The remesh of the smoothed surface with its samples on the given one: at the nearest points, those of
/// features where they are in their facets. Then angles are mended there (last_angles.h), and measured. Of
/// the same topological type, for the facets are.
RemeshResult on_noise(RemeshResult remesh, const geom::TriMesh& smooth, const geom::TriMesh& surface,
                      const RemeshOptions& options);

}  // namespace fpo
