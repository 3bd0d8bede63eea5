#pragma once
// Building blocks for synthetic surfaces: slabs on top of each other whose outlines are polygons.

#include <array>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "geom/mesh/trimesh.h"

namespace geom {

/// A triangulation of a part of the plane, under construction. Corners with the same coordinates are one.
class PlanarCells {
 public:
  /// Counterclockwise. Returns the index of the triangle.
  std::size_t add_triangle(const Vec2& a, const Vec2& b, const Vec2& c);
  /// A convex quadrilateral, counterclockwise, as two triangles.
  void add_quad(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);
  /// Between two closed polygons of as many corners, both counterclockwise, `inner` within `outer`.
  void add_ring(const std::vector<Vec2>& outer, const std::vector<Vec2>& inner);
  /// A closed polygon all of which `middle` sees, counterclockwise.
  void add_fan(const Vec2& middle, const std::vector<Vec2>& polygon);

  const std::vector<Vec2>& points() const { return points_; }
  const std::vector<std::array<std::size_t, 3>>& cells() const { return cells_; }

 private:
  std::size_t add(const Vec2& p);

  std::vector<Vec2> points_;
  std::vector<std::array<std::size_t, 3>> cells_;
  std::map<std::pair<double, double>, std::size_t> at_;
};

/// Slabs between heights, each of which is solid over some cells.
struct Layers {
  const PlanarCells& plan;
  std::vector<double> heights;  ///< ascending, one more than slabs
  std::function<bool(std::size_t cell, std::size_t slab)> is_solid;
};

/// The surface of all that is solid. A closed 2-manifold unless solid parts meet in no more than an edge or a
/// corner. O(cells times slabs).
TriMesh layered_surface(const Layers& layers);

/// One slab, solid over all cells, from 0 to `height`.
TriMesh prism(const PlanarCells& plan, double height);

}  // namespace geom
