#pragma once
// Where samples lie in their facets, for the transfer of attributes.

#include <span>
#include <vector>

#include "fpo/surface/surface_sample.h"

namespace fpo {

/// The barycentric coordinates of each sample in its facet of the surface: non-negative, sum 1 up to
/// rounding. Surfaces of any size that RemeshOptions take.
std::vector<geom::Vec3> barycentric_coordinates(const geom::TriMesh& surface,
                                                std::span<const SurfaceSample> samples);

}  // namespace fpo
