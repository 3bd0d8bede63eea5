#pragma once
// Building blocks for synthetic surfaces: grids, surfaces of revolution, blocks, subdivision.

#include <array>
#include <functional>
#include <vector>

#include "geom/mesh/trimesh.h"

namespace geom {

/// Arrays under construction.
struct MeshArrays {
  Table<VertexId, Vec3> vertices;
  Table<FacetId, TriMesh::Facet> facets;

  VertexId add(const Vec3& position);
  void add_triangle(VertexId a, VertexId b, VertexId c) { facets.push_back({a, b, c}); }
  /// The quadrilateral a b c d, cut along a c.
  void add_quad(const std::array<VertexId, 4>& corners);
  TriMesh take() { return {std::move(vertices), std::move(facets)}; }
};

/// How two opposite sides of the unit square of parameters meet: not at all, point by point, or reversed.
enum class Seam { open, closed, reversed };

/// One direction of a grid: its number of steps and how its two ends meet.
struct GridAxis {
  int steps;
  Seam seam;
};

/// The image of the unit square, cut into u.steps x v.steps quadrilaterals of two triangles each; outside is
/// df/du x df/dv. Only u may be reversed: (0, v) is then the same as (1, 1 - v).
TriMesh grid_surface(GridAxis u, GridAxis v, const std::function<Vec3(double, double)>& f);

/// The curve `profile` of (radius, height) points turned about the z axis in `segments` steps; a radius of
/// exactly 0 gives one vertex. Outside lies to the right of the profile in the (radius, height) plane.
/// `closed`: the last point is joined to the first.
TriMesh revolved(const std::vector<Vec2>& profile, bool closed, int segments);

/// The same polygon with extra points, so that no step is longer than `step`. A closed one gets them on its
/// last side too.
std::vector<Vec2> refined(const std::vector<Vec2>& polygon, bool closed, double step);

/// A box cut by planes into blocks, some of them solid.
struct Blocks {
  std::array<std::vector<double>, 3> planes;  ///< along x, y, z; ascending; at least two each
  std::array<int, 3> pieces;                  ///< into how many equal parts each block is cut along each axis
  std::function<bool(int, int, int)> is_solid;  ///< of block (i, j, k)
};

/// The surface between solid and empty blocks. A 2-manifold unless solid blocks meet in no more than an edge
/// or corner.
TriMesh block_surface(const Blocks& blocks);

/// Every triangle cut into k x k similar ones; edges share their new vertices.
TriMesh subdivided(const TriMesh& mesh, int k);

/// The mesh with every vertex moved.
TriMesh mapped(const TriMesh& mesh, const std::function<Vec3(const Vec3&)>& f);

/// Two meshes as the components of one.
TriMesh joined(const TriMesh& a, const TriMesh& b);

}  // namespace geom
