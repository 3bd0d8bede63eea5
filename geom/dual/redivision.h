#pragma once
// The general way of an update: cells are clipped from nothing, by exact clipping (cell_clipper.h), on the
// facets that they meet. It needs no assumption on the surface, the sites or the cells, and is what the fast
// way (fast_way.h) is held against.
//
// Removal of p. The circles of p go, and its cell is divided among the others (vacancy_division.h). The new
// circles are the corners of their shares that p's cell did not have.
//
// Insertion of p. The circles that it beats go: they belong to sites of which it takes something. The new
// circles are the corners of p's cell.
//
// The edges of the diagram within the old cell, or around the new one, are put together facet by facet, as in
// chains.h.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "geom/dual/cell_clipper.h"
#include "geom/dual/state.h"
#include "geom/dual/vacancy_division.h"

namespace geom {

/// One object serves all updates of a state.
class Redivision {
 public:
  explicit Redivision(DualState& state);

  /// Plans the removal of p, which changes nothing. The plan holds until the next update.
  void plan(SiteId p);
  /// Of the plan: does any other site border the cell? The circles to be, in their order (circle_before());
  /// those who win something, ascending; bounds of the power in what p has, with p, and with p or without.
  bool has_neighbours() const { return has_neighbours_; }
  std::span<const EmptyCircle> circles() const { return found_; }
  std::span<const SiteId> heirs() const { return heirs_; }
  double reach() const { return reach_; }
  double power() const { return power_; }
  /// Carries it out: the tree and the oracle follow.
  void remove(DualChange& change);

  /// Puts p in at a place, likewise.
  void insert(SiteId p, const WeightedPoint3& point, DualChange& change);
  /// All circles, there being none, and all reaches.
  void build(int threads, DualChange& change);

  /// The least bound of the power in the cell of p, which is in.
  double reach(SiteId p) { return clipper_.clip(p, asked_); }
  /// The polygons of p, which is in. Valid until the next call.
  const CellPieces& cell(SiteId p) {
    clipper_.clip(p, asked_);
    return asked_;
  }

 private:
  /// An end of an edge of the diagram, or of a part of it.
  struct End {
    enum Kind : char {
      nowhere,  ///< a border of the surface
      found,    ///< side of a circle to be: a place in found_
      present,  ///< side of a circle that is there
      own,      ///< a circle of the removed site, a place in star_, where the edge goes on outside
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
  struct OwnCircle {
    CircleId id;
    End inside;  ///< where the edge goes that comes in here
  };
  struct OpenSide {
    CircleId circle;
    std::uint8_t side;
    SiteId a, b;
  };

  void add_segments(SiteId p, const CellPieces& pieces, const CellPieces::Piece& piece);
  End end_at(SiteId p, FacetId t, SiteId a, SiteId b, EdgeLabel label) const;
  End follow(const End& end, SiteId a, SiteId b);
  void join(const End& one, const End& two, SiteId a, SiteId b);
  End outside(std::size_t own) const;
  void join_across();
  void erase_beaten(SiteId p, DualChange& change);
  bool is_beaten(const EmptyCircle& circle, SiteId p) const;
  std::size_t create_found(DualChange& change);
  void connect(const End& one, const End& two, std::size_t first_created, const DualChange& change);
  void connect_outwards(SiteId p, std::size_t first_created, const DualChange& change);
  void connect_outwards(const OpenSide& from, CircleId to);
  CircleId circle_at(FacetId t, SiteId a, SiteId b, CircleId but) const;
  CircleId other_end(const OpenSide& from) const;
  bool is_taken(FacetId t, int edge, SiteId a, SiteId b, SiteId p) const;

  DualState& state_;
  CellClipper clipper_;
  VacancyDivision division_;
  // The plan.
  SiteId p_;
  bool has_neighbours_ = false;
  double reach_ = 0, power_ = 0;
  CellPieces cell_;
  std::vector<EmptyCircle> found_;
  std::vector<SiteId> heirs_;
  std::vector<OwnCircle> star_;
  std::vector<std::pair<End, End>> links_;
  // Workspaces.
  std::vector<Open> open_;
  std::vector<OpenSide> cut_off_;   ///< sides of circles that have lost what was beyond
  std::vector<OpenSide> outwards_;  ///< of new circles
  std::vector<SiteId> rivals_, around_;
  std::vector<CircleId> beaten_;
  CellPieces asked_;
};

}  // namespace geom
