#pragma once
// A ball about each facet of a surface: what can be said of the whole facet at once.

#include <cmath>

#include "geom/ids.h"
#include "geom/mesh/levels.h"
#include "geom/mesh/trimesh.h"
#include "geom/power/construct.h"

namespace geom {

enum class Clip { untouched, cut, swallowed };

class FacetBalls {
 public:
  /// All corners are within `extent` of the origin in every coordinate. O(facets).
  FacetBalls(const TriMesh& mesh, double extent);

  const Vec3& middle(FacetId facet) const { return balls_[facet].center; }
  double radius(FacetId facet) const { return balls_[facet].radius; }
  const FacetLevels& levels() const { return levels_; }

  /// What can be said of a bisector on the whole facet: the owner wins everywhere (untouched), the other site
  /// does (swallowed), or it depends (cut).
  Clip compare(FacetId facet, const Bisector& b) const { return lead(facet, b).clip; }
  /// The same with the lead of the owner at the middle.
  struct Lead {
    Clip clip;
    double at_middle;
  };
  Lead lead(FacetId facet, const Bisector& b) const {
    const Ball& ball = balls_[facet];
    double f = b(ball.center), bound = b.error + b.length * ball.radius;
    if (b.rise != 0) f += b.rise * levels_.middle(facet), bound += std::abs(b.rise) * levels_.half(facet);
    return {f > bound ? Clip::untouched : f < -bound ? Clip::swallowed : Clip::cut, f};
  }

  /// Does the ball about the facet meet that about x?
  bool comes_near(FacetId facet, const Vec3& x, double distance) const {
    const Ball& ball = balls_[facet];
    const double far = (ball.radius + distance) * (1 + 1e-9);
    return (x - ball.center).squaredNorm() <= far * far;
  }

 private:
  struct Ball {
    Vec3 center;
    double radius;  ///< rounded up
  };
  Table<FacetId, Ball> balls_;
  FacetLevels levels_;
};

}  // namespace geom
