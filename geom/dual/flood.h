#pragma once
// The certificate of the fast way: a cell traced over the facets that it meets, without polygons.
//
//          |\         |         The cell of the frame's origin p among the frame's sites, from facets where
//      a   | \ B   b  |         it is known to be, across every edge of the surface of which it has a part.
//     -----B--\-------B----     On each such edge the part is an interval, between vertices (A) and points
//          |   \  C   |         (B) where p is as near as a site. Inside a facet, two bisectors meet in
//       p  |    B     |         circles (C).
//
// What is proven. On a facet t the cell is a convex polygon P, and so is what another site has of it. Let all
// B on the edges of t be known, and some C, each a true corner. If every label, the pair of sites whose
// bisector ends there, occurs at none or exactly two of these ends, then all C on t are known:
//
//   - division of P among the sites if p is removed. Its edges make a plane graph whose ends on the border of
//     P are the B and the old corners of P (there the bisector of two neighbours enters); at each C three
//     edges meet. Two cells share at most one segment in P, for both are convex; so an edge with one known
//     end has a second end that must be known, too. Hence the known ends make up whole components of the
//     graph. A component without a known end would have no end on the border of P, and the cell around it
//     would not be convex. So there is none.
//   - the border of P itself, where p is a site: the same with one closed curve instead of the graph. If it
//     has no known end, P is the facet: its three vertices are checked to be owned.
//
// Joined from facet to facet at the B, the segments make chains. Each end of a chain is a C or an old corner;
// if the walk along all chains passes every B, there is no closed curve: no island, no second border. What no
// walk can reach, another component of the cell, is excluded elsewhere (sheets.h), and sites that are not in
// the frame by testing them at all corners, on whose convex hulls the difference of two powers is affine
// (hole.cpp, cell_proof.cpp).
//
// All decisions are by Sure values; where one is not certain, or the surface has a border or an edge of three
// facets there, there is no certificate, and the general way is taken (redivision.h).

#include <span>
#include <vector>

#include "geom/dual/edge_part.h"
#include "geom/dual/met_facets.h"
#include "geom/dual/segment_ends.h"
#include "geom/reused.h"

namespace geom {

class Flood {
 public:
  /// Keeps references. `vertices`: those of the frame.
  Flood(const TriMesh& mesh, FrameVertices& vertices) : mesh_(mesh), vertices_(vertices), facets_(mesh) {}

  /// Forgets what was traced.
  void clear();
  /// Traces the cell of the frame's origin from these facets on. `division`: also how it is divided among the
  /// sites of the frame if the origin is removed. False if something is not certain.
  bool trace(std::span<const FacetId> from, bool division);

  /// Ends that are not on edges of the surface, after trace(): a circle, or an old corner of the cell, in a
  /// facet, where edges end between site i and the origin (j = Frame::none), or between sites i and j. False
  /// if the facet was not met.
  bool add_end(FacetId t, int i, int j);
  /// After all ends: whether they are complete, and no edge is a closed curve.
  bool is_complete();

  /// A corner on the surface's edges: a vertex, or a point on an edge. Of the division, if that was asked
  /// for, else of the cell.
  struct Corner {
    Frame::Place at;  ///< for B rounded
    double off;       ///< at most so far is it off
    int site;         ///< nearest after removal; of a corner of the cell itself none
  };
  std::span<const Corner> corners() const { return corners_.items(); }
  /// The farthest corner of the cell, B or A, squared; a bound, with room for rounding.
  double radius2() const { return radius2_; }
  /// Those that were met.
  const MetFacets& facets() const { return facets_; }

 private:
  /// On the edge being traced, where sites i and j (none: the origin) are equally near.
  struct Point {
    int i, j;
    SegmentEnds::Node node;
  };

  bool trace_edge(MetFacets::Slot slot, std::size_t e);
  bool divide(const FrameVertices::Vertex& u, const FrameVertices::Vertex& v, const EdgePart& part);
  bool add_point(const FrameVertices::Vertex& u, const FrameVertices::Vertex& v, int i, int j);
  bool add_vertex(FrameVertices::Slot s) {
    return (s < vertex_seen_.size() && vertex_seen_[s] == trace_) || add_new_vertex(s);
  }
  bool add_new_vertex(FrameVertices::Slot s);

  const TriMesh& mesh_;
  FrameVertices& vertices_;
  bool division_ = false;
  MetFacets facets_;
  Reused<Corner> corners_;
  std::vector<std::uint32_t> vertex_seen_;  ///< by their slots: of which trace()
  double radius2_ = 0;
  Reused<Point> on_edge_;
  std::vector<int> owners_;
  SegmentEnds ends_;
  std::uint32_t trace_ = 0;
};

}  // namespace geom
