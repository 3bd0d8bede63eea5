#pragma once
// Local feature size in the plane, the sizing of the paper's figure 4: how far a point of a curve is from the
// curve's medial axis (Amenta, Bern, Kamvysselis, A new Voronoi-based surface reconstruction algorithm, 1998:
// [ABK98]).
//
// The curves are cut into short pieces; the medial axis is read off the Voronoi diagram of the pieces' ends.
// Of a Voronoi edge between two of them counts what lies where circles about it touch both under an angle of
// at least 60 degrees at the center: this leaves out the branches into the blunt corners of a polyline that
// means a smooth curve. Edges between the ends of one piece cross the curve and never count. Isolated points
// are curves of their own: their medial axis is their Voronoi diagram.

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "fpo/plane/plane_sizing.h"

namespace fpo {

/// Corners of a curve in order, straight in between; a single one is an isolated point.
using Polyline = std::vector<geom::Vec2>;

/// A point of a curve, on the torus, and its distance to the medial axis.
struct CurvePoint {
  geom::Vec2 position;
  double feature_size;
};

/// The feature size at points at most `spacing` apart on the curves, which are periodic like the torus
/// (coordinates outside wrap around). Within about `spacing` of the truth; at sharp corners, where it is 0,
/// about `spacing`. Cost: a Delaunay triangulation of nine copies of the points (more of an oblong torus, for
/// the triangulation needs a square one). Throws InputError if there is no curve, a coordinate is not finite,
/// or the curves are too long for the spacing (400,000 points, copies included 10 million).
std::vector<CurvePoint> curve_feature_size(std::span<const Polyline> curves, const geom::FlatTorus& torus,
                                           double spacing);

/// What makes feature sizes a sizing function.
struct FeatureLimits {
  double ratio = 10;  ///< largest to smallest rho: feature sizes below largest / ratio count as that
  double gradation = 0.3;
};

/// rho at x = min over curve points c of (rho(c) + slope |x - c|): the feature size on the curves, growing
/// away from them as fast as the gradation lets the wanted edge length h grow. On a grid of 512 cells along
/// the longer period. Throws InputError for no points or senseless limits.
std::unique_ptr<PlaneSizing> feature_sizing(std::span<const CurvePoint> points, const geom::FlatTorus& torus,
                                            std::size_t num_samples, const FeatureLimits& limits = {});

}  // namespace fpo
