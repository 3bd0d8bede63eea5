#pragma once
// Curvature as a sizing function (section 4: "typically defined by the curvature, or the local feature
// size").

#include <limits>

#include "geom/mesh/trimesh.h"

namespace fpo {

/// The larger magnitude of the two principal curvatures at each vertex, in 1 / length, from the height field
/// a + b x + c y + (d x^2 + 2 e x y + f y^2) / 2 over the tangent plane that fits the vertices of `rings`
/// rings best (more rings where these hold few vertices, as at borders; near ones weigh more). If too few
/// vertices are joined to determine all six coefficients, those of least magnitude are taken: 0 for a vertex
/// without facet or where facets share no vertices. At a crease it is about the crease's angle over the
/// ring's size. Throws InputError unless rings is 1 to 10. O(V) for small vertex degrees.
geom::Table<geom::VertexId, double> max_curvature(const geom::TriMesh& mesh, int rings = 2);

struct CurvatureSizeOptions {
  double min = 0, max = std::numeric_limits<double>::infinity();  ///< the result is clamped to these
  int rings = 2;  ///< see max_curvature: more are less sensitive to noise and see less detail
};

/// The radius of the sharpest bend, 1 / max_curvature, at each vertex. Throws InputError unless
/// 0 <= min <= max.
geom::Table<geom::VertexId, double> curvature_size(const geom::TriMesh& mesh,
                                                   const CurvatureSizeOptions& options);

}  // namespace fpo
