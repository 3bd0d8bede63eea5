#pragma once
// One cell of the diagram from nothing, by exact clipping (clip.h): each facet that it may meet is cut by the
// sites around. Those that are known to border the cell come first, and leave little of it or nothing; what
// else may come near what is left is found by a search.

#include <cstdint>
#include <span>
#include <vector>

#include "geom/dual/state.h"
#include "geom/power/lazy_polygon.h"

namespace geom {

/// Polygons of cells on facets, one after the other.
struct CellPieces {
  struct Piece {
    FacetId facet;
    SiteId owner;
    std::uint32_t first, size;  ///< of its corners
  };
  std::vector<Piece> pieces;
  std::vector<PolygonCorner> corners;

  void clear() {
    pieces.clear();
    corners.clear();
  }
  void add(const FacetPolygon& polygon) { add({polygon.facet, polygon.owner, 0, 0}, polygon.corners); }
  void add(const Piece& piece, std::span<const PolygonCorner> polygon) {
    pieces.push_back({piece.facet, piece.owner, static_cast<std::uint32_t>(corners.size()),
                      static_cast<std::uint32_t>(polygon.size())});
    corners.insert(corners.end(), polygon.begin(), polygon.end());
  }
  std::span<const PolygonCorner> corners_of(const Piece& piece) const {
    return std::span(corners).subspan(piece.first, piece.size);
  }
};

/// One object serves all cells of a state.
class CellClipper {
 public:
  explicit CellClipper(DualState& state) : state_(state), lazy_(state.clipper) {}

  /// The cell of p, which is in. `power`: no location of the cell has more. `around`: sites that are likely
  /// to border it, without p, each once; the more of those that do, the faster. Returns the least bound of
  /// the power in the cell, -infinity if that is empty.
  double clip(SiteId p, double power, std::span<const SiteId> around, CellPieces& out);
  /// The same, with what is known of a cell whose circles are right.
  double clip(SiteId p, CellPieces& out);
  /// Whether the cell of p has a part of that facet.
  bool has_part_of(FacetId t, SiteId p);

 private:
  struct Other {
    SiteId site;
    Bisector bisector;
  };

  void begin(SiteId p, std::span<const SiteId> around);
  double clip_near(SiteId p, double power, double radius, CellPieces& out);
  void consider(SiteId p, std::span<const SiteId> sites);
  double find_others(SiteId p, double power);
  bool cut(FacetId t, SiteId p, std::span<const PolygonCorner> corners, std::size_t first);
  bool cut_facet(FacetId t, SiteId p);
  void cut_pieces(SiteId p, CellPieces& cell);
  void drop_beyond(SiteId p, double radius, CellPieces& cell);
  double bound(const CellPieces& cell) const;

  DualState& state_;
  std::vector<Other> others_;          ///< by which the cell is being cut
  std::vector<const Other*> cutting_;  ///< that part the facet in hand
  std::size_t last_ = 0;               ///< that had a whole facet: often the next one, too
  Table<SiteId, std::uint32_t> stamp_of_;
  std::uint32_t stamp_ = 0;
  FacetPolygon polygon_;
  LazyPolygon lazy_;
  CellPieces spare_, part_;
  std::vector<FacetId> near_;
  std::vector<SiteId> candidates_, around_;
  std::vector<char> beaten_;
};

}  // namespace geom
