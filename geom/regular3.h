#pragma once
// Dynamic regular triangulation of weighted points in space (paper, section 3.1), the dual of the power diagram.

#include <array>
#include <span>
#include <vector>

#include "geom/ids.h"
#include "geom/vec.h"

namespace geom {

/// The regular triangulation of the inserted sites and of eight guards: far samples of weight 0 that are never removed, so
/// that every site lies strictly inside the hull and coplanar input needs no special case. All decisions are exact
/// (predicates.h) with ties broken by the symbolic perturbation, hence the triangulation is a function of the sites,
/// their weights and their ids alone: insertion order leaves no trace.
class Regular3 {
 public:
  /// What one insertion or removal did. Valid until the next one.
  struct Change {
    std::span<const CellId> destroyed;
    std::span<const CellId> created;
    std::span<const SiteId> hidden;   ///< sites that lost their last tetrahedron (the inserted one included)
    std::span<const SiteId> exposed;  ///< sites that were hidden and are vertices now
  };

  /// Corners of a tetrahedron, positively oriented; guards are sites with negative ids below none.
  using Cell = std::array<SiteId, 4>;

  /// Guards are put at least ten diagonals around `box`; all sites must lie inside the box (InputError otherwise).
  explicit Regular3(const Box3& box);

  /// Inserts a site under an id that is not in use. `hint`: a site nearby, none for a walk from anywhere. Expected O(1)
  /// with a good hint.
  Change insert(SiteId id, const WeightedPoint3& point, SiteId hint = SiteId());
  /// Removes a site, visible or hidden. Expected O(1).
  Change remove(SiteId id);

  bool contains(SiteId id) const;
  bool is_hidden(SiteId id) const;
  const WeightedPoint3& point(SiteId id) const;
  /// The sites joined to `id` by an edge, guards left out, in no particular order. Empty for a hidden site.
  void link(SiteId id, std::vector<SiteId>& out) const;

  /// All live tetrahedra (guards included), for tests and drawings.
  std::vector<Cell> cells() const;
  /// Verifies orientation, adjacency, the empty-orthosphere property of every facet and the witnesses of hidden sites;
  /// throws Bug. O(n).
  void check() const;
};

}  // namespace geom
