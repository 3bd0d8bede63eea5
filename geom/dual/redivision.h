#pragma once
// The general way of an update: cells are clipped from nothing, by exact clipping (facet_cells.h), on the facets that
// they meet. It needs no assumption on the surface, the sites or the cells, and is what the fast way (fast_way.h) is
// held against.
//
// Removal of p. The circles of p go. On each facet, the part of p's cell is a convex polygon, and those who own
// something of it now hang together there by common edges: from the sites on its border their polygons lead to all
// others. The new circles are the corners of these polygons where p was nearer.
//
// Insertion of p. The new circles are the corners of p's cell. The circles that it beats go: they belong to sites of
// which it takes something.

#include <cstdint>
#include <span>
#include <vector>

#include "geom/dual/state.h"
#include "geom/facet_cells.h"

namespace geom {

/// Polygons of the diagram of the present sites, each clipped when it is asked for.
class ClippedCells {
 public:
  explicit ClippedCells(const DualState& state);

  /// Forgets all: the sites are others.
  void begin();
  /// The part of a cell on a facet, empty if there is none. Valid until the next call.
  std::span<const PolygonCorner> part(SiteId owner, FacetId t);
  /// All owners on a facet.
  std::vector<SiteId> owners(FacetId t);

 private:
  struct Piece {
    FacetId facet;
    SiteId owner;
    std::uint32_t begin, size, next;
  };
  static constexpr std::uint32_t none = 0xffffffffu;
  static constexpr std::size_t num_buckets = 1024;

  FacetCells cells_;
  FacetPolygon polygon_;
  std::vector<Piece> pieces_;
  std::vector<PolygonCorner> corners_;
  std::vector<std::uint32_t> buckets_;
};

/// One object serves all updates of a state.
class Redivision {
 public:
  explicit Redivision(DualState& state);

  /// Takes p out, or puts it in at a place: the tree and the neighbour source follow.
  void remove(SiteId p, DualChange& change);
  void insert(SiteId p, const WeightedPoint3& point, DualChange& change);
  /// All circles, there being none, and all reaches.
  void build(int threads, DualChange& change);

  /// After remove(): bounds of the power in what p had, with p, and with p or without.
  double last_reach() const { return last_reach_; }
  double last_power() const { return last_power_; }
  /// Does any other site border the cell of p, which is in?
  bool has_neighbours(SiteId p);
  /// The least bound of the power in the cell of p, which is in.
  double reach(SiteId p);
  /// Of what it would have if p, which was removed last, were there.
  double reach_beside(SiteId heir, SiteId p);
  /// The polygons of p, which is in.
  void cell(SiteId p, std::vector<FacetPolygon>& out);

 private:
  /// An end of an edge of the diagram: the edge of this circle opposite to a site.
  struct Side {
    CircleId circle;
    std::size_t side;
  };

  /// The facets where p, which is in, owns something, and the least bound of the power there (-infinity if it owns
  /// nothing). `radius`: no location of its cell is farther from it.
  double facets_of(SiteId p, double radius, std::vector<FacetId>& out);
  void divide_vacancy(SiteId p, FacetId t, std::span<const SiteId> around, DualChange& change);
  void add_corner(const DualState::Polygon& polygon, std::size_t corner);
  void erase_beaten(SiteId p, std::span<const SiteId> rivals, DualChange& change);
  void erase(CircleId c, DualChange& change);
  void create_found(DualChange& change);
  void connect(Side from);
  Side other_end(Side from);
  CircleId circle_at(FacetId t, SiteId a, SiteId b, SiteId c) const;

  DualState& state_;
  ClippedCells clipped_;
  std::vector<FacetId> near_, facets_;
  std::vector<SiteId> around_, rivals_;
  std::vector<std::uint32_t> around_up_to_;  ///< of each facet
  std::vector<EmptyCircle> found_;
  std::vector<Side> open_;  ///< whose other end is not known
  std::vector<char> beaten_;
  FacetPolygon polygon_;
  double last_power_ = 0, last_reach_ = 0;
};

}  // namespace geom
