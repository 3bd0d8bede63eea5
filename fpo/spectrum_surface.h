#pragma once
// A surface as differential domain analysis needs it: smooth normals, and pieces of equal area.

#include <array>
#include <vector>

#include "fpo/spectrum_point.h"
#include "geom/aabb_tree.h"

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
  /// Keeps a copy. Throws InputError if the mesh has no area. O(F log F).
  explicit SpectrumSurface(const geom::TriMesh& mesh);

  double area() const { return area_; }
  /// The sample with the surface's normal at the nearest point; its position stays as it is.
  SpectrumPoint place(const geom::Vec3& x) const;
  /// Divides the surface into about `count` pieces or somewhat more. Large facets are bisected; small ones
  /// are joined if they are near each other and face the same way. The areas sum up to area().
  std::vector<SurfacePiece> pieces(double count) const;

 private:
  geom::Vec3 normal(geom::FacetId t, const geom::Vec3& barycentric) const;
  void bisect(geom::FacetId t, const std::array<geom::Vec3, 3>& barycentric, double largest,
              std::vector<SurfacePiece>& out) const;

  geom::TriMesh mesh_;
  geom::AabbTree tree_;
  geom::Table<geom::FacetId, std::array<geom::Vec3, 3>> corner_normals_;
  double area_;
};

}  // namespace fpo
