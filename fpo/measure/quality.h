#pragma once
// The quality measures of the paper's tables (section 6).

#include "geom/mesh/trimesh.h"

namespace fpo {

/// Angles in degrees, shares in percent. A facet without area has quality 0 and the angles 0, 0, 180,
/// or 0, 0, 0 if two of its corners coincide.
struct Quality {
  double q_min = 0, q_avg = 0;  ///< Q_t = 6/sqrt(3) area / (half-perimeter * longest edge): 1 if equilateral
  double theta_min = 0, theta_max = 0;
  double theta_min_avg = 0;   ///< mean over facets of the smallest angle
  double theta_lt30_pct = 0;  ///< angles below 30 degrees (less 1e-9, for rounding) among all
  double v567_pct = 0;        ///< interior vertices with 5, 6 or 7 edges among all interior ones; 0 if none
  double delta = 0;           ///< shortest edge / d_max
  double delta_avg = 0;       ///< mean over vertices of the shortest edge there / d_max
  double edge_avg = 0;        ///< mean edge / d_max
};

/// d_max = sqrt(2 area / (sqrt(3) n)), n the number of vertices with a facet; `area`: of the surface that was
/// sampled. O(F log F). Throws geom::InputError if the mesh has no facet.
Quality quality(const geom::TriMesh& mesh, double area);

/// How well edge lengths follow the wanted length h at each vertex (an edge is compared with the geometric
/// mean of its ends).
struct SizingFit {
  double slope = 0;  ///< of log length against log h, least squares: 1 is ideal; 0 if h is constant
  double mean = 0;   ///< of length / h
  double cv = 0;     ///< its standard deviation / its mean
};

/// O(F log F).
SizingFit sizing_fit(const geom::TriMesh& mesh, const geom::Table<geom::VertexId, double>& h);

}  // namespace fpo
