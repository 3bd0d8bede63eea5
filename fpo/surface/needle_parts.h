#pragma once
// A needle cut into few parts.
//
// Halving all long edges of a facet at a time makes parts like itself: a needle becomes thousands of shorter
// ones, many abreast where one would do. Here its sides are halved first, then edges between them, the
// longest one first, and after each cut an edge between two parts gives way to the other diagonal where that
// is shorter (as in Lawson's flips). So parts lie one after the other along the needle,
//
//     ____________________          about as many as its longest side has pieces, twice over, and more only
//     |\  |\  |\  |\  |\  |         where the needle is wider than an edge may be long. The sides are halved
//     |_\_|_\_|_\_|_\_|_\_|         as other facets halve them.

#include <array>
#include <cstdint>
#include <queue>
#include <vector>

#include "fpo/surface/halved_edges.h"

namespace fpo {

/// One object serves all needles of a mesh.
class NeedleParts {
 public:
  /// Keeps a reference.
  explicit NeedleParts(HalvedEdges& edges) : edges_(edges) {}

  /// Longer than four edges may be, and than four times its height.
  static bool is_needle(const geom::TriMesh::Facet& facet, const HalvedEdges& edges);

  /// Appends the parts of the facet, whose edges are short unless there are more than `most` parts. They
  /// cover it once: which side of an edge a corner is on is exact, in integer coordinates on the facet.
  /// O(parts log parts).
  void cut(const geom::TriMesh::Facet& facet, std::size_t most,
           geom::Table<geom::FacetId, geom::TriMesh::Facet>& parts);

 private:
  struct Corner {
    geom::VertexId vertex;
    std::int64_t x, y;  ///< of the facet's corners (0, 0), (2^30, 0), (0, 2^30)
  };
  /// Edge e is from corner e to the next one.
  struct Part {
    std::array<int, 3> corners;
    std::array<int, 3> across;  ///< the part there, or `outside`
  };
  struct LongEdge {
    bool on_side;
    double length2;
    int from, to, part;
    auto operator<=>(const LongEdge&) const = default;
  };
  static constexpr int outside = -1;

  /// Two parts at an edge from a to b: a, b, c is the one, b, a, d the other; and what is across their sides.
  struct Quad {
    int a, b, c, d, bc, ca, ad, db, other;
  };

  int find(int part, int from, int to) const;
  Quad quad_at(int part, int e) const;
  bool is_left(int a, int b, int c) const;
  void put(int part, const Part& what);
  void halve(int part, int e);
  bool halve_side(int part, int e);
  bool halve_between(int part, int e);
  void flip_around(std::vector<int> parts);
  bool flip(int part, int e);
  const Part& at(int part) const { return parts_[static_cast<std::size_t>(part)]; }
  const Corner& corner(int c) const { return corners_[static_cast<std::size_t>(c)]; }
  double length2(int a, int b) const { return edges_.length2(corner(a).vertex, corner(b).vertex); }

  HalvedEdges& edges_;
  std::vector<Corner> corners_;
  std::vector<Part> parts_;
  std::priority_queue<LongEdge> long_;  ///< sides first, then the longest; some are no edges any more
};

}  // namespace fpo
