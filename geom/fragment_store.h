#pragma once
// The restricted power diagram as a data structure: fragments (cell, facet), each in the list of its cell and
// in the list of its facet (paper, section 4.2: "a list of cell labels for each input triangle; for each cell
// the input triangles that are fully or partially covered by it").

#include <array>
#include <span>
#include <vector>

#include "geom/clip.h"

namespace geom {

using FragmentId = Id<struct FragmentTag>;

/// Fragments and their polygons. Ids never move; erased ids are used again. A fragment that is its whole
/// facet stores no polygon. No allocation once the tables have grown.
class FragmentStore {
 public:
  /// For facets 0 .. num_facets - 1; cells appear as they are named.
  explicit FragmentStore(const TriMesh& mesh);

  FragmentId create(SiteId site, FacetId facet);
  void erase(FragmentId f);
  std::size_t size() const { return live_; }

  SiteId site(FragmentId f) const { return fragments_[f].site; }
  FacetId facet(FragmentId f) const { return fragments_[f].facet; }
  FragmentId first_of_cell(SiteId s) const { return s.index() < cells_.size() ? cells_[s] : FragmentId(); }
  FragmentId next_in_cell(FragmentId f) const { return fragments_[f].next_in_cell; }
  FragmentId first_of_facet(FacetId t) const { return facets_[t]; }
  FragmentId next_in_facet(FragmentId f) const { return fragments_[f].next_in_facet; }
  /// The fragment of cell s on facet t, or none. Cost: the shorter of the two lists.
  FragmentId find(SiteId s, FacetId t) const;

  /// Is the fragment its whole facet?
  bool whole(FragmentId f) const { return fragments_[f].polygon < 0; }
  /// The stored corners, empty if whole.
  std::span<const PolygonCorner> corners(FragmentId f) const;
  /// The corners in any case; those of a whole facet are written to `buffer`.
  std::span<const PolygonCorner> corners(FragmentId f, std::array<PolygonCorner, 3>& buffer) const;
  /// Replaces the polygon; three facet edges mean whole.
  void set_corners(FragmentId f, std::span<const PolygonCorner> corners);

  /// A number kept with the fragment for its user: an upper bound of the power of its locations.
  double max_radius2(FragmentId f) const { return fragments_[f].max_radius2; }
  void set_max_radius2(FragmentId f, double value) { fragments_[f].max_radius2 = value; }

  /// Verifies both families of lists. Throws Bug. O(all).
  void check() const;

 private:
  struct Fragment {
    double max_radius2 = 0;
    SiteId site;
    FacetId facet;
    FragmentId next_in_cell, previous_in_cell, next_in_facet, previous_in_facet;
    std::int32_t polygon = -1;  ///< offset of its block in corners_; -1: whole
    std::uint16_t size = 0, capacity = 0;
  };
  void release_block(Fragment& f);

  const TriMesh& mesh_;
  Table<FragmentId, Fragment> fragments_;
  std::vector<FragmentId> free_;
  Table<SiteId, FragmentId> cells_;
  Table<FacetId, FragmentId> facets_;
  std::vector<PolygonCorner> corners_;                  ///< blocks of 4, 8, 12, ... corners
  std::vector<std::vector<std::int32_t>> free_blocks_;  ///< by capacity / 4
  std::size_t live_ = 0;
};

}  // namespace geom
