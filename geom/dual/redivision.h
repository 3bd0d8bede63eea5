#pragma once
// The general way of an update: facets are divided from nothing, by exact clipping (facet_cells.h), and the circles
// on them compared with those registered. It needs no assumption on the surface, the sites or the cells, and is
// the definition that the fast way (move.h) is held against.

#include <cstdint>
#include <span>
#include <vector>

#include "geom/dual/state.h"
#include "geom/facet_cells.h"

namespace geom {

/// Facets of the diagram of the present sites, each divided when it is asked for.
class DividedFacets {
 public:
  explicit DividedFacets(const DualState& state);

  /// Forgets all: the sites are others.
  void begin();
  struct Piece {
    SiteId owner;
    std::size_t begin, end;  ///< of its corners
  };
  /// The indices of the pieces on a facet: first, last + 1.
  struct Range {
    std::size_t begin, end;
  };
  Range of(FacetId t);
  /// The piece of a site, or none.
  const Piece* find(FacetId t, SiteId owner);
  const Piece& piece(std::size_t i) const { return pieces_[i]; }
  std::span<const PolygonCorner> corners(const Piece& piece) const {
    return std::span(corners_).subspan(piece.begin, piece.end - piece.begin);
  }
  bool has_part(SiteId p, FacetId t, FacetPolygon& polygon) { return cells_.part_of(p, t, polygon); }

 private:
  FacetCells cells_;
  std::vector<Piece> pieces_;
  std::vector<PolygonCorner> corners_;
  std::vector<Range> ranges_;
  Table<FacetId, std::uint32_t> range_of_;  ///< index into ranges_; not known if that is of another facet
  std::vector<FacetId> facet_of_range_;
};

/// One object serves all updates of a state.
class Redivision {
 public:
  explicit Redivision(DualState& state);

  /// Takes p out, or puts it in at a place: the tree and the neighbour source follow.
  void remove(SiteId p, DualChange& change);
  void insert(SiteId p, const WeightedPoint3& point, DualChange& change);
  /// After remove(): a bound of the power in what p had, with p and without.
  double last_power() const { return last_power_; }
  /// And of that with p alone.
  double last_reach() const { return last_reach_; }
  /// Does any other site border the cell of p, which is in?
  bool has_neighbours(SiteId p);
  /// All circles, there being none, and all reaches.
  void build(int threads, DualChange& change);

  /// The least bound of the power in the cell of p, which is in.
  double reach(SiteId p);
  /// Of what it would have if p, which was removed last, were there.
  double reach_beside(SiteId heir, SiteId p);
  /// Its polygons.
  void cell(SiteId p, std::vector<FacetPolygon>& out);

 private:
  /// An end of an edge of the diagram: the edge of this circle opposite to a site.
  struct Side {
    CircleId circle;
    std::size_t side;
  };

  /// The facets where p, which is in, owns something, and the exact bound of the power there (-infinity if it owns
  /// nothing). `radius`: no location of its cell is farther from it.
  double facets_of(SiteId p, double radius, std::vector<FacetId>& out);
  void update(std::span<const FacetId> facets, std::vector<SiteId> involved, DualChange& change);
  void find_circles(std::span<const FacetId> facets);
  void compare_circles(std::span<const SiteId> involved, DualChange& change);
  void erase(CircleId c, DualChange& change);
  void connect(Side from);
  Side other_end(Side from);
  CircleId circle_at(FacetId t, SiteId a, SiteId b, SiteId c) const;
  void note_winners(SiteId p, std::span<const FacetId> facets, DualChange& change);
  double power_without(SiteId p, std::span<const FacetId> facets);
  void raise_reaches(std::span<const FacetId> facets);

  DualState& state_;
  DividedFacets divided_;
  FacetPolygon polygon_;
  Bisector bisector_{};
  std::vector<FacetId> near_, facets_;
  Table<FacetId, std::uint32_t> stamp_of_;  ///< of the update that the facet is part of
  std::uint32_t stamp_ = 0;
  std::vector<EmptyCircle> found_;
  std::vector<char> is_registered_;  ///< of those found
  std::vector<Side> open_;           ///< whose other end is not known
  std::vector<char> beaten_;
  double last_power_ = 0, last_reach_ = 0;
};

}  // namespace geom
