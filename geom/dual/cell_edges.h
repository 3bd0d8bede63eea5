#pragma once
// The edges of the diagram within a cell that goes, or around one that comes, put together facet by facet:
// which circles lie beyond each other there.
//
//      *---o-----o---*        On each facet an edge between two cells is a segment. Its ends are circles to
//    own   u     v  found     be, or points (o) on edges of the facet, where it goes on across (chains.h);
//                             or, in a cell that goes, its circles, where edges come in from outside.

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "geom/dual/cell_clipper.h"
#include "geom/dual/state.h"

namespace geom {

/// One object serves many cells, one after the other.
class CellEdges {
 public:
  explicit CellEdges(DualState& state) : state_(state) {}

  /// Starts anew with the cell of p. `own`: its circles if it goes, none if it comes. `found`: the circles to
  /// be; they must stay where they are.
  void begin(SiteId p, std::span<const CircleId> own, std::span<const EmptyCircle> found);
  /// Adds the edges of polygons: of p's own cell all, of a share those that are not on p's border, once for
  /// both cells.
  void add(const CellPieces& pieces);
  /// After all of a cell that goes: joins what comes in through its circles to what is inside; it may leave
  /// the cell and come back.
  void join_across();
  /// The circles to be are there, in their order: those at the ends of each edge get to know each other.
  void connect(std::span<const CircleId> created) const;

 private:
  /// An end of an edge of the diagram, or of a part of it.
  struct End {
    enum Kind : char {
      nowhere,  ///< a border of the surface
      found,    ///< side of a circle to be: a place in found_
      present,  ///< side of a circle that is there
      own,      ///< a circle of p, a place in star_, where the edge goes on outside
      open      ///< a point on an edge of the surface, where it goes on: 3 smaller facet + edge
    } kind = nowhere;
    std::uint8_t side = 0;
    std::int64_t place = 0;
  };
  struct Open {
    std::int64_t point;
    SiteId a, b;
    End other;
  };
  /// Those that wait for the rest of their edge, found by the point: needles in a cell leave hundreds.
  class OpenEnds {
   public:
    void clear();
    /// Null if there is none.
    Open* find(std::int64_t point, SiteId a, SiteId b);
    void add(const Open& end) { at(end.point).push_back(end); }
    void erase(const Open* end);

   private:
    std::vector<Open>& at(std::int64_t point);
    std::array<std::vector<Open>, 64> lists_;
  };
  struct OwnCircle {
    CircleId id;
    End inside;  ///< where the edge goes that comes in here
  };

  void add_piece(const CellPieces& pieces, const CellPieces::Piece& piece);
  End end_at(FacetId t, SiteId a, SiteId b, EdgeLabel label) const;
  End follow(const End& end, SiteId a, SiteId b);
  void join(const End& one, const End& two, SiteId a, SiteId b);
  End outside(std::size_t own) const;

  DualState& state_;
  SiteId p_;
  std::span<const EmptyCircle> found_;
  std::vector<OwnCircle> star_;
  std::vector<std::pair<End, End>> links_;
  OpenEnds open_;
};

}  // namespace geom
