#pragma once
// Local feature size: how far a location of the surface is from the medial axis (sections 3.2 and 5, the
// sizing function of [ABK98]). The medial axis is made of the poles of a dense set of surface points (Amenta
// & Bern, Surface reconstruction by Voronoi filtering, 1999): of each point's Voronoi cell the vertex
// farthest from the point, and the farthest one on the other side.
//
// Of a Voronoi vertex, the ball is the one about it through the four points to which it is dual. A pole
// counts if its ball is larger than the points' gaps by a factor, and touches the surface at two points that
// lie far apart, seen from the pole, with a chord that leaves the surface: this leaves out what sampling,
// noise and the blunt edges of a coarse mesh make of the medial axis. A smaller ball counts, pole or not, if
// it touches two pieces of surface that face each other or away from each other: thin sheets and tubes.

#include <cstdint>
#include <span>
#include <vector>

#include "geom/mesh/trimesh.h"

namespace fpo {

struct LocalFeatureSizeOptions {
  double spacing = 0;  ///< of the surface points, see surface_cover.h; about 0.3 of the wanted edge length
  double min_radius = 1.5;  ///< of a pole's ball, in units of the spacing (of the longest edge there, if 0)
  double min_angle = 60;    ///< degrees, at the pole between the touching points farthest apart
  double min_angle_within_facets = 75;  ///< the same for balls smaller than the facets they touch
  std::uint64_t seed = 1;               ///< of the surface points
  int threads = 1;                      ///< for all but the triangulation; they do not change the result
};

/// A location of the medial axis, inside or outside, and the radius of its ball.
struct MedialPoint {
  geom::Vec3 position;
  double radius;
};

/// The poles that count; of several within 1/8 of the spacing or 1/32 of the radius, one. Deterministic.
/// Cost: a regular triangulation of the surface points, some 8 us a point. Throws InputError on options out
/// of range.
std::vector<MedialPoint> medial_points(const geom::TriMesh& mesh, const LocalFeatureSizeOptions& options);

/// The distance from each location to the nearest medial point, +infinity if there are none: 1-Lipschitz.
/// O(log n) each, more where many medial points are equally far.
std::vector<double> local_feature_size(std::span<const geom::Vec3> locations,
                                       std::span<const MedialPoint> medial, int threads = 1);

/// The local feature size at each vertex, named by a facet or not: about half a spacing, and where the
/// surface bends a few percent, off the distance to the medial axis. Infinite everywhere if there is no
/// medial axis (a flat square). Towards a crease it falls to about the spacing, not to 0: the caller clamps
/// anyway. Sheets and tubes thinner than the spacing may be seen in part only. A coarse mesh of flat pieces
/// has its vertices on creases: there, ask for locations in between as well. Cost: that of medial_points and
/// the searches.
geom::Table<geom::VertexId, double> local_feature_size(const geom::TriMesh& mesh,
                                                       const LocalFeatureSizeOptions& options);

}  // namespace fpo
