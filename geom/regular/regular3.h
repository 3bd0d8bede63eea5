#pragma once
// Dynamic regular triangulation of weighted points in space (paper, section 3.1), the dual of the power
// diagram.

#include <vector>

#include "geom/exact/predicates.h"
#include "geom/ids.h"
#include "geom/regular/guards.h"
#include "geom/regular/insertion3.h"
#include "geom/regular/regular_change.h"
#include "geom/regular/removal3.h"
#include "geom/regular/triangulation3.h"
#include "geom/vec.h"

namespace geom {

/// The regular triangulation of the inserted sites and of eight guards: far samples of weight 0 that are
/// never removed, so that every site lies strictly inside the hull and coplanar input needs no special case.
/// All decisions are exact (predicates.h) with ties broken by the symbolic perturbation, hence the
/// triangulation is a function of the box, the sites, their weights and their ids alone: insertion order
/// leaves no trace. Steady state allocates nothing. Queries use scratch marks: one thread at a time.
class Regular3 {
 public:
  /// No simplex is in both lists: the ids of the destroyed are free only for the next change.
  using Change = RegularChange;
  /// Corners of a tetrahedron, positively oriented; guards are among them (guards.h).
  using Simplex = Triangulation3::Simplex;

  /// Guards are put at least ten diagonals around `box`; all sites must lie inside the box (InputError
  /// otherwise, also for an empty or infinite box).
  explicit Regular3(const Box3& box) : triangulation_(box) {}

  /// Inserts a site under an id that is not in use. `hint`: a site nearby, none for a walk from anywhere.
  /// Expected O(1) with a good hint.
  Change insert(SiteId id, const WeightedPoint3& point, SiteId hint = SiteId());
  /// Removes a site, visible or hidden. Expected O(1).
  Change remove(SiteId id);

  bool contains(SiteId id) const { return triangulation_.contains(id); }
  bool is_hidden(SiteId id) const {
    return contains(id) && triangulation_.site(id).state == Triangulation3::State::hidden;
  }
  const WeightedPoint3& point(SiteId id) const { return triangulation_.point(id); }
  /// The sites joined to `id` by an edge, guards left out, in no particular order. Empty for a hidden site.
  void link(SiteId id, std::vector<SiteId>& out) const;
  /// The same and the hidden sites that the tetrahedra at `id` witness: if `id` were removed, the sites with
  /// other cells than before were all among them.
  void link_and_hidden(SiteId id, std::vector<SiteId>& out) const;

  /// Corners of a live tetrahedron, such as one that a Change calls created.
  const Simplex& simplex(SimplexId t) const { return triangulation_.simplices[t].corner; }
  /// All live tetrahedra (guards included), for tests and drawings.
  std::vector<Simplex> simplices() const;
  /// Verifies orientation, adjacency, the empty-orthosphere property of every facet and the witnesses of
  /// hidden sites; throws Bug. O(n).
  void check() const { geom::check(triangulation_); }

 private:
  Triangulation3 triangulation_;
  Insertion3 insertion_;
  Removal3 removal_;
  mutable std::vector<SimplexId> star_;  ///< scratch of link()
};

}  // namespace geom
