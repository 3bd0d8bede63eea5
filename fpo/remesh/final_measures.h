#pragma once
// What is said of a remesh, measured on the mesh as it is written.

#include <cstddef>
#include <vector>

#include "fpo/remesh/angles.h"
#include "fpo/remesh/dual.h"

namespace fpo {

/// An edge that is shorter than all others.
struct ShortEdge {
  double length = 0;
  geom::Vec3 middle{0, 0, 0};
  bool is_fixed = false;  ///< both its ends are
};

/// Lengths in units of the wanted edge length at a vertex, of an edge at its ends (geometric mean). Edges
/// only: samples of two sheets may be near each other.
struct FinalMeasures {
  double delta = 0;       ///< the shortest edge at a vertex that is not fixed (at any if all are): the least
  double mean_delta = 0;  ///< and the mean of them
  double mean_edge = 0;
  double least_edge = 0;            ///< the shortest of all edges
  double greatest_edge = 0;         ///< the longest, in the larger of the lengths wanted at its ends
  ShortEdge least;                  ///< that one, its length in the units of the surface
  ShortEdge shortest;               ///< the shortest in these units
  double theta_min = 180;           ///< the smallest angle, degrees
  std::size_t angles_below_30 = 0;  ///< less 1e-9 for rounding
  std::size_t bad_triangles = 0;    ///< beyond the bounds of angle optimization
};

/// Vertices with smaller ids than `num_fixed` are fixed. O(F log F).
FinalMeasures final_measures(const geom::TriMesh& mesh, const VertexField& wanted, std::size_t num_fixed,
                             const AngleOptions& angles);

/// Where a remesh is of another type than its input, and how many samples would do.
struct TypeAdvice {
  std::vector<geom::Vec3> places;  ///< one of each group of faults within two wanted lengths
  /// About: so many that three fit around each place, taken from elsewhere as far as not all is thin; 0: none
  /// is needed.
  std::size_t samples = 0;
};

/// Of a dual with n samples. Empty if the type is right. O(faults^2).
TypeAdvice type_advice(const Dual& dual, const geom::TriMesh& surface, const geom::SurfaceType& type,
                       const Sizing& sizing);

}  // namespace fpo
