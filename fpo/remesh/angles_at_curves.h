#pragma once
// Small angles of a remesh beside features, and which features are near to each other there. The paper
// (section 5) keeps all features that it is given; of two lines that come closer to each other than samples,
// or meet at a small angle, no triangles between are good. Which these are is seen best from a remesh.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "fpo/features/features.h"

namespace fpo {

/// A remesh whose first vertices are the samples on features of a surface, and the places where it is not of
/// the surface's type.
struct RemeshWithCurves {
  const geom::TriMesh& mesh;
  std::size_t on_features = 0;
  std::span<const geom::Vec3> faults = {};
};

/// In spacings: triangles between curves are good if these are farther.
inline constexpr double near_another_curve = 0.7;

/// A triangle with an angle below 30 degrees, or a fault.
struct SmallAngle {
  double lacking;                     ///< 1 for no angle, half for 15 degrees
  std::array<geom::Vec3, 3> corners;  ///< of a fault all the same
  std::vector<std::size_t> to_blame;  ///< one of these curves is, ascending
};

/// Those beside curves. If at least two vertices of the triangle are on features, these are to blame, or the
/// two that the angle is between; for a fault, those within .7 spacings. Faults first, then the worst first.
/// O(small angles * edges of curves).
std::vector<SmallAngle> angles_at_curves(const geom::TriMesh& surface, const Features& features,
                                         const RemeshWithCurves& remesh, double spacing);

/// What angles below 30 degrees lack in all, the smallest of each triangle: 1 for no angle, half for 15.
/// O(F).
double lacking_in_angles(const geom::TriMesh& remesh);

/// The vertices at the ends of the edge of that number; of a loop, the last one leads back.
std::array<geom::VertexId, 2> edge_of(const FeatureCurve& curve, std::size_t number);

/// Which edges of a surface's curves are near to other curves, of those to blame for one angle.
class NearEdges {
 public:
  /// Keeps references.
  NearEdges(const geom::TriMesh& surface, const Features& features, const SmallAngle& angle, double spacing)
      : surface_(surface), features_(features), angle_(angle), near_(near_another_curve * spacing) {}

  /// Is x, of curve c, within .7 spacings of another one?
  bool is_near_another(const geom::Vec3& x, std::size_t c) const;
  /// The number of the edge of c that is nearest to the triangle.
  std::size_t nearest_edge(std::size_t c) const;
  /// Of each edge of c, whether it is this one, or joined to it by edges whose ends towards it are near. All
  /// if there is no other curve. O(edges of curves) for each of c.
  std::vector<bool> of(std::size_t c) const;

 private:
  const geom::TriMesh& surface_;
  const Features& features_;
  const SmallAngle& angle_;
  double near_;
};

}  // namespace fpo
