#pragma once
// The edges of the diagram, put together facet by facet: which circles lie beyond each other.
//
//      c1 *---o---o-----o---* c2      On each facet an edge between two cells is a segment. Its ends are
//           t   u    v    w           circles, or points (o) on edges of the facet, where it goes on across:
//                                     there segments are joined to chains, and a chain between two circles is
//                                     done.

#include <array>
#include <span>
#include <unordered_map>

#include "geom/dual/known_cell.h"
#include "geom/dual/state.h"
#include "geom/power/divided_surface.h"

namespace geom {

/// For one pass over all facets, each once, in any order (a curve keeps the table of open ends small).
class EdgeChains {
 public:
  /// Edges beside cells whose circles are known are left out.
  explicit EdgeChains(DualState& state, const KnownDiagram& known = {}) : state_(state), known_(known) {}

  /// Adds the segments of the polygons of one facet, whose circles are registered.
  void add(FacetId t, std::span<const FacetPiece> pieces);
  /// Sites of which an edge is a closed curve without a circle, or runs from border to border. In order of
  /// facets, maybe more than once.
  std::span<const SiteId> without_circle() const { return without_circle_; }

 private:
  /// A point of the diagram on an edge of the surface, named by the smaller facet there: 3 facet + edge, and
  /// the sites, the smaller one first.
  struct Point {
    std::int64_t edge = -1;
    SiteId a, b;
    bool operator==(const Point&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Point& p) const {
      std::uint64_t x = static_cast<std::uint64_t>(p.edge) * 0x9e3779b97f4a7c15u;
      x = (x ^ static_cast<std::uint32_t>(p.a.value)) * 0xbf58476d1ce4e5b9u;
      x = (x ^ static_cast<std::uint32_t>(p.b.value)) * 0x94d049bb133111ebu;
      return x ^ x >> 29;
    }
  };
  /// Of a segment or chain: a side of a circle, or a point where it may go on, or neither (a border).
  struct End {
    CircleId circle;
    std::size_t side = 0;
    Point point;
    bool is_open() const { return point.edge >= 0; }
  };
  End end_at(FacetId t, SiteId a, SiteId b, EdgeLabel label) const;
  End follow(const End& end);
  void join(const End& one, const End& two, SiteId a, SiteId b);

  DualState& state_;
  KnownDiagram known_;
  std::unordered_map<Point, End, Hash> open_;  ///< an open end, and the other end of its chain
  std::vector<SiteId> without_circle_;
};

/// The edge of t that is edge e of the facet `before` it: the same two vertices. -1: none.
int same_edge(const TriMesh& mesh, FacetId before, int e, FacetId t);

}  // namespace geom
