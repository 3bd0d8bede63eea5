#pragma once
// Closest points on a triangle mesh, by a static tree of bounding boxes.

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "geom/mesh/trimesh.h"

namespace geom {

/// A point of a triangle.
struct TrianglePoint {
  Vec3 point{0, 0, 0};
  Vec3 barycentric{0, 0, 0};                                   ///< non-negative, sum 1 up to rounding
  double distance2 = std::numeric_limits<double>::infinity();  ///< to the query, squared
};

/// The point of a triangle nearest to x. A triangle without area is its edges, an edge without length a
/// point. The result lies in the triangle's box and is a corner bit for bit where that is nearest; else it is
/// rounded. Requires lengths between about 1e-75 and 1e75 (squares of areas are formed).
TrianglePoint closest_point(const Vec3& x, const std::array<Vec3, 3>& q);

/// A binary tree over the facets, each node with the box of its facets. It shares the arrays of the mesh.
/// Built in O(F log F); a query near the surface costs O(log F) typically, O(F) at worst (the center of a
/// sphere).
class AabbTree {
 public:
  struct Closest : TrianglePoint {
    FacetId facet;
  };

  /// Throws InputError if the mesh has no facet.
  explicit AabbTree(const TriMesh& mesh);

  /// The nearest point of the mesh; of facets equally near, that of the smallest id: to the bit what
  /// closest_point() gives on trying all facets. `hint`: a facet thought to be near, or none; it changes the
  /// cost only.
  Closest closest(const Vec3& x, FacetId hint = FacetId()) const;

  /// Whether a point of the mesh is less than this far, squared: closest(x, hint).distance2 < distance2.
  bool is_nearer(const Vec3& x, double distance2, FacetId hint = FacetId()) const;

  /// Adds the facets whose boxes meet this one, in no order. O(log F + their number) typically.
  void overlapping(const Box3& box, std::vector<FacetId>& facets) const;

  std::array<Vec3, 3> triangle(FacetId t) const {
    return {mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2)};
  }

 private:
  /// Nodes are in preorder: the first child of an inner node follows it.
  struct Node {
    Vec3 low, high;
    std::int32_t count = 0;  ///< leaf: of its facets; inner: 0
    std::int32_t next = 0;   ///< leaf: its first facet; inner: its second child
  };

  struct Item {
    Vec3 middle;  ///< of the facet's box
    FacetId facet;
  };
  /// The subtree of these items, which are put in its order; `first`: the number of those before them.
  void build(std::span<Item> items, std::size_t first);
  /// Ends when one is found whose squared distance is less than enough.
  void search(const Vec3& x, Closest& best, double enough = -1) const;
  static double distance2(const Node& node, const Vec3& x);
  double distance2(FacetId t, const Vec3& x) const;
  void improve(FacetId t, const Vec3& x, Closest& best) const;

  TriMesh mesh_;
  std::vector<Node> nodes_;
  std::vector<FacetId> facets_;  ///< those of a leaf next to each other
};

}  // namespace geom
