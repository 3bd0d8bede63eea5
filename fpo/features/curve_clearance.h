#pragma once
// How far feature curves are from each other, in space: the local feature size of the curve network, by which
// protecting balls are bounded (cf. Cheng, Dey, Levine 2007), with corners told apart, where it is zero.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fpo/features/features.h"
#include "fpo/surface/surface_sample.h"

namespace fpo {

/// Two curves, or both ends of one, that begin at one vertex.
struct CurveCorner {
  geom::VertexId at;
  std::size_t curve, other;  ///< curve <= other
  double angle;              ///< between their first edges there, radians
};

/// All pairs at all ends of curves. O(pairs).
std::vector<CurveCorner> curve_corners(const geom::TriMesh& mesh, const Features& features);

/// A place on a curve.
struct CurveClearance {
  SurfaceSample at;
  std::size_t curve;
  double length;    ///< of the part of the curve that it stands for: at most a quarter of the distance
  double distance;  ///< to the nearest place of a curve that is not beside it
  bool across;      ///< the middle of the way there is near the surface: a strip is between
};

/// The places that are nearer than `reach` to another. What is along the same curve is beside a place, and so
/// is what is in the cone of a corner of both curves: farther than .7 r sin a, where r is the larger way to
/// the corner along them and a their angle there, or a right one. Of more than `most`
/// places one more than that: two bodies on each other have millions. O(places, by a grid).
std::vector<CurveClearance> curve_clearances(const geom::TriMesh& mesh, const Features& features,
                                             double reach, std::size_t most = SIZE_MAX);

}  // namespace fpo
