#pragma once
// Blends of machined parts: bands that bend within about a spacing, as fillets do. Even lengths cut across
// them: the remesh is up to a third of a spacing off.

#include <cstddef>
#include <optional>

#include "fpo/features/features.h"
#include "fpo/surface/sizing.h"

namespace fpo {

/// Lengths of n samples in all that are even but for blends: where the radius of curvature of one side of
/// the features is less than the spacing, on a band that is at least four spacings long, edges are those
/// with which triangles stay within .16 spacings of the surface, at least .75 of the spacing, graded; at
/// least .85 if that takes too many samples. None if there are no creases, no such band, or edges elsewhere
/// would become more than 1.1 times as long. Keeps a reference to the surface. O(F log F).
std::optional<Sizing> sizing_beside_blends(const geom::TriMesh& surface, const Features& features,
                                           std::size_t n, double gradation);

}  // namespace fpo
