#pragma once
// A surface as differential domain analysis needs it: smooth normals, and small pieces.

#include <array>
#include <functional>
#include <vector>

#include "fpo/spectrum/spectrum_point.h"
#include "fpo/surface/sizing.h"
#include "geom/mesh/aabb_tree.h"

namespace fpo {

/// Part of a surface, by a point of it (spacing 1) and its area.
struct SurfacePiece {
  SpectrumPoint at;
  double area = 0;
};

/// Normals are interpolated between the corners of a facet. A corner's normal is the mean, by angle, over the
/// facets around its vertex that can be reached without crossing a crease (an edge whose facets' normals are
/// more than 45 degrees apart), a border or a non-manifold edge: smooth surfaces look smooth, a cube keeps
/// its sides.
class SpectrumSurface {
 public:
  /// The largest area that a piece around a point may have. The point's spacing means nothing.
  using Limit = std::function<double(const SpectrumPoint&)>;

  /// Keeps a copy. Throws InputError if the mesh has no area. O(F log F).
  explicit SpectrumSurface(const geom::TriMesh& mesh);

  double area() const { return area_; }
  /// The sample with the surface's normal at the nearest point; its position stays as it is.
  SpectrumPoint place(const geom::Vec3& x) const;
  double distance(const geom::Vec3& x) const;  ///< to the nearest point
  /// A value at the nearest point, linear on each facet between those at the vertices.
  double interpolated(const geom::Vec3& x, const VertexField& values) const;
  /// Divides the surface into pieces that keep to the limit, or nearly: large facets are bisected; pieces of
  /// less than a quarter of the limit are joined if they are near each other and face the same way (a cell of
  /// a grid as wide as the limit's square, one octant of normals). The areas sum up to area(). Throws
  /// InputError if there would be too many.
  std::vector<SurfacePiece> pieces(const Limit& limit) const;

 private:
  geom::Vec3 normal(geom::FacetId t, const geom::Vec3& barycentric) const;
  void bisect(geom::FacetId t, const std::array<geom::Vec3, 3>& barycentric, const Limit& limit,
              std::vector<SurfacePiece>& out) const;

  geom::TriMesh mesh_;
  geom::AabbTree tree_;
  geom::Table<geom::FacetId, std::array<geom::Vec3, 3>> corner_normals_;
  double area_;
};

}  // namespace fpo
