#pragma once
// A rectangle with a border as a surface: the plane without periods, through the surface engine (section 4).

#include "fpo/plane/plane_sizing.h"
#include "fpo/surface/sizing.h"
#include "geom/mesh/trimesh.h"

namespace fpo {

/// The rectangle [0, width] x [0, height] at z = 0, facing up: a grid of `cells` squares or so along the
/// longer side, two facets each. Every vertex on the border has a border coordinate exactly. Throws
/// InputError unless width and height are positive and finite and 1 <= cells <= 2048.
geom::TriMesh rectangle_mesh(const geom::Vec2& size, int cells = 1);

/// rho at the vertices of such a mesh. The sizing is that of a torus with the rectangle's sides as periods.
VertexField rho_at_vertices(const geom::TriMesh& rectangle, const PlaneSizing& sizing);

}  // namespace fpo
