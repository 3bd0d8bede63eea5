#pragma once
// Points that the user wants to be vertices.

#include <span>
#include <vector>

#include "fpo/surface/surface_sample.h"
#include "geom/mesh/trimesh.h"

namespace fpo {

/// Of the diagonal: what is nearer to a surface or curve is on it.
inline constexpr double point_tolerance = 1e-6;

/// Points on a surface as samples, their positions kept exactly. Throws InputError, naming the point, if one
/// is farther from the surface than 1e-6 of its diagonal. O(F log F + points log F).
std::vector<SurfaceSample> points_on_surface(const geom::TriMesh& mesh, std::span<const geom::Vec3> points);

}  // namespace fpo
