#pragma once
// The restricted power diagram as a data structure: fragments (cell, facet), each in the list of its cell and
// in the list of its facet (paper, section 4.2: "a list of cell labels for each input triangle; for each cell
// the input triangles that are fully or partially covered by it").

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "geom/block_pool.h"
#include "geom/power/clip.h"
#include "geom/short_lists.h"

namespace geom {

using FragmentId = Id<struct FragmentTag>;

/// Fragments and their polygons. Ids never move; erased ids are used again. A fragment that is its whole
/// facet stores no polygon. No allocation once the tables have grown. The order of the lists depends on
/// history.
class FragmentStore {
 public:
  /// For facets 0 .. num_facets - 1; cells appear as they are named.
  explicit FragmentStore(const TriMesh& mesh);

  FragmentId create(SiteId site, FacetId facet);
  void erase(FragmentId f);
  std::size_t size() const { return live_; }

  SiteId site(FragmentId f) const { return fragments_[f].site; }
  FacetId facet(FragmentId f) const { return fragments_[f].facet; }
  /// The fragments of a cell, of a facet. Valid until the next create() or erase().
  std::span<const FragmentId> of_cell(SiteId s) const { return cells_[s]; }
  std::span<const FragmentId> of_facet(FacetId t) const { return facets_[t]; }
  /// The fragment of cell s on facet t, or none. Cost: the shorter of the two lists.
  FragmentId find(SiteId s, FacetId t) const;

  /// Is the fragment its whole facet?
  bool whole(FragmentId f) const { return fragments_[f].size == 0; }
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
    std::uint32_t place_in_cell = 0, place_in_facet = 0;
    std::uint32_t polygon = 0;   ///< its block
    std::uint16_t size = 0;      ///< of that, in corners; 0: whole, without a block
    std::uint16_t capacity = 0;  ///< likewise
  };
  void release_block(Fragment& f);

  const TriMesh& mesh_;
  Table<FragmentId, Fragment> fragments_;
  std::vector<FragmentId> free_;
  ShortLists<SiteId, FragmentId> cells_;
  ShortLists<FacetId, FragmentId> facets_;
  BlockPool<PolygonCorner> corners_;  ///< the kind of a block is its capacity
  std::size_t live_ = 0;
};

}  // namespace geom
